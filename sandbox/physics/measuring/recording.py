"""Recorded runs: named quantities over time."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import ceil
from typing import TYPE_CHECKING

import numpy as np

from sandbox.extras import needed_for
from sandbox.model.expressions import Array, Values
from sandbox.model.level import (
    ApexEvent,
    CrossingEvent,
    Instant,
    LandingEvent,
    Level,
    Stepping,
)
from sandbox.model.parts import measured
from sandbox.model.quantities import TIME, quantity
from sandbox.physics.energy.closure import Closing
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.engine.batch import Integers
from sandbox.physics.measuring.meter import Meter
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import Pair, World

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset

MANY = 1000
"""How many snapshots are kept before they are measured, at the most."""

STATES = 1_000_000
"""How many states of bodies these may hold together: some 100 MB."""

LARGEST = 1e9
"""Bytes of what is recorded of a run, at the most."""


@dataclass(frozen=True, slots=True)
class Trace:
    """What was recorded of a run; T instants.

    Attributes
    ----------
    level, values, stepping
        What was run.
    t
        (T,), times [s].
    columns
        (T,) each, the quantities by name.
    units
        The quantities' units.
    first_contacts
        For each pair of bodies that came to touch, the index of the first instant at which it did;
        those that touch from the start must part before.
    impact_times
        For those whose first impact was located, when it was [s]: before that instant.
    closing
        How the books of its energy closed; None if none were kept.
    """

    level: Level
    values: Values
    stepping: Stepping
    t: Array
    columns: Mapping[str, Array]
    units: Mapping[str, str]
    first_contacts: Mapping[Pair, int]
    impact_times: Mapping[Pair, float]
    closing: Closing | None = None

    @property
    def smooth(self) -> bool:
        """Whether nothing in it may jump."""
        return self.stepping.scheme == "fourth-order"

    @property
    def complete(self) -> bool:
        """Whether it lasts as long as its level says, but for rounding."""
        return bool(self.t[-1] >= self.level.duration(self.values) * (1 - 1e-12))

    def until(self, t: float) -> "Trace":
        """Return the part of the run up to a time [s]: to the first step not before it."""
        count = _steps(t, self.stepping.rate) + 1
        first_contacts = {pair: i for pair, i in self.first_contacts.items() if i < count}
        return replace(
            self,
            t=self.t[:count],
            columns={name: column[:count] for name, column in self.columns.items()},
            first_contacts=first_contacts,
            impact_times={p: t for p, t in self.impact_times.items() if p in first_contacts},
        )

    def to_pandas(self) -> "DataFrame":
        """Return it as a table: a row for each instant [s], a column for each quantity.

        The units stand in `attrs["units"]`.

        Raises
        ------
        SandboxError
            If pandas is not installed.
        """
        with needed_for("a table of a trace", "notebook"):
            from pandas import DataFrame, Index
        columns = {name: values for name, values in self.columns.items() if name != TIME.name}
        frame = DataFrame(columns, index=Index(self.t, name=f"{TIME.name} [{TIME.unit}]"))
        frame.attrs["units"] = {name: self.units[name] for name in columns}
        return frame

    def to_xarray(self) -> "Dataset":
        """Return it as a dataset over the coordinate `t`; each variable has its unit in `attrs`.

        Raises
        ------
        SandboxError
            If xarray is not installed.
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


