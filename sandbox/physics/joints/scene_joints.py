"""The joints of a scene, for its steps and for measurements."""

from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.state.motion import Motion
from sandbox.physics.state.snapshot import Snapshot

if TYPE_CHECKING:
    from sandbox.physics.forces.spring import SpringForce
    from sandbox.physics.joints.composite_bodies import Solids, Touches
    from sandbox.physics.joints.exact.bead_on_wire import WireEquation
    from sandbox.physics.joints.exact.joint_system import JointSystem
    from sandbox.physics.joints.exact.shake import ExactJoints
    from sandbox.physics.joints.pulley import PulleyString
    from sandbox.physics.joints.pymunk_joints import OwnJoint
    from sandbox.physics.state.joint_anchors import Anchor


NO_PAIRS: Integers = np.empty((0, 2), dtype=np.intp)


@dataclass(slots=True, kw_only=True)
class Joints:
    """All j joints of a scene, in the level's order; by default none."""

    paths: "dict[str, tuple[Anchor, ...]]" = field(default_factory=dict)
    """The points that each joint runs through, by name; for a wire, points of its curve."""
    lines: list[str] = field(default_factory=list)
    """The names of rods, ropes and strings, which can oscillate transversely when they are taut."""
    wires: "dict[str, WireEquation]" = field(default_factory=dict)
    """The equations that keep bodies on wires, by name."""
    springs: "dict[str, SpringForce]" = field(default_factory=dict)
    """The joints that are force laws, by name."""
    strings: "dict[str, PulleyString]" = field(default_factory=dict)
    """The strings that are solved by themselves, by name."""
    own: "dict[str, OwnJoint]" = field(default_factory=dict)
    """The joints that pymunk solves, by name."""
    together: "ExactJoints | None" = None
    """All other exact joints; None if there are none."""
    radii: dict[str, float] = field(default_factory=dict)
    """The radii of the circles on which strings are wound, by name [m]."""
    twists: bool = False
    """Whether any joint exerts a torque."""
    solids: "Solids | None" = None
    """The bodies that are welded or stuck together; None if there can be none."""
    touches: "Touches | None" = None
    """Finds the pairs that have met and are to stick; None if none are."""
    weld: Callable[[str, str], None] | None = None
    """Welds two bodies where they are."""
    elastic: "JointSystem | None" = None
    """The sides of elastic stops; None if there are none."""
    latches: "Latches | None" = None
    """The joints that events tie; None if there are none."""
    cut: dict[str, float] = field(default_factory=dict)
    """The times at which joints were cut, by name [s]."""

    @property
    def joined(self) -> Integers:
        """(k, 2), the indices of the bodies that were joined into one solid."""
        return self.solids.pairs if self.solids else NO_PAIRS

    def length(self, name: str, motion: Motion) -> Array:
        """Return the length of a joint from end to end, without the part that is wound [m]."""
        from sandbox.physics.state.joint_anchors import path_length

        distance = path_length(self.paths[name], motion)
        radius = self.radii.get(name)
        return distance if radius is None else np.sqrt(distance**2 - radius**2)

    def time(self, kick: float, drift: float) -> None:
        """Set the durations of the next kicks, and of the drift after each [s]."""
        for own in self.own.values():
            own.time(kick, drift)
        if self.together:
            self.together.time(kick, drift)

    def refit(self, t: float) -> None:
        """Keep the present lengths from a time on [s]."""
        for string in self.strings.values():
            string.refit()
        for own in self.own.values():
            own.refit()
        for wire in self.wires.values():
            wire.forget()
        if self.together:
            self.together.refit(t)

    def holds(self, name: str, t: float) -> bool:
        """Return whether a joint is tied and not cut at a time [s]."""
        is_open = self.latches is not None and self.latches.is_open(name, t)
        return not (is_open or t >= self.cut.get(name, np.inf))

    def parting(self) -> tuple[str, float]:
        """Return the joint of `together` with the largest residual, and the residual [m, rad]."""
        return self.together.largest_residual() if self.together else ("", 0.0)

    def tension(self, name: str, snapshot: Snapshot) -> Array:
        """Return the force by which a joint pulls, or a wire pushes to its left: (...) [N]."""
        if spring := self.springs.get(name):
            return spring.tension(snapshot)
        return snapshot.tension[..., list(self.paths).index(name)]

    def tensions(self) -> Array:
        """Return the forces by which joints pulled in the last kick, 0 for springs: (j,) [N]."""
        return np.array([self._tension(name) for name in self.paths], dtype=float)

    def _tension(self, name: str) -> float:
        if name in self.strings:
            return self.strings[name].tension
        if name in self.cut or name in self.springs:
            return 0.0
        if name in self.own:
            return self.own[name].tension
        assert self.together
        force = self.together.force(name)
        return -force if name in self.wires else force

    def torque(self) -> Array:
        """Return the torque of each joint on its second body in the last kick: (j,) [N m]."""
        torque = np.zeros(len(self.paths))
        if self.twists:
            for i, name in enumerate(self.paths):
                if name in self.cut:
                    continue
                if name in self.own:
                    torque[i] = self.own[name].torque
                elif self.together:
                    torque[i] = self.together.torque(name)
        return torque


@dataclass(frozen=True, slots=True)
class Latches:
    """The joints of a scene that events tie."""

    names: frozenset[str]
    """The names of these joints, which are inactive until they are tied."""
    tie: Callable[[Collection[str], float], None]
    """Ties joints that are solved together with others, at a time [s]."""
    tied: dict[str, float] = field(default_factory=dict)
    """The times at which joints were tied, by name [s]."""

    def is_open(self, name: str, t: float) -> bool:
        """Return whether a joint is still open at a time [s]."""
        return name in self.names and not t >= self.tied.get(name, np.inf)
