"""Suggestions for misspelt names, and for words that the level format does not use."""

from collections.abc import Collection, Iterable, Iterator
from difflib import SequenceMatcher, get_close_matches

from sandbox.model.translatable_message import NOTHING, Message

_WORDS = {
    # shapes
    "disc": "ball circle disk round sphere wheel",
    "box": "block rect rectangle square",
    "hoop": "ring",
    "segment": "floor ground line wall",
    "polyline": "path track",
    "polygon": "triangle",
    # joints
    "rope": "cable chain cord string thread",
    "rod": "bar distance link",
    "pivot": "axis axle hinge joint pin revolute",
    "weld": "fixed glue",
    "rail": "prismatic slider",
    # effects
    "contact": "collide collision collisions",
    "restitution": "bounce bounciness e elasticity",
    "drag": "air air_resistance damping resistance wind",
    "rotation": "rotate spin torques",
    "magnetic": "b magnetism",
    "field": "electric",
    # quantities, before the keys of the same word
    "position.x": "x",
    "position.y": "height y",
    "velocity.x": "vx",
    "velocity.y": "vy",
    "acceleration.x": "ax",
    "acceleration.y": "ay",
    # keys
    "acceleration": "g gravity value",
    "position": "location pos x y",
    "velocity": "v vel vx vy speed",
    "angular_velocity": "omega rotation spin",
    "angle": "orientation theta turn",
    "friction": "coefficient mu",
    "moment": "inertia",
    "width": "size w",
    "height": "h size",
    "radius": "diameter r",
    "stiffness": "constant k spring_constant",
    "damping": "b c d",
    "length": "distance l natural_length rest_length",
    "ends": "a anchors b between bodies body_a body_b from to",
    "type": "dynamic fixed kinematic kind movable static",
    "linear": "b coefficient",
    "rate": "dt fps frequency hz step timestep",
    "duration": "end time",
    "summary": "description",
    "title": "name",
    "quantity": "measure what",
    "formula": "equals expected value",
    "tolerance": "accuracy eps epsilon error",
    "label": "description name",
    "bodies": "body objects",
    "at": "condition time when",
    "cut": "break release remove",
    "dynamic": "free moving",
    "static": "fixed",
    "kinetic_energy": "ekin kinetic",
    "potential_energy": "epot potential",
    "tension": "force pull",
}
"""Names of the format, and what they are called elsewhere; in the order of preference."""


LONGEST = 100  # characters; nothing longer resembles a name

MOST_NAMES = 1000
"""The number of names above which a name is not compared with them, as each comparison takes 20 µs;
synonyms are found among any number."""

TYPED, ALIKE = 0.85, 0.6
"""The likeness of a name with a typing error, and the least likeness that counts. Words that mean
the same come in between."""


def closest(name: str, known: Iterable[str]) -> str | None:
    """Return the known name that a name stands for elsewhere, or else resembles, if any."""
    choices = {choice.casefold(): choice for choice in sorted(known)}
    name = name[:LONGEST].casefold()
    compared = choices if len(choices) <= MOST_NAMES else ()
    alike = get_close_matches(name, compared, n=1, cutoff=ALIKE)
    is_typing_error = bool(alike) and SequenceMatcher(None, alike[0], name).ratio() >= TYPED
    found = alike if is_typing_error else [*synonyms(name, choices), *alike]
    return choices[found[0]] if found else None


def did_you_mean(name: str, known: Iterable[str]) -> Message:
    """Return "; did you mean 'x'?" if a known name resembles the given one, else nothing."""
    close = closest(name, known)
    return Message("; did you mean '{close}'?", close=close) if close else NOTHING


def suggestion(name: str, known: Iterable[str], *, longest: int = 8) -> Message:
    """Return the end of a message: the name that was probably meant, or all possible names."""
    choices = sorted(known)
    if hint := did_you_mean(name, choices):
        return hint
    if not choices:
        return Message("; there are none")
    shown = ", ".join(choices[:longest]) + (", …" if len(choices) > longest else "")
    return Message("; known: {shown}", shown=shown)


def synonyms(word: str, known: Collection[str]) -> Iterator[str]:
    """Yield the known names that a word stands for, such as `disc` for `circle`.

    Of a quantity, such as `ball.x`, the part after the last dot is the word.
    """
    owner, dot, what = word.casefold().rpartition(".")
    for name, words in _WORDS.items():
        if what in words.split() and (full := f"{owner}{dot}{name}") in known:
            yield full
