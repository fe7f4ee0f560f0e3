"""Recorded runs: named quantities over time."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from sandbox.garbage_collection_pause import uncollected
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Instant, Level, Stepping
from sandbox.model.level_parts import measured
from sandbox.model.measuring_instants import MOST_MEETINGS, Passage, crossing_of
from sandbox.model.quantities import TIME, aggregated, quantity
from sandbox.model.translatable_message import Message
from sandbox.optional_packages import needed_for
from sandbox.physics.energy.balance_check import Closing
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.measuring.running_aggregates import over_time
from sandbox.physics.measuring.tunnelling_detection import HighestSpeeds
from sandbox.physics.measuring.unbalanced_contacts import Unbalanced
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import Pair, World

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset

    from sandbox.physics.guarding.least_step_rate import RateBound

Met = TypeVar("Met")

MANY = 1000
"""The most snapshots to collect before they are measured."""

STATES = 1_000_000
"""The most states of bodies in these snapshots: some 100 MB."""

LARGEST = 1e9
"""The largest size of a recorded run, in bytes."""


class Meeting(NamedTuple):
    """The time at which two bodies began to touch."""

    step: int
    """The first instant at which they touch."""
    time: float | None
    """The time of the impact [s], before that instant, if it was located."""


@dataclass(frozen=True, slots=True)
class Trace:
    """A recorded run; T instants."""

    level: Level
    values: Values
    stepping: Stepping
    t: Array
    """(T,), times [s]."""
    columns: Mapping[str, Array]
    """(T,) each, the quantities by name."""
    units: Mapping[str, str]
    """The quantities' units."""
    meetings: Mapping[Pair, Sequence[Meeting]]
    """When each pair of bodies began to touch, at most `MOST_MEETINGS` times. Bodies that touch at
    the start must separate before they can meet."""
    partings: Mapping[Pair, Sequence[int]]
    """The steps at which each pair of bodies separated, at most `MOST_MEETINGS` of them."""
    may_lean: bool = False
    """Whether the forces on bodies at rest at the start were not found: a pile may then lean."""
    unbalanced: float = 0.0
    """The share of the forces that sweeps left unbalanced in a pile; see `Unbalanced`."""
    closing: Closing | None = None
    """How its energy books closed; None if none were kept."""
    missed_passages: "tuple[RateBound, ...]" = ()
    """Bodies that may have passed through others within a step, with the rates that prevent it."""

    @property
    def smooth(self) -> int:
        """The order of a composed scheme, which requires that nothing jumps; 0 for others."""
        return self.stepping.order if self.stepping.is_composed else 0

    @property
    def impacts(self) -> list[float]:
        """The times of all impacts that were located, in order [s]."""
        times = {m.time for met in self.meetings.values() for m in met if m.time is not None}
        return sorted(times)

    @property
    def complete(self) -> bool:
        """Whether it lasts for the duration of its level, apart from rounding."""
        return bool(self.t[-1] >= self.level.duration(self.values) * (1 - 1e-12))

    def until(self, t: float) -> "Trace":
        """Return the run up to and including the first step at or after a time [s]."""
        count = self.stepping.steps(t) + 1
        met = {p: [m for m in instants if m.step < count] for p, instants in self.meetings.items()}
        parted = {p: [i for i in instants if i < count] for p, instants in self.partings.items()}
        return replace(
            self,
            t=self.t[:count],
            columns={name: column[:count] for name, column in self.columns.items()},
            meetings={pair: instants for pair, instants in met.items() if instants},
            partings={pair: instants for pair, instants in parted.items() if instants},
        )

    def to_pandas(self) -> "DataFrame":
        """Return the trace as a table: a row for each instant [s], a column for each quantity.

        The units are in `attrs["units"]`. Raises `SandboxError` if pandas is not installed.
        """
        with needed_for("a table of a trace", "notebook"):
            from pandas import DataFrame, Index
        columns = {name: values for name, values in self.columns.items() if name != TIME.name}
        frame = DataFrame(columns, index=Index(self.t, name=f"{TIME.name} [{TIME.unit}]"))
        frame.attrs["units"] = {name: self.units[name] for name in columns}
        return frame

    def to_xarray(self) -> "Dataset":
        """Return the trace as a dataset over `t`; each variable has its unit in `attrs`.

        Raises `SandboxError` if xarray is not installed.
        """
        with needed_for("a dataset of a trace", "notebook"):
            from xarray import Dataset, Variable
        variables = {
            name: Variable(TIME.name, values, {"units": self.units[name]})
            for name, values in self.columns.items()
            if name != TIME.name
        }
        t = Variable(TIME.name, self.t, {"units": TIME.unit})
        return Dataset(variables, {TIME.name: t}, {"title": self.level.title})


