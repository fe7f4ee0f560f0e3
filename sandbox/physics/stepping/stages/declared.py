"""The list of all stages: what calls for each, and what makes it.

A stage is imported where a level calls for it: what a scene does not need is not even loaded.
"""

from collections.abc import Callable, Iterator, Mapping
from math import isfinite

from sandbox.physics.stepping.stage import Setup, Stage


def declared(setup: Setup) -> Iterator[Stage]:
    """Yield the stages that a level calls for, in the order in which they act."""
    for wanted, make in STAGES.values():
        if wanted(setup):
            yield make(setup)


def _laws(setup: Setup) -> Stage:
    from sandbox.physics.stepping.stages.laws import make

    return make(setup)


def _joints(setup: Setup) -> Stage:
    from sandbox.physics.stepping.stages.joints import make

    return make(setup)


def _cuts(setup: Setup) -> Stage:
    from sandbox.physics.stepping.stages.cuts import make

    return make(setup)


def _sequence(setup: Setup) -> Stage:
    from sandbox.physics.stepping.stages.sequence import make

    return make(setup)


def _direct(setup: Setup) -> Stage:
    from sandbox.physics.stepping.stages.direct import make

    return make(setup)


def _fourth_order(setup: Setup) -> Stage:
    from sandbox.physics.stepping.stages.fourth_order import make

    return make(setup)


def _bounds(setup: Setup) -> Stage:
    from sandbox.physics.stepping.stages.bounds import make

    return make(setup)


def _has_cuts(setup: Setup) -> bool:
    effects = setup.level.effects
    named = (effect and effect.located for effect in (effects.contact, effects.friction))
    return setup.leapfrog and any(located is not None for located in named)


STAGES: Mapping[str, tuple[Callable[[Setup], bool], Callable[[Setup], Stage]]] = {
    "force laws": (lambda s: s.forces.acts, _laws),
    "joints": (lambda s: bool(s.level.joints or s.scene.joints.together), _joints),
    "located impacts, and located ends of slipping": (_has_cuts, _cuts),
    "sequential impacts": (lambda s: s.scene.sequence is not None, _sequence),
    "contacts solved directly": (lambda s: s.scene.direct is not None, _direct),
    "fourth order": (lambda s: s.stepping.scheme == "fourth-order", _fourth_order),
    "the bounds of a crowd's grid": (lambda s: isfinite(s.scene.reach), _bounds),
}
"""What calls for each stage, and what makes it."""
