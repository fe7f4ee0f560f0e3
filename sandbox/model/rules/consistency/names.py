"""Every name in a level is used, and refers to something that exists."""

from collections.abc import Iterator
from keyword import iskeyword

from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import brief
from sandbox.model.expression_compiler import RESERVED
from sandbox.model.functions_of_one_variable import VARIABLES, Curve, Formula
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault, expressions
from sandbox.model.named_constants import circle
from sandbox.model.quantities import QuantityError, quantity
from sandbox.model.rules.consistency.references_by_name import (
    couples,
    named_bodies,
    named_quantities,
)
from sandbox.model.translatable_message import NOTHING, Message

LONGEST_CIRCLE = 10
"""The most constants of a cycle that are named; of a longer one, only its two ends."""


def parameters_fit(level: Level) -> Iterator[Fault]:
    """Parameters have values in their ranges, and change something in the scene."""
    if not level.parameters:
        return
    scene, formulas = _used(level, scene=True), _used(level, scene=False)
    for name, parameter in level.parameters.items():
        path = ("parameters", name)
        if _is_taken(name):
            yield Fault(
                path, "'{name}' already has a meaning in formulas; choose another name", name=name
            )
        if parameter.min > parameter.max:
            yield Fault(
                (*path, "min"), "must not be greater than 'max', {most:g}", most=parameter.max
            )
        elif not parameter.min <= parameter.value <= parameter.max:
            rule = Message(
                "must lie between 'min', {least:g}, and 'max', {most:g}",
                least=parameter.min,
                most=parameter.max,
            )
            yield Fault((*path, "value"), rule)
        if name not in scene | formulas:
            yield Fault(path, "'{name}' is declared but nothing uses it", name=name)
        elif name not in scene:
            rule = Message(
                "only checks, ghosts or the landscape use '{name}', so it changes nothing in the"
                " scene",
                name=name,
            )
            yield Fault(path, rule)


def constants_fit(level: Level) -> Iterator[Fault]:
    """Constants have names of their own, and are used."""
    if not level.constants:
        return
    used = set().union(*(expression.names_written for _, expression in expressions(level)))
    for name in level.constants:
        path = ("constants", name)
        if _is_taken(name) or name in VARIABLES:
            yield Fault(
                path, "'{name}' already has a meaning in formulas; choose another name", name=name
            )
        elif name in level.parameters:
            yield Fault(path, "'{name}' is already the name of a parameter", name=name)
        if name not in used:
            yield Fault(path, "'{name}' is declared but nothing uses it", name=name)


def _is_taken(name: str) -> bool:
    return name in RESERVED or iskeyword(name)


def _used(level: Level, *, scene: bool) -> set[str]:
    """Return the names that the scene uses, or else that only its checks use."""
    beside = ("checks", "ghosts", "view", "challenge")
    known = not circle(level.constants)
    used = (
        e.names
        for path, e in expressions(level)
        if not (known and path[0] == "constants")
        if (path[0] == "challenge" or (isinstance(e, Formula) and path[0] in beside)) is not scene
    )
    return set().union(*used)


INSTANTS = ("apex", "contact", "crossing", "landing", "separation")
"""The events at which a check can be made."""


def known_names(level: Level) -> Iterator[Fault]:
    """Expressions use parameters that exist, and no part has a reserved name."""
    named = (
        (path, expression) for path, expression in expressions(level) if expression.names_written
    )
    for path, expression in named:
        known = [*level.parameters, *level.constants, *expression.variables]
        for name in sorted(expression.names_written.difference(known)):
            if name == "t":
                yield Fault(path, "the time 't' has no meaning here")
            else:
                yield Fault(
                    path,
                    "unknown parameter '{name}'{hint}",
                    name=brief(name),
                    hint=_instant(path, name) or suggestion(name, known),
                )
    yield from _taken_names(level)


def _instant(path: Path, name: str) -> Message:
    """Say how an event is given as an instant, if a name is that of one."""
    if path[-1] != "at" or name not in INSTANTS:
        return NOTHING
    return Message('; an event is written {{"event": "{name}", ...}}', name=name)


def _taken_names(level: Level) -> Iterator[Fault]:
    for kind, names in (("bodies", level.bodies), ("joints", level.joints)):
        for name in names:
            if name == "t":
                yield Fault((kind, name), "'t' is the time; choose another name")
            elif name == "system":
                yield Fault((kind, name), "'system' is all bodies together; choose another name")
            elif kind == "joints" and name in level.bodies:
                yield Fault((kind, name), "'{name}' is already the name of a body", name=name)


def no_circle(level: Level) -> Iterator[Fault]:
    """No constant depends on itself."""
    if found := circle(level.constants):
        shown = found if len(found) <= LONGEST_CIRCLE else [*found[:3], "…", *found[-2:]]
        rule = Message(
            "depends on itself: {shown}; constants must not be circular",
            shown=" -> ".join(map(brief, shown)),
        )
        yield Fault(("constants", found[0]), rule)


def variables_apart(level: Level) -> Iterator[Fault]:
    """No parameter or constant has the name of a variable in a formula of the scene."""
    for path, formula in expressions(level):
        own = () if isinstance(formula, Curve) else formula.variables
        if not own or path[0] not in ("effects", "joints"):
            continue
        for kind in ("parameters", "constants"):
            for name in sorted(getattr(level, kind).keys() & set(own)):
                yield Fault(
                    (kind, name),
                    "is a variable in the formula '{path}' over {over}; choose another name",
                    path=".".join(map(str, path)),
                    over=", ".join(own),
                )


def timeless_conditions(level: Level) -> Iterator[Fault]:
    """Conditions of checks do not depend on time."""
    for index, check in enumerate(level.checks):
        if check.valid_if and "t" in check.valid_if.names:
            rule = Message("is a condition on the parameters; it cannot depend on the time 't'")
            yield Fault(("checks", index, "valid_if"), rule)


def known_bodies(level: Level) -> Iterator[Fault]:
    """Named bodies exist, and pairs consist of two."""
    for path, name in named_bodies(level):
        if name not in level.bodies:
            yield Fault(
                path,
                "unknown body '{name}'{hint}",
                name=brief(name),
                hint=suggestion(name, level.bodies),
            )
    for path, names in couples(level):
        if names[0] == names[1]:
            yield Fault(
                path,
                "'{name}' is named twice; two different bodies are needed",
                name=brief(names[0]),
            )


def known_quantities(level: Level) -> Iterator[Fault]:
    """Named quantities exist.

    The accounts of the system depend on the bodies that its joints hold: they are checked only if
    those are known.
    """
    misnamed = next(known_bodies(level), None)
    for path, name in named_quantities(level):
        if misnamed and name.startswith("system."):
            continue
        try:
            quantity(name, level)
        except QuantityError as error:
            yield Fault(path, error.message)