class Recorder:
    """Watches a world and notes quantities, step by step; with a ledger where one asks for it."""

    def __init__(self, world: World, names: Iterable[str]) -> None:
        self._world = world
        wanted = [quantity(name, world.level) for name in dict.fromkeys(names)]
        self._meter = Meter(world, [q.name for q in wanted if not q.booked])
        self._booked = {q.name: q for q in wanted if q.booked}
        self._ledger = Ledger(world) if self._booked else None
        self._books: list[list[float]] = []
        self._names = list(world.scene.bodies)
        self._fresh: list[Snapshot] = []  # not yet measured
        self._last: list[Snapshot] = []  # the last that was, from which integrals go on
        self._measured: list[tuple[Array, dict[str, Array]]] = []
        self._count = 0
        self._contacts: dict[Pair, int] = {}
        self._touching: set[int] = set()  # pairs that do now, as numbers
        self._impacts: dict[Pair, float] = {}
        self._many = min(MANY, max(STATES // len(self._names), 1))
        self._most = int(LARGEST / np.dtype(float).itemsize / (1 + len(wanted)))
        self.note()

    def __len__(self) -> int:
        return self._count

    def note(self) -> None:
        """Note the world's last observed state."""
        for pair, time in self._world.impacts:
            if pair not in self._contacts:
                self._impacts.setdefault(pair, time)
        self._touch(self._world.contacts.bodies)
        if self._ledger:
            self._ledger.note()
            balance = self._ledger.balance
            self._books.append([balance.value(q) for q in self._booked.values()])
        self._fresh.append(self._world.snapshot)
        self._count += 1
        if len(self._fresh) == self._many:
            self._measure()

    def require(self, count: int) -> None:
        """Refuse to record so many instants, if they are more than memory should hold.

        Raises
        ------
        SimulationError
            If they are.
        """
        if count > self._most:
            told = f"{count:,} instants are to be recorded, and with so many quantities"
            hint = "record fewer, or for a shorter time"
            reason = f"{told} {self._most:,} are the most that {LARGEST / 1e9:g} GB hold"
            raise SimulationError("", self._world.t, reason, hint=hint)

    def _touch(self, bodies: Integers) -> None:
        """Note which pairs touch, (k, 2), that did not at the step before."""
        touching = set((bodies @ (len(self._names), 1)).tolist()) if len(bodies) else set()
        for key in touching - self._touching if self._count else ():
            pair = frozenset(self._names[row] for row in divmod(key, len(self._names)))
            self._contacts.setdefault(pair, self._count)
        self._touching = touching

    def _measure(self) -> None:
        """Measure what is fresh, and let go of its snapshots."""
        if self._fresh:
            known = len(self._last)
            stack = Snapshot.stack([*self._last, *self._fresh])
            columns = self._meter(stack)
            for name, found in self._meter.quantities.items():
                if known and found.adds_up:
                    columns[name] = columns[name] + self._measured[-1][1][name][-1]
            fresh = {name: column[known:] for name, column in columns.items()}
            self._measured.append((stack.t[known:], fresh))
            self._last = self._fresh[-1:]
            self._fresh.clear()

    @property
    def trace(self) -> Trace:
        """Everything noted so far."""
        self._measure()
        if len(self._measured) > 1:
            times, parts = zip(*self._measured, strict=True)
            joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
            self._measured = [(np.concatenate(times), joined)]
        t, measured = self._measured[0]
        kept = np.array(self._books).reshape(self._count, len(self._booked))
        columns = {**measured, **dict(zip(self._booked, kept.T, strict=True))}
        quantities = {**self._meter.quantities, **self._booked}
        units = {name: found.unit for name, found in quantities.items()}
        world = self._world
        return Trace(
            world.level,
            world.values,
            world.stepping,
            t,
            columns,
            units,
            self._contacts,
            self._impacts,
        )


def count_steps(world: World, duration: float | None = None) -> int:
    """Return how many steps reach a duration [s], that of the level if left out."""
    if duration is None:
        duration = world.level.duration(world.values)
    return _steps(duration, world.stepping.rate)


def _steps(duration: float, rate: float) -> int:
    return ceil(duration * rate * (1 - 1e-12))


def needed(level: Level) -> list[str]:
    """Return the quantities without which its checks and its challenge cannot be graded."""
    names = (name for _, one in measured(level) for name in needed_at(one.quantity, one.at))
    return list(dict.fromkeys(names))


def needed_at(quantity: str, at: Instant | None) -> list[str]:
    """Return a quantity and the one that tells when an instant has come."""
    match at:
        case CrossingEvent(quantity=crossing):
            return [quantity, crossing]
        case ApexEvent(body=body):
            return [quantity, f"{body}.velocity.y"]
        case LandingEvent(body=body):
            return [quantity, f"{body}.position.y"]
        case _:
            return [quantity]
