"""The register of plugins: the condition for each, and its maker.

A plugin is imported only if a level needs it.
"""

from collections.abc import Callable, Iterator, Mapping
from importlib import import_module
from math import isfinite

from sandbox.physics.stepping.step_plugin import Plugin, Setup

_ROOM = __name__.rpartition(".")[0]


def declared(setup: Setup) -> Iterator[Plugin]:
    """Yield the plugins that a level needs, in the order in which they act."""
    for wanted, make in PLUGINS.values():
        if wanted(setup):
            yield make(setup)


def _by(module: str) -> Callable[[Setup], Plugin]:
    """Return a maker that calls the function `make` of a module of this folder."""

    def make(setup: Setup) -> Plugin:
        return import_module(f"{_ROOM}.{module}").make(setup)

    return make


def _has_motions(setup: Setup) -> bool:
    return any(body.motion for body in setup.level.bodies.values())


def _has_cuts(setup: Setup) -> bool:
    effects, alone = setup.level.effects, setup.scene.direct is None
    named = (effect and effect.located for effect in (effects.contact, effects.friction))
    return setup.leapfrog and alone and any(located is not None for located in named)


PLUGINS: Mapping[str, tuple[Callable[[Setup], bool], Callable[[Setup], Plugin]]] = {
    "events that act": (lambda s: s.level.has_events, _by("events_within_step")),
    "force laws": (lambda s: s.forces.acts, _by("force_laws")),
    "motions of kinematic bodies": (_has_motions, _by("kinematic_bodies")),
    "joints": (lambda s: bool(s.level.joints or s.scene.joints.together), _by("non_pymunk_joints")),
    "located impacts, and located ends of slipping": (_has_cuts, _by("impacts_and_slip_ends")),
    "sequential impacts": (lambda s: s.scene.sequence is not None, _by("sequential_impacts")),
    "contacts solved directly": (lambda s: s.scene.direct is not None, _by("direct_solver")),
    "one-way surfaces": (lambda s: s.scene.gates is not None, _by("one_way_gates")),
    "several drifts and kicks": (lambda s: s.stepping.is_composed, _by("composition_substeps")),
    "the bounds of a crowd's grid": (lambda s: isfinite(s.scene.reach), _by("grid_bounds")),
}
"""The condition for each plugin, and its maker."""
