"""Which digits of a level can be trusted, and until when it can be predicted."""

from collections.abc import Iterable

from sandbox.model.level import Level
from sandbox.model.quantities import TIME
from sandbox.physics.accuracy.compared_runs import motion
from sandbox.physics.accuracy.study import trusted
from sandbox.physics.accuracy.trusted_digits import Trust, least_known
from sandbox.physics.state.errors import SimulationError


def digits(level: Level, quantities: Iterable[str]) -> tuple[Trust, ...]:
    """Return the trust in some quantities, preceded by that in the least known position.

    Empty if the level does not run with half of its step.
    """
    checked = [name for name in dict.fromkeys(quantities) if name != TIME.name]
    places = [item.quantity for item in motion(level) if ".position." in item.quantity]
    try:
        found = trusted(level, level.defaults, dict.fromkeys((*places, *checked)))
    except SimulationError:
        return ()
    least = least_known(trust for trust in found if trust.quantity in places)
    rest = [trust for trust in found if trust.quantity in checked and trust is not least]
    return (*([least] if least else []), *rest)
