"""The contract of a kind of joint: its declaration and its ends (see `docs/how-to/add-a-joint.md`).

A joint is a frozen model beside the others in `sandbox/model/joints/__init__.py`, a member of the
union `Joint` there, with a `kind` as below; `sandbox/physics/joints/make_joint_equations.py` makes
it. The following derive from it: the JSON Schema, the messages about unknown types and bodies, the
quantities of the joint, the accounts of the ledger, the schemes that a level may use, and the tests
of all joints.

The fields that name bodies are recognized by their types, `End` or `BodyName`. Whether a joint
changes with time follows from its formulas.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, get_args

from pydantic import Discriminator, Tag

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect, IncompleteError
from sandbox.model.number_bounds import Coordinate
from sandbox.model.reference_fields import BodyName
from sandbox.model.shapes import Point

FIXED = {"tension": "N", "torque": "N·m", "length": "m", "potential_energy": "J"}
"""The quantities of a joint that keeps an angle."""


def _of_a_line() -> Mapping[str, str]:
    return {"tension": "N", "length": "m", "potential_energy": "J"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """The declaration of a kind of joint."""

    force: Effect | None = None
    """Its declaration as a force; None if it is exact."""
    goes_slack: bool = False
    """Whether it only pulls, so that it can go slack, and become taut with a jerk."""
    drives: bool = False
    """Whether it imposes a motion on its ends under any load, and does work."""
    exerts_torque: bool = False
    """Whether it exerts a torque on a body that it holds by the centre."""
    swings: bool = False
    """Whether it swings sideways while it is taut, as light lines do."""
    points_meet: bool = False
    """Whether its ends must meet at the start, instead of having a certain distance."""
    quantities: Mapping[str, str] = field(default_factory=_of_a_line)
    """Its quantities, with their units."""
    force_name: str = "reaction"
    """The name of its force in a free-body diagram."""


def kinds(joints: Iterable[type[Model]]) -> Mapping[str, Kind]:
    """Return the declarations of all kinds of joints, by their types in a level's file.

    Raises `IncompleteError` if a declaration is missing.
    """
    return {_type(joint): _kind(joint) for joint in joints}


def _type(joint: type[Model]) -> str:
    (name,) = get_args(joint.model_fields["type"].annotation)
    return str(name)


def _kind(joint: type[Model]) -> Kind:
    kind = getattr(joint, "kind", None)
    if not isinstance(kind, Kind):
        place = f"the class {joint.__name__} in {joint.__module__.replace('.', '/')}"
        rule = f"add 'kind: ClassVar[Kind] = Kind(...)' to {place}"
        raise IncompleteError(f"the joint '{_type(joint)}' has no declaration: {rule}")
    return kind


class Held(Model):
    """A point of a body."""

    body: BodyName
    """the body"""
    at: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, relative to the body's position, in its frame"""


ENDS = ("a body", "a point of a body", "a fixed point")
"""The kinds of ends."""


def _end_kind(end: object) -> str | None:
    kinds = ((str,), (Held, Mapping), (list, tuple))
    return next(
        (kind for kind, types in zip(ENDS, kinds, strict=True) if isinstance(end, types)), None
    )


End = Annotated[
    Annotated[BodyName, Tag("a body")]
    | Annotated[Held, Tag("a point of a body")]
    | Annotated[Point, Tag("a fixed point")],
    Discriminator(_end_kind),
]
"""The end of a joint: the centre of a body, a point of it, or a fixed point [x, y] in m."""

BodyEnd = Annotated[
    Annotated[BodyName, Tag("a body")] | Annotated[Held, Tag("a point of a body")],
    Discriminator(_end_kind),
]
"""An end that must be on a body."""
