"""The places where a level names its parts, found from the types of its fields."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from sandbox.model.annotated_field_search import marked
from sandbox.model.base import Model
from sandbox.model.effects import EFFECTS
from sandbox.model.effects.friction import Friction
from sandbox.model.effects.restitution import Restitution
from sandbox.model.json_positions import Path
from sandbox.model.last_result_cache import of_the_last
from sandbox.model.level import Level
from sandbox.model.reference_fields import Mention


class Mentioned(NamedTuple):
    """A name, or a list of names, in a level."""

    path: Path
    value: Any
    mention: Mention


def mentions(part: Model, path: Path = ()) -> Iterator[Mentioned]:
    """Yield everything that a part of a level names, with its path."""
    if isinstance(part, Level) and not path:
        return iter(_all_of(part))
    return (Mentioned(*found) for found in marked(part, Mention, path))


@of_the_last
def _all_of(level: Level) -> Sequence[Mentioned]:
    """Return everything that a level names, cached because nearly every rule needs it."""
    return [Mentioned(*found) for found in marked(level, Mention)]


def named_bodies(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield every mention of a body, with its path."""
    return ((path, name) for path, name, mention in mentions(level) if mention.of == "body")


def named_quantities(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield every mention of a quantity, with its path."""
    return ((path, name) for path, name, mention in mentions(level) if mention.of == "quantity")


def named_parameters(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield every parameter that is named outside of a formula, with its path."""
    return ((path, name) for path, name, mention in mentions(level) if mention.of == "parameter")


def acted_on(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield the bodies that an effect acts on."""
    return ((path, name) for path, name, mention in mentions(level) if mention.acted_on)


def bodies_of_effect(level: Level, settings: Model) -> Sequence[str]:
    """Return the bodies that an effect acts on: those that it names, else all dynamic ones."""
    named = [name for _, name, mention in mentions(settings) if mention.acted_on]
    dynamic = (name for name, body in level.bodies.items() if body.type == "dynamic")
    return tuple(dict.fromkeys(named or dynamic))


def lists_of_bodies(level: Level) -> Iterator[tuple[Path, tuple[str, ...]]]:
    """Yield the lists of bodies that an effect acts on."""
    return ((path, names) for path, names, mention in mentions(level) if mention.of == "bodies")


def couples(level: Level) -> Iterator[tuple[Path, tuple[str, str]]]:
    """Yield every mention of a pair of bodies."""
    return ((path, names) for path, names, mention in mentions(level) if mention.of == "couple")


def bodies_of_flows(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield the bodies whose mass changes."""
    changing = {name for name, effect in EFFECTS.items() if effect.changes_mass}
    for path, name in acted_on(level):
        if path[0] == "effects" and path[1] in changing:
            yield path, name


def coefficients(level: Level) -> dict[str, Friction | Restitution]:
    """Return the effects that have a coefficient for each body."""
    return {
        effect.name: settings
        for effect, _, settings in level.effects.settings
        if effect.coefficient
    }
