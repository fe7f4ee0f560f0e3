"""An experiment from its first row to its last: batches by what they cost, kept as they come."""

from collections.abc import Callable, Iterable, Iterator
from time import perf_counter

from sandbox.experiments.executors import Executor
from sandbox.experiments.plan import Plan
from sandbox.experiments.running import Done, Task, run, together
from sandbox.experiments.storage import Store

FIRST = 8
"""How many rows the first batches have, of which nobody knows what they cost."""

GROWTH = 8
"""How many times as many rows a batch may have as one of which the cost is known."""

SHORTEST, LONGEST = 0.5, 20.0
"""s, how long a batch is to take at the beginning, and after a quarter of an hour: as much is lost
where all is ended at once."""

SHARE = 50
"""How many batches of the present length the time so far would hold."""

MOST = 65_536
"""How many rows a batch has at the most."""

Tell = Callable[[int], None]
"""Is told how many rows have been done, of those that were missing."""


class Pace:
    """How many rows a batch has.

    Parameters
    ----------
    jobs
        How many batches are worked on at a time.
    least
        How many rows a batch is to have at the least, while as many are left.
    """

    def __init__(self, jobs: int, least: int = 1) -> None:
        self._jobs, self._began, self._least = jobs, perf_counter(), least
        self._largest, self._cost = 0, 0.0

    def note(self, done: Done) -> None:
        """Take note of what a batch has cost."""
        rows = done.stop - done.start
        cost = done.seconds / rows
        self._cost = cost if rows > 2 * self._largest else (self._cost + cost) / 2
        self._largest = max(self._largest, rows)

    def rows(self, left: int) -> int:
        """Return how many rows the next batch has, of those that are left."""
        fewest = min(self._least, -(-left // self._jobs))
        if not self._largest:
            return max(min(FIRST, left), fewest)
        length = min(max((perf_counter() - self._began) / SHARE, SHORTEST), LONGEST)
        rows = min(int(length / max(self._cost, 1e-9)), GROWTH * self._largest, MOST)
        least = int(SHORTEST / max(self._cost, 1e-9))  # so that all end at about the same time
        return max(min(rows, max(left // (2 * self._jobs), least)), fewest)

    def tasks(self, plan: Plan, missing: Iterable[tuple[int, int]]) -> Iterator[Task]:
        """Yield what is missing of a plan, each as large as it may be when it is asked for."""
        spans = list(missing)
        left = sum(stop - start for start, stop in spans)
        for start, stop in spans:
            while start < stop:
                end = min(start + self.rows(left), stop)
                yield Task(plan, start, end)
                left -= end - start
                start = end


def conduct(plan: Plan, store: Store, executor: Executor, tell: Tell) -> None:
    """Run all rows that are missing, and put all together.

    Raises
    ------
    SandboxError
        If it cannot go on; what was done is kept.
    """
    if store.complete:
        return
    pace, rows = Pace(executor.jobs, together(plan)), 0
    for done in executor.results(run, pace.tasks(plan, store.missing())):
        store.add(done.start, done.stop, done.rows)
        pace.note(done)
        rows += done.stop - done.start
        tell(rows)
    store.finish()
