"""What a kind of joint says of itself, once; see `docs/adding-a-joint.md`.

A joint is a frozen model beside the others in `sandbox/model/joints/__init__.py`, a member of the
union `Joint` there, with a `kind` as below; `sandbox/physics/joints/assembly.py` makes it. From
these follow the JSON Schema, the messages about unknown types and bodies, the quantities that can
be measured of it, the accounts of the ledger, the schemes that a level may have, and the tests that
go through all joints.

Which fields name bodies is not said here, but by their type: `End` or `BodyName`. Whether it
changes with time follows from its formulas.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from sandbox.model.effects.contract import Effect


def _of_a_line() -> Mapping[str, str]:
    return {"tension": "N", "length": "m", "potential_energy": "J"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """What a kind of joint says of itself.

    Attributes
    ----------
    force
        What it says of itself as a force; None if it holds exactly.
    goes_slack
        Whether it pulls and never pushes, so that it can go slack, and be jerked taut.
    drives
        Whether it moves what it holds against whatever there is, and does work by that.
    turns
        Whether it gives a torque to what it holds by its centre.
    swings
        Whether it swings across where it is taut, as light lines do.
    points_meet
        Whether what it asks of its start is asked of its ends, and not of a length.
    quantities
        What can be measured of it, and the units of that.
    """

    force: Effect | None = None
    goes_slack: bool = False
    drives: bool = False
    turns: bool = False
    swings: bool = False
    points_meet: bool = False
    quantities: Mapping[str, str] = field(default_factory=_of_a_line)
