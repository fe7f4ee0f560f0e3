"""Running an experiment: batches sized by their cost, results stored as they arrive."""

from collections.abc import Callable, Iterable, Iterator
from time import perf_counter

from sandbox.experiments.executors import Executor
from sandbox.experiments.experiment_folder import Store
from sandbox.experiments.plan import Plan
from sandbox.experiments.row_runs import Task, TaskResults, pack, rows_per_batch, run

FIRST = 8
"""The most rows of the first batches, whose cost is unknown."""

SHARES = 8
"""The least number of first batches per process, if there are enough rows."""

GROWTH = 8
"""The most rows of a batch, as a multiple of the rows of a batch whose cost is known."""

LAST = 0.05
"""The length of the last batches [s], so that all processes end at about the same time."""

SHORTEST, LONGEST = 0.5, 20.0
"""The length of a batch at the beginning, and after a quarter of an hour [s]. A batch in progress
is lost if the experiment is stopped."""

SHARE = 50
"""The time so far, as a multiple of the length of the next batch."""

MOST = 65_536
"""The most rows in a batch."""

Tell = Callable[[int], None]
"""Called with the number of rows that are done, out of those that were missing."""


class Pace:
    """The number of rows in each batch.

    Batches become smaller towards the end, in proportion to what is left (C. D. Polychronopoulos
    and D. J. Kuck, "Guided self-scheduling", 1987). Runs in one batch of arrays cost as much in a
    small batch as in a large one: their batches are all of one size, as few as the processes share
    evenly. There are `jobs` batches at a time; `together` is the number of runs in one batch of
    arrays, 1 if each runs alone.
    """

    def __init__(self, jobs: int, rows: int, together: int = 1) -> None:
        self._jobs, self._began, self._left = jobs, perf_counter(), rows
        self._largest, self._cost = 0, 0.0
        rounds = -(-rows // (jobs * together))
        self._even = -(-rows // (jobs * rounds)) if together > 1 and rows else 0

    def note(self, done: TaskResults) -> None:
        """Record the cost of a batch."""
        rows = done.stop - done.start
        cost = max(done.seconds / rows, 1e-9)
        self._cost = cost if rows > 2 * self._largest else (self._cost + cost) / 2
        self._largest = max(self._largest, rows)

    def rows(self) -> int:
        """Return the number of rows in the next batch, given how many are left."""
        if not self._largest:
            return self._even or max(min(FIRST, self._left // (SHARES * self._jobs)), 1)
        if self._even:
            return max(min(self._even, int(LONGEST / self._cost)), 1)
        length = min(max((perf_counter() - self._began) / SHARE, SHORTEST), LONGEST)
        share = max(self._left // (2 * self._jobs), int(LAST / self._cost))
        return max(min(int(length / self._cost), GROWTH * self._largest, share, MOST), 1)

    def tasks(self, plan: Plan, missing: Iterable[tuple[int, int]]) -> Iterator[Task]:
        """Yield tasks for the missing rows of a plan, each sized when it is asked for."""
        packed = pack(plan)
        for start, stop in missing:
            while start < stop:
                end = min(start + self.rows(), stop)
                yield Task(packed, start, end)
                self._left -= end - start
                start = end


def conduct(plan: Plan, store: Store, executor: Executor, tell: Tell) -> None:
    """Run all missing rows, and write the finished table.

    Raises `SandboxError` if it cannot continue; the results so far are kept.
    """
    if store.complete:
        return
    missing, rows = list(store.missing()), 0
    pace = Pace(executor.jobs, sum(stop - start for start, stop in missing), rows_per_batch(plan))
    for done in executor.results(run, pace.tasks(plan, missing)):
        store.add(done.start, done.stop, done.columns)
        pace.note(done)
        rows += done.stop - done.start
        tell(rows)
    store.finish()
