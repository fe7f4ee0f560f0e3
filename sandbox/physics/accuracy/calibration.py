"""The cheapest setting that reaches an accuracy, found by short runs.

Each scheme that is for the level climbs a ladder of rates, each twice the one before, until a run
agrees with finer ones to the accuracy that is asked for, or the time for all is spent; then the
order by which its errors fall tells how far it has to go. The cheapest of all is taken.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from sandbox.model.expressions import Values
from sandbox.model.level import FINEST, HIGHEST_RATE, Level, Stepping
from sandbox.model.schemes import unsmooth
from sandbox.physics.accuracy.candidates import CAUTION, REAL_TIME, Offer, Offers
from sandbox.physics.accuracy.chaos import WILD, growth
from sandbox.physics.accuracy.errors import AccuracyError
from sandbox.physics.accuracy.refinement import foot, held_against, step_prices
from sandbox.physics.accuracy.runs import Stop, Watched, never, watched
from sandbox.physics.accuracy.search import FEWEST, Climber, Progress, climb
from sandbox.physics.guarding.rate_limits import needs
from sandbox.physics.measuring.grading import applies
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.making import make_world

BUDGET = 0.75
"""s, for all runs of a calibration; the one that is under way is not cut short."""

FEW = 400
"""Steps of the first run, at the most: a long run begins with steps that no one would choose."""

LONGEST = 4.0
"""Hz, or up to twice that: the rate at which it begins at the least."""

MORE_SWEEPS = 4
"""By how much more often the solver sweeps in the runs that judge it."""

_ENERGY = Watched("system.energy")


@dataclass(frozen=True, slots=True)
class Setting:
    """The cheapest setting that reaches an accuracy.

    Attributes
    ----------
    target
        What was asked for.
    chosen
        The setting, its estimated error and its price.
    judged_by
        What the error is that of, in words.
    verified
        Whether runs with smaller steps were seen to agree; else it is what the order promises.
    in_real_time
        The most accurate setting that can be had in real time, where the chosen one cannot.
    """

    target: float
    chosen: Offer
    judged_by: str
    verified: bool
    in_real_time: Offer | None = None

    @property
    def playable(self) -> Offer:
        """What is taken where somebody looks on."""
        return self.in_real_time or self.chosen

    def __str__(self) -> str:
        told = f"accuracy {self.target:g}: {self.chosen}, judged by {self.judged_by}"
        if self.in_real_time is None:
            return told
        return f"{told}; not in real time, in which there is {self.in_real_time}"


def calibrate(
    level: Level,
    values: Values | None = None,
    target: float = 1e-6,
    budget: float = BUDGET,
    progress: Progress | None = None,
    stop: Stop = never,
) -> Setting:
    """Return the cheapest setting with which a run reaches an accuracy.

    Parameters
    ----------
    level, values
        What is run; the level's default values if left out.
    target
        The largest error that the quantities of the level's checks may have, or, where it has none,
        the places and velocities of its bodies.
    budget
        How long it may take, about [s].
    progress
        Is told how far it is.
    stop
        Is asked now and then whether to give up.

    Raises
    ------
    AccuracyError
        If the accuracy cannot be had, or there is nothing whose accuracy it could be.
    Cancelled
        If `stop` said so.
    SimulationError
        If the level does not run at all.
    """
    values = level.defaults if values is None else values
    wanted, judged_by = _judges(level, values)
    if not target >= FINEST:
        raise AccuracyError(f"an accuracy of {target:g} is below rounding; {FINEST:g} is the least")
    found_out = partial(_offers, level, values, target, budget, progress, stop)
    offers = found_out(wanted)
    verified, chosen = offers.best(target)
    if chosen.error > target and (times := growth(level, values, offers.fine, stop)) > WILD:
        judged_by = f"its energy, for it is chaotic: a small change grows {times:.0e} times"
        offers = found_out((_ENERGY,))
        verified, chosen = offers.best(target)
    if chosen.error > target:
        raise AccuracyError(
            f"an accuracy of {target:g} cannot be had; there is {chosen}, judged by {judged_by}"
        )
    affordable = None if chosen.price <= REAL_TIME else offers.in_real_time()
    return Setting(target, chosen, judged_by, verified, affordable)


def _judges(level: Level, values: Values) -> tuple[tuple[Watched, ...], str]:
    """Return whose errors count, and what that is in words."""
    wanted = watched(level, values)
    if not wanted:
        raise AccuracyError("nothing moves freely, so there is nothing to be accurate")
    checked = any(applies(check, values) for check in level.checks)
    return wanted, "its checks" if checked else "places and velocities"


def _candidates(level: Level, values: Values) -> Iterator[Stepping]:
    """Yield what is tried, from its lowest rate on; the best judge of the others first.

    Where all is smooth it is below the lowest that is chosen, to see by how much that is better.
    """
    rate = foot(level.stepping.rate) / (1 if level.effects.contact else 2)
    while rate * level.duration(values) > FEW and rate > LONGEST:
        rate /= 2
    lowest, floor = rate, _floor(level, values)
    while rate < floor and rate * 2**FEWEST <= HIGHEST_RATE:
        rate *= 2
    start = Stepping(rate=rate, iterations=level.stepping.iterations)
    if not unsmooth(level):
        yield start.model_copy(update={"scheme": "fourth-order", "rate": rate / 2})
    elif contact := level.effects.contact:
        judge = start.model_copy(update={"iterations": min(MORE_SWEEPS * start.iterations, 1000)})
        yield judge
        if contact.located or level.effects.in_sequence:  # which has a price, too
            naive = judge if level.effects.in_sequence else start  # rows at once are for sweeps
            yield naive.model_copy(update={"scheme": "symplectic-euler", "rate": lowest})
    yield start


def _floor(level: Level, values: Values) -> float:
    """Return the rate that the start asks for [Hz]: runs below it can agree on what is wrong.

    It is that after the shortest step, of a scheme that does not wait for piles to settle; 0 where
    there is no such step.
    """
    try:
        world = make_world(level, values, Stepping(rate=HIGHEST_RATE, scheme="symplectic-euler"))
        now = world.advance()
    except SimulationError:
        return 0.0
    contact = level.effects.contact
    found = needs(world.scene, now, (contact and contact.located) or ())
    return max((need.rate for need in found), default=0.0)


def _offers(
    level: Level,
    values: Values,
    target: float,
    budget: float,
    progress: Progress | None,
    stop: Stop,
    wanted: tuple[Watched, ...],
) -> Offers:
    """Climb with all candidates, hold all against the best, and time a step of each [s]."""
    climbers = [
        Climber(level, values, start, wanted, target * CAUTION)
        for start in _candidates(level, values)
    ]
    climb(climbers, budget, stop, progress)
    found = [climber.ladder for climber in climbers if climber.ladder]
    if not found and (failure := climbers[-1].failure):
        raise failure
    if not found:
        raise AccuracyError("the level takes too long to run for its accuracy to be found out")
    best, *others = sorted(found, key=lambda ladder: ladder.errors[-1])
    if level.effects.contact:
        best, *others = found  # only more sweeps of the solver show what it still owes
    ladders = [best, *(held_against(ladder, best, wanted) for ladder in others)]
    return Offers(ladders, step_prices(level, values, ladders))