def may_lean(world: World) -> bool:
    """Return whether the solver did not settle the bodies at rest at the start of a run."""
    settling = world.kicks.settling
    return bool(settling and settling.is_unsettled and not world.scene.direct)


class Recorder:
    """Records quantities of a world, step by step; keeps a ledger if a quantity needs one."""

    @uncollected()
    def __init__(self, world: World, names: Iterable[str]) -> None:
        self._world = world
        requested = [quantity(name, world.level) for name in dict.fromkeys(names)]
        self._aggregates = {q.name: q for q in requested if q.aggregate}
        plain = (quantity(aggregated(q), world.level) if q.aggregate else q for q in requested)
        wanted = {q.name: q for q in plain}.values()
        self._from_ledger = {q.name: q for q in wanted if q.needs_ledger}
        self._pair_forces = {q.name: q for q in wanted if q.is_pair_force}
        separate = self._from_ledger.keys() | self._pair_forces.keys()
        self._meter = Meter(world, [q.name for q in wanted if q.name not in separate])
        self._ledger = Ledger(world) if self._from_ledger else None
        self._ledger_rows: list[list[float]] = []
        self._force_rows: list[list[float]] = []
        self._names = list(world.scene.bodies)
        self._unmeasured: list[Snapshot] = []  # not yet measured
        self._last: list[Snapshot] = []  # the last one measured, from which integrals continue
        self._measured: list[tuple[Array, dict[str, Array]]] = []
        self._count = 0
        self._may_lean, self._unbalanced = may_lean(world), Unbalanced(world)
        self._speeds = HighestSpeeds(world)
        self._meetings: dict[Pair, list[Meeting]] = {}
        self._partings: dict[Pair, list[int]] = {}
        self._touching: set[int] = set()  # pairs that touch now, as numbers
        self._block = min(MANY, max(STATES // len(self._names), 1))
        self._most_instants = int(LARGEST / np.dtype(float).itemsize / (1 + len(wanted)))
        self.note()

    def __len__(self) -> int:
        return self._count

    def note(self) -> None:
        """Record the world's last observed state."""
        self._unbalanced.note()
        struck = self._world.impacts
        for pair, time in struck:
            _add(self._meetings, pair, Meeting(self._count, time))
        self._note_contacts(self._world.contacts.bodies, {pair for pair, _ in struck})
        if self._ledger:
            self._ledger.note()
            balance = self._ledger.balance
            self._ledger_rows.append([balance.value(q) for q in self._from_ledger.values()])
        if self._pair_forces:
            self._force_rows.append([*self._contact_forces()])
        self._unmeasured.append(self._world.snapshot)
        self._count += 1
        if len(self._unmeasured) == self._block:
            self._measure()

    @property
    def is_full(self) -> bool:
        """Whether it has reached its largest size."""
        return self._count >= self._most_instants

    def require(self, count: int) -> None:
        """Refuse to record more instants than fit in memory.

        Raises `SimulationError` if there are more.
        """
        if count > self._most_instants:
            hint = Message("record fewer, or for a shorter time")
            reason = Message(
                "{count:,} instants are to be recorded, but with so many quantities {size:g} GB"
                " hold at most {most:,}",
                count=count,
                most=self._most_instants,
                size=LARGEST / 1e9,
            )
            raise SimulationError("", self._world.t, reason, hint=hint)

    def _note_contacts(self, bodies: Integers, struck: Collection[Pair]) -> None:
        """Record which pairs, (k, 2), have begun to touch since the step before, or separated.

        Pairs with a located impact in between, `struck`, are recorded already.
        """
        touching = set((bodies @ (len(self._names), 1)).tolist()) if len(bodies) else set()
        for key in touching - self._touching if self._count else ():
            if (pair := self._pair(key)) not in struck:
                _add(self._meetings, pair, Meeting(self._count, None))
        for key in self._touching - touching:
            _add(self._partings, self._pair(key), self._count)
        self._touching = touching

    def _pair(self, key: int) -> Pair:
        return frozenset(self._names[row] for row in divmod(key, len(self._names)))

    def _contact_forces(self) -> Iterator[float]:
        """Yield the requested contact forces between two bodies [N]."""
        contacts, now = self._world.contacts, self._world.snapshot
        for wanted in self._pair_forces.values():
            kind = wanted.attribute.partition(".")[2]
            pair = [*map(self._names.index, (wanted.subject, wanted.other))]
            impulse, force = getattr(contacts, kind), getattr(now, kind)[pair[0]]
            own = (contacts.bodies == pair[0]).any(axis=-1)
            shared = own & (contacts.bodies == pair[1]).any(axis=-1)
            total = float(impulse[own].sum())
            yield float(force * impulse[shared].sum() / total) if total else 0.0

    def _measure(self) -> None:
        """Measure the new snapshots, and drop them."""
        if self._unmeasured:
            count = len(self._last)
            stack = Snapshot.stack([*self._last, *self._unmeasured])
            columns = self._meter(stack)
            for name, found in self._meter.quantities.items():
                if count and found.is_integral:
                    columns[name] = columns[name] + self._measured[-1][1][name][-1]
            new_columns = {name: column[count:] for name, column in columns.items()}
            self._measured.append((stack.t[count:], new_columns))
            self._speeds.note(stack)
            self._last = self._unmeasured[-1:]
            self._unmeasured.clear()

    def _joined(self) -> tuple[Array, dict[str, Array]]:
        """Measure the new snapshots, and join what was measured in parts."""
        self._measure()
        if len(self._measured) > 1:
            times, parts = zip(*self._measured, strict=True)
            joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
            self._measured = [(np.concatenate(times), joined)]
        return self._measured[0]

    @property
    def ledger(self) -> Ledger | None:
        """The ledger that it keeps; None if no quantity needs one."""
        return self._ledger

    def keep_first(self, count: int) -> None:
        """Drop all but the first instants, now that the world is back at the last of them.

        The world has no contacts, and its ledger was put back with it. A copy of the recorder keeps
        all instants, but must record no further ones.
        """
        t, columns = self._joined()
        self._measured = [(t[:count], {name: each[:count] for name, each in columns.items()})]
        self._unmeasured, self._last, self._count = [], [self._world.snapshot], count
        self._ledger_rows, self._force_rows = self._ledger_rows[:count], self._force_rows[:count]
        met = self._meetings.items()
        self._meetings = {pair: [m for m in each if m.step < count] for pair, each in met}

    @property
    def trace(self) -> Trace:
        """Everything recorded so far."""
        t, measured = self._joined()
        columns = dict(measured)
        for names, rows_so_far in (
            (self._from_ledger, self._ledger_rows),
            (self._pair_forces, self._force_rows),
        ):
            rows = np.array(rows_so_far).reshape(self._count if names else 0, len(names))
            columns |= dict(zip(names, rows.T, strict=True))
        for name, found in self._aggregates.items():
            columns[name] = over_time(found.aggregate, t, columns[aggregated(found)])
        quantities = {
            **self._meter.quantities,
            **self._from_ledger,
            **self._pair_forces,
            **self._aggregates,
        }
        units = {name: quantities[name].unit for name in columns}
        world = self._world
        return Trace(
            world.level,
            world.values,
            world.stepping,
            t,
            columns,
            units,
            self._meetings,
            self._partings,
            self._may_lean,
            self._unbalanced.fraction,
            missed_passages=self._speeds.bounds,
        )


def _add(to: dict[Pair, list[Met]], pair: Pair, entry: Met) -> None:
    entries = to.setdefault(pair, [])
    if len(entries) < MOST_MEETINGS:
        entries.append(entry)


def count_steps(world: World, duration: float | None = None) -> int:
    """Return the number of steps for a duration [s]; that of the level if left out."""
    if duration is None:
        duration = world.level.duration(world.values)
    return world.stepping.steps(duration)


def needed(level: Level) -> list[str]:
    """Return the quantities that the level's checks and its challenge need."""
    names = (name for _, one in measured(level) for name in needed_at(one.quantity, one.at))
    return list(dict.fromkeys(names))


def needed_at(quantity: str, at: Instant | None) -> list[str]:
    """Return a quantity and the one that locates an instant."""
    return [quantity, crossing_of(at)[0]] if isinstance(at, Passage) else [quantity]
