"""The joints of a scene, as a step needs them and as they are measured."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Integers
from sandbox.physics.state.motion import Motion
from sandbox.physics.state.snapshot import Snapshot

if TYPE_CHECKING:
    from sandbox.physics.forces.spring import SpringForce
    from sandbox.physics.joints.exact.joint_system import JointSystem
    from sandbox.physics.joints.exact.shake import ExactJoints
    from sandbox.physics.joints.exact.wire import WireEquation
    from sandbox.physics.joints.latches import Latches
    from sandbox.physics.joints.pulley import PulleyString
    from sandbox.physics.joints.pymunk_joints import OwnJoint
    from sandbox.physics.joints.welded_bodies import Solids, Touches
    from sandbox.physics.state.anchor import Anchor

NO_PAIRS: Integers = np.empty((0, 2), dtype=np.intp)


@dataclass(slots=True, kw_only=True)
class Joints:
    """All joints of a scene; j of them, in the level's order. None, unless said otherwise.

    Attributes
    ----------
    paths
        The points that each runs through, by name; of a wire, points of its curve.
    lines
        The names of rods, ropes and strings, which swing across when they are taut.
    wires
        What keeps bodies on wires, by name.
    springs, strings, own, together
        Those that are force laws, are solved by themselves, and are solved by pymunk, by name; all
        other exact ones, None if there are none.
    radii
        Of the circles on which strings are wound, by name [m].
    twists
        Whether any holds bodies against turning.
    solids
        Who is welded or stuck to whom; None if nobody can be.
    touches, weld
        Tells which of the pairs that stick have met, None if none do; welds two, by name.
    elastic, latches
        The sides of stops that give back speed, and what ties open joints; None if there are none.
    cut
        When joints were cut, by name [s].
    """

    paths: "dict[str, tuple[Anchor, ...]]" = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)
    wires: "dict[str, WireEquation]" = field(default_factory=dict)
    springs: "dict[str, SpringForce]" = field(default_factory=dict)
    strings: "dict[str, PulleyString]" = field(default_factory=dict)
    own: "dict[str, OwnJoint]" = field(default_factory=dict)
    together: "ExactJoints | None" = None
    radii: dict[str, float] = field(default_factory=dict)
    twists: bool = False
    solids: "Solids | None" = None
    touches: "Touches | None" = None
    weld: Callable[[str, str], None] | None = None
    elastic: "JointSystem | None" = None
    latches: "Latches | None" = None
    cut: dict[str, float] = field(default_factory=dict)

    @property
    def joined(self) -> Integers:
        """(k, 2), who is part of one solid with whom, as numbers."""
        return self.solids.pairs if self.solids else NO_PAIRS

    def length(self, name: str, motion: Motion) -> Array:
        """Return how long a joint is, from end to end, or as far as it is not wound [m]."""
        from sandbox.physics.state.anchor import length

        distance = length(self.paths[name], motion)
        radius = self.radii.get(name)
        return distance if radius is None else np.sqrt(distance**2 - radius**2)

    def time(self, kick: float, drift: float) -> None:
        """Set how long the next kicks last, and the drift that follows each [s]."""
        for own in self.own.values():
            own.time(kick, drift)
        if self.together:
            self.together.time(kick, drift)

    def refit(self, t: float) -> None:
        """Take the present lengths as those that hold from a time on [s]."""
        for string in self.strings.values():
            string.refit()
        for own in self.own.values():
            own.refit()
        for wire in self.wires.values():
            wire.forget()
        if self.together:
            self.together.refit(t)

    def holds(self, name: str, t: float) -> bool:
        """Whether a joint is there at a time [s]."""
        is_open = self.latches is not None and self.latches.is_open(name, t)
        return not (is_open or t >= self.cut.get(name, np.inf))

    def parting(self) -> tuple[str, float]:
        """Return which of those solved together is furthest off, and by how much [m, rad]."""
        return self.together.parting() if self.together else ("", 0.0)

    def tension(self, name: str, snapshot: Snapshot) -> Array:
        """Return the force with which a joint pulls, or a wire pushes to its left: (...) [N]."""
        if spring := self.springs.get(name):
            return spring.tension(snapshot)
        tension: Array = snapshot.tension[..., list(self.paths).index(name)]
        return tension

    def tensions(self) -> Array:
        """Return the force with which each joint that is solved pulls now; 0 of springs: (j,)."""
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
        """Return the torque of each joint on its second body in the last kick [N m]."""
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
