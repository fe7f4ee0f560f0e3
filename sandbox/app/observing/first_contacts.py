"""The times of the first contacts between bodies in a run."""

from collections.abc import Mapping
from typing import NamedTuple

from sandbox.physics.stepping.world import Pair, World


class FirstContact(NamedTuple):
    """The time of a first contact [s], and whether it was located between two steps."""

    t: float
    located: bool


class FirstContacts:
    """Records first contacts in a world from now on; `note` is called at every step."""

    def __init__(self, world: World) -> None:
        self._world, self._names = world, list(world.scene.bodies)
        self._met: dict[Pair, FirstContact] = {}
        self._note(world.contacts.bodies.tolist())

    @property
    def met(self) -> Mapping[Pair, FirstContact]:
        """The first contacts so far, by pair of bodies."""
        return self._met

    def note(self) -> None:
        """Record a step."""
        contacts = self._world.contacts
        if len(contacts.first) and contacts.first.any():
            for pair, t in self._world.impacts:
                self._met.setdefault(pair, FirstContact(t, located=True))
            self._note(contacts.bodies[contacts.first].tolist())

    def _note(self, pairs: list[list[int]]) -> None:
        for first, second in pairs:
            pair = frozenset((self._names[first], self._names[second]))
            self._met.setdefault(pair, FirstContact(self._world.t, located=False))
