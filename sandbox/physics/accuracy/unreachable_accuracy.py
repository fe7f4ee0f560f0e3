"""Whether an accuracy is out of reach of a level whose runs take long, from the beginning of a run.

A search ends when its runs have taken a few seconds. Where the level's own rate takes most of that,
only lower rates could still be confirmed. If halving the step twice brings the beginning of the run
no closer to a result, they are not worth their time.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from time import thread_time

from sandbox.model.number_bounds import Duration
from sandbox.physics.accuracy.compared_runs import Stop, Watched, record, scaled
from sandbox.physics.accuracy.step_refinement import Refinement, with_errors
from sandbox.physics.measuring.recording import Recorder, Trace
from sandbox.physics.state.simulation_errors import SimulationError

SLOW = 1.5
"""The time after which the first run of a search is looked at, as a multiple of the search's work.
"""

WILD = 0.1
"""The least relative error of a run that no step is small enough for, within the work of a search.
"""

FAR = 100.0
"""That error, at least, as a multiple of the target."""

COARSER = (4, 2)
"""The steps of the runs that it is compared with, in steps of its own."""


class OutOfReach(Exception):  # noqa: N818 (what was found rather than an error)
    """An accuracy is out of reach, as `runs` show, of what is judged, `items`, with its scales."""

    def __init__(self, runs: Refinement, items: Sequence[Watched]) -> None:
        super().__init__()
        self.runs, self.items = runs, items


@dataclass(slots=True)
class Doubt:
    """Looks at the first run of a search once, if that takes long.

    Raises `OutOfReach` if the accuracy is, and `Cancelled` if `stop` returned true.
    """

    items: Sequence[Watched]
    target: float
    stop: Stop
    started: float
    """The `thread_time` at which the search began, but for the time of the look [s]."""
    budget: float
    """The work of the search [s]."""
    _is_done: bool = False

    def __call__(self, run: Recorder) -> None:
        """Look at the run so far, if it is time to."""
        now = thread_time()
        if not self._is_done and now - self.started > SLOW * self.budget:
            self._is_done = True
            if run.trace.stepping.rate >= COARSER[0]:
                self._compare_beginnings(run.trace)
            self.started += thread_time() - now

    def _compare_beginnings(self, own: Trace) -> None:
        """Take the beginning of a run at half the rate and a quarter of it as well."""
        level = own.level.model_copy(update={"duration": Duration(float(own.t[-1]))})
        rate, items = own.stepping.rate, scaled(self.items, own)
        with suppress(SimulationError):
            coarser = (own.stepping.at(rate / parts) for parts in COARSER)
            traces = [record(level, own.values, each, items, self.stop) for each in coarser]
            runs = with_errors([*traces, own], items)
            if runs.errors[-1] > max(WILD, FAR * self.target):
                raise OutOfReach(runs, items)
