"""The declaration of an effect is complete, or the missing part is named; the rest follows."""

from pkgutil import iter_modules
from types import GenericAlias
from typing import Any, ClassVar

import pytest
from pydantic import create_model

from sandbox.model import effects, ledger_accounts
from sandbox.model.base import Model
from sandbox.model.effects import EFFECTS, Effects, magnetic
from sandbox.model.effects.contract import Effect, IncompleteError, register
from sandbox.model.levels_with_changed_effects import DEFAULTS, including
from sandbox.model.number_bounds import Strength
from sandbox.model.reference_fields import ActedOn
from tests.effects import examples
from tests.model.levels import Data, bare, level, touching


class Silent(Model):
    """Declares nothing."""


class Misnamed(Model):
    """Has two names."""

    effect: ClassVar[Effect] = Effect(name="other")


class Weak(Model):
    """Names as its strength a field that it does not have."""

    effect: ClassVar[Effect] = Effect(name="thing", strength=("strength",))
    mu: Strength


class Unsoftened(Model):
    """Is softened by a field that it does not have."""

    effect: ClassVar[Effect] = Effect(name="thing", book="potential", softening="epsilon")


class Bookless(Model):
    """Is a force, and does not say what becomes of energy."""

    effect: ClassVar[Effect] = Effect(name="thing", depends_on=("position",))


class Turning(Model):
    """A complete declaration."""

    effect: ClassVar[Effect] = Effect(name="thing", depends_on=("velocity",), strength=("mu",))
    mu: Strength
    body: ActedOn


def listed(effect: type[Model]) -> type[Model]:
    """Return a manifest that lists one effect, several times over."""
    fields: dict[str, Any] = {"thing": (GenericAlias(tuple, (effect, ...)) | None, None)}
    made: type[Model] = create_model("Manifest", __base__=Model, **fields)
    return made


def test_an_effect_that_is_whole_is_registered() -> None:
    assert register(listed(Turning)) == {"thing": Turning.effect}
    assert Turning.effect.rotates_velocity, "what does no work though it sees velocities"


@pytest.mark.parametrize(
    ("effect", "told"),
    [
        (
            Silent,
            "the effect 'thing' has no declaration: add 'effect: ClassVar[Effect] ="
            ' Effect(name="thing", ...)\' to the class Silent in tests/model/test_register.py',
        ),
        (
            Misnamed,
            "'thing' in the list of effects has another name: the class Misnamed in"
            " tests/model/test_register.py says 'other'",
        ),
        (
            Weak,
            "the effect 'thing' is not told in full: the class Weak in"
            " tests/model/test_register.py has no field 'strength', which its declaration names",
        ),
        (
            Unsoftened,
            "the effect 'thing' is not told in full: the class Unsoftened in"
            " tests/model/test_register.py has no field 'epsilon', which its declaration names",
        ),
        (
            Bookless,
            "the effect 'thing' is not told in full: the class Bookless in"
            " tests/model/test_register.py does not say 'book', what becomes of the energy that it"
            " takes",
        ),
    ],
)
def test_an_effect_that_is_not_whole_is_told_with_its_place(effect: type[Model], told: str) -> None:
    with pytest.raises(IncompleteError) as found:
        register(listed(effect))

    assert str(found.value) == told


def test_two_models_of_the_same_name_are_refused_with_both_places() -> None:
    """Even one in the list of another: the schema of a level names its parts by their classes."""
    twin = create_model("Charge", __base__=Model, __module__="sandbox.model.effects.coulomb")
    fields: dict[str, Any] = {
        "charge": (twin | None, None),
        "charges": (GenericAlias(tuple, (magnetic.Charge, ...)), ()),
    }
    other = create_model("Coulomb", __base__=Turning, **fields)

    with pytest.raises(IncompleteError) as found:
        register(listed(other))

    assert str(found.value) == (
        "two models are named Charge: one in sandbox/model/effects/coulomb.py and one in"
        " sandbox/model/effects/magnetic.py; rename one of them"
    )


def test_an_effect_has_a_module_of_its_name_and_each_module_is_in_the_list() -> None:
    for name, field in Effects.model_fields.items():
        assert f"sandbox.model.effects.{name}." in str(field.annotation)
    for found in iter_modules(effects.__path__):
        known = found.name in {*EFFECTS, "contract"}
        assert known, f"add a field '{found.name}' to the class Effects, {effects.__file__}"


@pytest.mark.parametrize("name", DEFAULTS)
def test_what_can_be_tried_can_be_tried(name: str) -> None:
    """Each on a ball above a floor, or beside another."""
    data = touching()
    data["bodies"]["other"] = data["bodies"]["ball"] | {"position": [5, 5]}
    for body in data["bodies"].values():
        del body["friction"], body["restitution"]
    contact: Data = {} if name == "contact" else {"contact": {}}
    data |= {"effects": contact, "parameters": {}, "checks": [], "ghosts": {}}
    for body in ("ball", "other"):
        data["bodies"][body]["mass"] = 1

    assert name in including(level(data), name, {}).effects.declared


FORCES = [name for name, effect in EFFECTS.items() if effect.is_force]


@pytest.mark.parametrize("name", FORCES)
def test_a_force_has_the_account_that_it_says(name: str) -> None:
    books = {
        "potential": ledger_accounts.potentials,
        "work": ledger_accounts.works,
        "loss": ledger_accounts.losses,
    }
    effect = EFFECTS[name]
    for said in examples(name):
        data = bare()
        ball = data["bodies"]["ball"] | {"mass": 5}
        places = {"a": [3, 0], "b": [-3, 0], "c": [0, 3]}
        data["bodies"] = {body: ball | {"position": at} for body, at in places.items()}
        data |= {"parameters": {}, "checks": [], "ghosts": {}, "effects": {name: said}}
        data["effects"]["rotation"] = {}
        for body in data["bodies"].values():
            body["angular_velocity"] = 1
        this = level(data)
        (one,) = (one for found, _, one in this.effects.settings if found.name == name)

        assert (name in ledger_accounts.external_accounts(this)) is not effect.is_internal
        for book, names in books.items():
            assert (effect.account_name in names(this)) is (effect.book_of(one) == book)
