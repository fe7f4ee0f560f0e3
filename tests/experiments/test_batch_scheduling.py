"""The sizes of batches: small while the cost of a row is unknown, and small at the end."""

from collections.abc import Callable

import pytest

from sandbox.experiments.batch_scheduling import LAST, LONGEST, Pace
from sandbox.experiments.row_runs import TaskResults
from tests.experiments.making import RANGE, plan

Cost = Callable[[int], float]


def batches(jobs: int, rows: int, cost: Cost, together: int = 1) -> list[int]:
    """Return the sizes of the batches if each takes as long as its rows [s]."""
    pace = Pace(jobs, rows, together)
    found = plan("kinematics/projectile", {"angle": "5:85:3"}, RANGE)
    sizes = []
    for task in pace.tasks(found, [(0, rows)]):
        count = task.stop - task.start
        pace.note(TaskResults(task.start, task.stop, [], cost(count)))
        sizes.append(count)
    assert sum(sizes) == rows
    return sizes


def shared(sizes: list[int], jobs: int, cost: Cost) -> float:
    """Return the efficiency of processes that take a batch whenever they are free."""
    free = [0.0] * jobs
    for size in sizes:
        free[free.index(min(free))] += cost(size)
    return cost(sum(sizes)) / (jobs * max(free))


@pytest.mark.parametrize("jobs", [2, 5, 16])
@pytest.mark.parametrize(("rows", "row"), [(8001, 2e-3), (100_000, 1e-4), (2001, 4e-3)])
def test_all_processes_end_at_about_the_same_time(jobs: int, rows: int, row: float) -> None:
    def cost(count: int) -> float:
        return row * count

    assert shared(batches(jobs, rows, cost), jobs, cost) > 0.9


def test_few_long_runs_are_shared_one_by_one() -> None:
    """41 runs of 0.4 s on two processes: 21 and 20."""
    sizes = batches(2, 41, lambda count: 0.4 * count)
    assert max(sizes) <= 2
    assert shared(sizes, 2, lambda count: 0.4 * count) > 0.95


def test_a_batch_of_long_runs_is_one_run() -> None:
    assert set(batches(2, 100, lambda count: 2 * LONGEST * count)[4:]) == {1}


def test_the_last_batches_are_short() -> None:
    sizes = batches(2, 10_000, lambda count: 1e-3 * count)
    assert sizes[-2] <= 2 * LAST / 1e-3


@pytest.mark.parametrize(
    ("jobs", "rows", "sizes"),
    [(2, 24, [12, 12]), (2, 401, [201, 200]), (1, 900, [300, 300, 300]), (2, 1000, [250] * 4)],
)
def test_runs_that_go_together_are_shared_evenly_in_as_few_batches_as_can_be(
    jobs: int, rows: int, sizes: list[int]
) -> None:
    """A batch of 12 costs nearly as much as one of 24, so none is divided to fill a gap."""
    assert batches(jobs, rows, lambda _: 1.0, together=400) == sizes
