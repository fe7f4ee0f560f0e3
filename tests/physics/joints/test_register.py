"""Every joint that there is does what its kind says of itself: registered means swept."""

from typing import Any, ClassVar, Literal

import numpy as np
import pytest

from sandbox.model import ledger_accounts
from sandbox.model.base import Model
from sandbox.model.effects.contract import IncompleteError
from sandbox.model.errors import SandboxError
from sandbox.model.joints import KINDS
from sandbox.model.joints.contract import Kind, kinds
from sandbox.model.level import Level
from sandbox.model.quantities import quantities
from sandbox.model.reference_fields import NAMES
from sandbox.model.scheme_requirements import unsmooth
from sandbox.physics.joints.joint_forces import pulls_of
from sandbox.physics.joints.make_joint_equations import _rows
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build
from tests.effects import SCHEMA, Part, resolved
from tests.physics.scenes import GRAVITY, disc, level

KIND = pytest.mark.parametrize("kind", KINDS)


def least(kind: str) -> dict[str, Any]:
    """Return the least that a level may say of a joint between two bodies, by the schema."""
    (choice,) = (
        resolved(option)
        for option in next(iter(SCHEMA["properties"]["joints"]["patternProperties"].values()))[
            "oneOf"
        ]
        if resolved(option)["properties"]["type"]["const"] == kind
    )
    return {name: _value(kind, choice["properties"][name]) for name in choice["required"]}


def _value(kind: str, part: Part, index: int = 0) -> Any:  # noqa: ANN401 (whatever JSON holds)
    part = resolved(part)
    if "const" in part or "enum" in part:
        return part["const"] if "const" in part else part["enum"][0]
    if "oneOf" in part:  # an end: where the points must meet, that of the second is the first's
        return {"body": "b", "at": [-3, 0]} if index and KINDS[kind].points_meet else "ab"[index]
    if part["type"] == "array":
        items = part.get("prefixItems") or [part["items"]] * part.get("minItems", 0)
        if all("number" in resolved(item).get("type", "") for item in items):
            return ["s", "0*s"] if "and s" in str(items) else [-2, 2]
        if len(items) == 1:
            return [[1, 2]]  # a peg
        return [_value(kind, item, i) for i, item in enumerate(items)]
    return "ab"[index] if part.get(NAMES) == "body" else 1


def scene(kind: str, **rest: object) -> Level:
    bodies = {"a": disc((0, 0), mass=1), "b": disc((3, 0), mass=2, angular_velocity=0.1)}
    effects = {**GRAVITY, "rotation": {}}
    return level(bodies, effects, joints={"tie": least(kind)}, **rest)


@KIND
def test_what_a_joint_says_can_be_measured_of_it_is_and_has_that_unit(kind: str) -> None:
    this = scene(kind, stepping={"rate": 240})
    world = build(this)
    found = {q.attribute: q for q in quantities(this) if q.subject == "tie"}
    measured = Meter(world, [q.name for q in found.values()])(world.advance(3))

    assert {name: q.unit for name, q in found.items()} == KINDS[kind].quantities
    assert all(np.isfinite(value) for value in measured.values())


@KIND
def test_a_joint_is_a_force_or_holds_exactly_as_its_kind_says(kind: str) -> None:
    joints = build(scene(kind, stepping={"rate": 240})).scene.joints

    assert ("tie" in joints.springs) is (KINDS[kind].force is not None)
    if KINDS[kind].force is None:
        pulls = pulls_of(joints, 2)
        assert len(pulls.tension) >= 1
        assert bool(pulls.pulls_only.any()) is KINDS[kind].goes_slack
        assert bool(pulls.changes.any()) is KINDS[kind].drives


@KIND
def test_the_books_know_what_a_joint_may_give_and_take(kind: str) -> None:
    this, said = scene(kind), KINDS[kind]

    assert ("joints" in ledger_accounts.works(this)) is said.drives
    assert ("impacts" in ledger_accounts.losses(this)) is said.goes_slack
    assert ("supports" in ledger_accounts.external_accounts(this)) is (said.force is None)
    if said.force:
        assert said.force.account_name in ledger_accounts.potentials(this)


@KIND
def test_what_goes_slack_or_drives_has_no_fourth_order(kind: str) -> None:
    rule = unsmooth(scene(kind)) or ""

    assert bool(rule) is (KINDS[kind].goes_slack or KINDS[kind].drives)
    assert not rule or f"rules out the {kind} 'tie', which" in rule


class Cable(Model):
    """A joint that says nothing of itself."""

    type: Literal["cable"]


class Whole(Model):
    """One that does."""

    kind: ClassVar[Kind] = Kind()
    type: Literal["whole"]
    ends: tuple[str, str]


def test_a_joint_that_nothing_makes_is_told_when_its_level_is_built() -> None:
    unmade = Whole(type="whole", ends=("a", "b"))
    this = scene("rod").model_copy(update={"joints": {"tie": unmade}})

    with pytest.raises(SandboxError, match="no code makes this joint: add Whole to") as told:
        build(this)

    assert "numbers" not in str(told.value)  # they are not to blame


def test_a_joint_in_a_union_without_a_case_is_told() -> None:
    unmade: Any = Whole(type="whole", ends=("a", "b"))

    with pytest.raises(IncompleteError, match="no code makes this joint: add Whole to"):
        _rows("tie", unmade, (), 1.0, {})


def test_a_joint_that_says_nothing_of_itself_is_told_with_its_place() -> None:
    assert kinds([Whole]) == {"whole": Kind()}
    with pytest.raises(IncompleteError) as told:
        kinds([Whole, Cable])

    assert str(told.value) == (
        "the joint 'cable' has no declaration: add 'kind: ClassVar[Kind] = Kind(...)' to the"
        " class Cable in tests/physics/joints/test_register"
    )
