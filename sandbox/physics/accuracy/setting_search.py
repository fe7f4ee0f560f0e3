"""The cheapest setting, found by short runs.

Each scheme that the level can use runs at a sequence of rates, each twice the one before, until
the cheapest run that is accurate enough is known. Then a rate between that run and the one before
is tried. If no run is accurate enough yet, a rate is extrapolated by the order of the scheme. A run
at that rate and one at twice the rate confirm it, unless they are too much work.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import log2
from time import thread_time
from typing import Literal

from sandbox.model.contact_solver_choice import is_direct, may_be_direct
from sandbox.model.expressions import Values
from sandbox.model.level import HIGHEST_RATE, Level, Scheme, Stepping
from sandbox.model.scheme_requirements import unsmooth
from sandbox.physics.accuracy.candidate_settings import Candidate, Offers, SearchResult
from sandbox.physics.accuracy.compared_runs import (
    Stop,
    Watched,
    never,
    record,
    record_around,
    scaled,
    stride,
)
from sandbox.physics.accuracy.counted_step_cost import counted_cost
from sandbox.physics.accuracy.event_timing_errors import Onsets, onsets, velocities
from sandbox.physics.accuracy.exceptions import AccuracyError
from sandbox.physics.accuracy.refinement_scheduling import (
    FEWEST,
    Progress,
    Refiner,
    at_rate,
    cost,
    refine,
)
from sandbox.physics.accuracy.step_refinement import (
    NEARLY,
    SPARE,
    Refinement,
    largest_relative_difference,
    lowest_doubled_rate,
    lowest_rate,
    octaves,
    shared_rate,
)
from sandbox.physics.accuracy.unreachable_accuracy import Doubt, OutOfReach
from sandbox.physics.guarding.least_step_rate import required_rate
from sandbox.physics.measuring.recording import Recorder, Trace
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.make_world import make_world

CONFIRMED = 2.0
"""The work of confirming a result, as a multiple of the work of the search."""

FEW = 400
"""The most steps of the first run: a long run may begin at a rate that nobody would choose."""

CLOSER = 4
"""The rate of the run that shows the errors where forces set in or end, as a multiple."""

SMALL = 1e-7
"""The largest target for which sixth and eighth order are tried: for larger ones fourth order is
nearly always cheaper, or the motion is not smooth, and their runs would be work in vain."""

LONGEST = 4.0
"""The first rate of a long run is halved until it is no higher than this [Hz]."""

MORE_SWEEPS = 4
"""How many times as many solver iterations the reference runs have."""


@dataclass(frozen=True, slots=True)
class Seeker:
    """A search for the cheapest setting of a level; the parameters are those of `calibrate`."""

    level: Level
    values: Values
    target: float
    budget: float
    progress: Progress | None
    stop: Stop

    def search(self, items: Sequence[Watched]) -> SearchResult:
        """Return the cheapest setting that reaches the target, or else the most accurate.

        Raises `AccuracyError` if the level takes too long to run, `Cancelled` if `stop` returned
        true, and `SimulationError` if the level does not run at all.
        """
        started = thread_time()
        if self.progress:
            self.progress(0.0, at_rate("leapfrog", self.level.stepping.rate))
        doubt = Doubt(items, self.target, self.stop, started, self.budget)
        try:
            own = own_run(self.level, self.values, items, self.stop, doubt)
        except OutOfReach as known:
            return self._out_of_reach(known.runs, known.items)
        items = scaled(items, own) if own else items
        refiners = [
            Refiner(self.level, self.values, start, items, self.target, known_run=own)
            for start in _candidates(self.level, self.values, self.target)
        ]
        refinements = refine(
            refiners, self.budget, self.stop, self.progress, doubt.started, CONFIRMED * self.budget
        )
        if not refinements and (failure := refiners[-1].failure):
            raise failure
        if not refinements:
            raise AccuracyError("the level takes too long to run to search for its accuracy")
        offers = Offers(refinements, [cost(refiners, refinement) for refinement in refinements])
        chosen = self._choose(offers, items)
        if chosen.error > self.target and chosen.stepping.is_stock:
            others = chosen, self._choose(offers.without_stock, items)
            chosen = min(others, key=lambda found: max(found.error, self.target))
        if chosen.error > self.target and chosen.trace is None:
            chosen = offers.measured(self.target)
        return SearchResult(self.level, self.values, self.target, items, offers, chosen)

    def _out_of_reach(self, known: Refinement, items: Sequence[Watched]) -> SearchResult:
        """Return the best of the runs that show that the target is out of reach."""
        run = known.traces[-1]
        offers = Offers([known], [counted_cost(run.level, run.values, run.stepping)])
        best = offers.measured(self.target)
        return SearchResult(known.traces[0].level, self.values, self.target, items, offers, best)

    def _choose(self, offers: Offers, items: Sequence[Watched]) -> Candidate:
        """Return the cheapest setting of those offered, or the most accurate."""
        chosen = offers.best(self.target)
        if chosen.trace is None:
            chosen = self._confirm(chosen, items)
        elif chosen.error <= self.target:
            chosen = self._between_runs(chosen, offers, items)
        if chosen.error <= self.target and stride(chosen.stepping.rate) > 1:
            return self._check_every_step(chosen, offers.refinements[0].traces[-1], items)
        return chosen

    def _run(self, stepping: Stepping, items: Sequence[Watched]) -> Trace:
        return record(self.level, self.values, stepping, items, self.stop)

    def _between_runs(
        self, chosen: Candidate, offers: Offers, items: Sequence[Watched]
    ) -> Candidate:
        """Return a setting at a rate between the chosen run and the one before, if it will do."""
        best = offers.refinements[0]
        refinement = next(found for found in offers.refinements if chosen.trace in found.traces)
        rate = refinement.rate_between(self.target)
        if rate is None:
            return chosen
        stepping = chosen.stepping.at(rate)
        with suppress(SimulationError):
            trace = self._run(stepping, items)
            error = largest_relative_difference(trace, best.traces[-1], items)[0] + best.errors[-1]
            if refinement.own_error is not None:
                own = largest_relative_difference(trace, refinement.traces[-1], items)[0]
                error = max(error, own + refinement.own_error)
            if error <= self.target:
                return Candidate(stepping, error, trace, chosen.work * rate / chosen.stepping.rate)
        return chosen

    def _confirm(self, chosen: Candidate, items: Sequence[Watched]) -> Candidate:
        """Return an extrapolated setting with its measured error, unless that is too much work."""
        rate, work = chosen.stepping.rate, 3 * chosen.work * self.level.duration(self.values)
        if work > CONFIRMED * self.budget or 2 * rate > HIGHEST_RATE:
            return chosen
        try:
            run, finer = (self._run(chosen.stepping.at(r), items) for r in (rate, 2 * rate))
        except SimulationError:
            return chosen._replace(error=float("inf"))
        difference = largest_relative_difference(run, finer, items)[0]
        unknown = difference / (2 ** (NEARLY * chosen.stepping.order) - 1)
        return self._lower_rate(
            chosen._replace(error=difference + unknown, trace=run), finer, unknown, items
        )

    def _lower_rate(
        self, chosen: Candidate, finer: Trace, unknown: float, items: Sequence[Watched]
    ) -> Candidate:
        """Return a setting at the lowest rate found that will do, given a run of known error.

        Each rate is where the error would be as requested, by the order of the scheme: a setting
        that was extrapolated may be far more accurate than that.
        """
        while 0 < chosen.error <= self.target:
            stepping = chosen.stepping
            ratio = (chosen.error / (SPARE * self.target)) ** (1 / stepping.order)
            rate = shared_rate(
                max(ratio * stepping.rate, lowest_rate(stepping)), finer.stepping.rate
            )
            if rate >= stepping.rate:
                break
            try:
                run = self._run(stepping.at(rate), items)
            except SimulationError:
                break
            error = largest_relative_difference(run, finer, items)[0] + unknown
            if error > self.target:
                break
            chosen = Candidate(stepping.at(rate), error, run, chosen.work * rate / stepping.rate)
        return chosen

    def _check_every_step(
        self, chosen: Candidate, best: Trace, items: Sequence[Watched]
    ) -> Candidate:
        """Return a setting that is as accurate where forces set in or end, if there is one.

        These steps may not be among those that were compared, nor the first ones, in which stock
        pymunk lets bodies fall that rest. Lower rates than the one that certainly suffices may do,
        and are tried first. If no rate is sufficient, the setting is returned with its error there.
        """
        found = onsets(best, items, chosen.stepping.rate, self.target)
        if chosen.stepping.is_stock:
            found = Onsets([0.0, *found.times], velocities(best, items), found.rate)
        present = self._check_onsets(chosen, found)
        if present.error <= self.target or not 0 < found.rate <= HIGHEST_RATE:
            return present
        own = chosen.stepping.rate
        for halvings in range(max(int(log2(found.rate / own)), 0), -1, -1):
            rate = shared_rate(found.rate / 2**halvings, own)
            work = rate / own * chosen.work
            finer = self._check_onsets(
                chosen._replace(stepping=chosen.stepping.at(rate), work=work), found
            )
            if finer.error <= self.target:
                return finer
        return present

    def _check_onsets(self, chosen: Candidate, onsets: Onsets) -> Candidate:
        """Return a setting with its error around the times when forces set in or end."""
        if not onsets.times:
            return chosen
        rate, trace = chosen.stepping.rate, chosen.trace
        if (1 + CLOSER) * chosen.work * self.level.duration(self.values) > CONFIRMED * self.budget:
            worst, item, trace = self.target * onsets.rate / rate, onsets.items[0], None
        else:
            run, finer = (
                record_around(
                    self.level, self.values, chosen.stepping.at(parts * rate),
                    onsets.items, onsets.times, self.stop, parts,
                )
                for parts in (1, CLOSER)
            )  # fmt: skip
            difference, worst_item = largest_relative_difference(run, finer, onsets.items)
            worst, item = difference * CLOSER / (CLOSER - 1), worst_item or onsets.items[0]
        if worst <= chosen.error:
            return chosen
        return chosen._replace(error=worst, trace=trace, decided_by=item.quantity)


def own_run(
    level: Level,
    values: Values,
    items: Sequence[Watched],
    stop: Stop = never,
    inspect: Callable[[Recorder], None] | None = None,
) -> Trace | None:
    """Return a run at the level's own rate, from which motion gets its scales.

    None if no motion is watched, so that nothing is run for it, or if it has to stop. `inspect` is
    called now and then. Raises `Cancelled` if `stop` returned true.
    """
    if not any(item.motion for item in items):
        return None
    solver = "direct" if _may_pile(level) else level.stepping.solver
    declared = level.stepping
    own = Stepping(rate=declared.rate, iterations=declared.iterations, solver=solver)
    with suppress(SimulationError):
        return record(level, values, own, items, stop, inspect=inspect)
    return None


def _candidates(level: Level, values: Values, target: float) -> Iterator[Stepping]:
    """Yield the steppings to try, each at its lowest rate; the best reference comes first.

    For a smooth level it begins below the lowest rate that may be chosen, to show its order.
    """
    rate = lowest_doubled_rate(level.stepping.rate) / (1 if level.effects.contact else 2)
    while rate * level.duration(values) > FEW and rate > LONGEST:
        rate /= 2
    lowest, floor = rate, _lowest_rate(level, values)
    while rate < floor and rate * 2**FEWEST <= HIGHEST_RATE:
        rate *= 2
    declared = level.stepping
    solver: Literal["iterative"] | None = "iterative" if _may_pile(level) else None
    start = Stepping(rate=rate, iterations=declared.iterations, solver=declared.solver or solver)
    if not unsmooth(level):
        yield from (
            _composed_start(start.model_copy(update={"scheme": scheme}))
            for scheme in _high_orders(target)
        )
    elif contact := level.effects.contact:
        if _may_pile(level):
            yield start.model_copy(update={"solver": "direct"})
        judge = start  # the direct solver takes no sweeps
        if not is_direct(level, start):
            more = min(MORE_SWEEPS * start.iterations, 1000)
            judge = start.model_copy(update={"iterations": more})
            yield judge
        if contact.located or level.effects.in_sequence:  # locating and sequences cost time
            naive = judge if level.effects.in_sequence else start  # rows together need more sweeps
            yield naive.model_copy(update={"scheme": "symplectic-euler", "rate": lowest})
    yield start


def _composed_start(start: Stepping) -> Stepping:
    """Return where a composed scheme begins, given where leapfrog does: its steps may be longer."""
    rate = start.rate / 2 ** (octaves(start) - 1)
    while rate < 1:
        rate *= 2
    return start.at(rate)


def _high_orders(target: float) -> tuple[Scheme, ...]:
    """Return the schemes of higher order that are worth trying where all is smooth."""
    high: tuple[Scheme, ...] = ("sixth-order", "eighth-order")
    return ("fourth-order", *(high if target <= SMALL else ()))


def _may_pile(level: Level) -> bool:
    """Whether bodies may rest on others, so that a direct contact solver is worth trying.

    Bodies that hit several others at once rebound differently with it, and a single body that rests
    on immovable ones needs only a few sweeps.
    """
    if level.stepping.solver or not may_be_direct(level) or (level.joints and is_direct(level)):
        return False
    if level.effects.restitution or level.effects.sticking:
        return False
    return sum(body.type == "dynamic" for body in level.bodies.values()) > 1


def _lowest_rate(level: Level, values: Values) -> float:
    """Return the rate that the beginning needs [Hz]: runs below it can agree on a wrong result.

    It follows from the state after the shortest step, with a scheme that does not wait for piles to
    settle; 0 if that step is impossible.
    """
    try:
        world = make_world(level, values, Stepping(rate=HIGHEST_RATE, scheme="symplectic-euler"))
        snapshot = world.advance()
    except SimulationError:
        return 0.0
    contact = level.effects.contact
    return required_rate(world.scene, snapshot, (contact and contact.located) or ())
