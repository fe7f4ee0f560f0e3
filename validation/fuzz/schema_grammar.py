"""Random levels from the schema itself, which thus always cover everything that is declared."""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from random import Random
from typing import Any

from sandbox.model.reference_fields import NAMES
from sandbox.model.write_json_schema import grammar

Part = Mapping[str, Any]

ORDINARY: Sequence[float | str] = (0, 1, -1, 0.5, 2, 3, 0.1, 10, -0.3, "p", "q/2", "-p", "pi*q")
HOSTILE: Sequence[float | str] = (
    1e-300, 5e-324, 1e300, -1e300, 1e15, -1e15, 1e-15, 1e35, 1e-35, 1e12, 1e9, 1e-9, 1e6,
    "1/(p - 1)", "10**p", "log(p - 1)", "exp(700*p)", "where(p > 1, 1, 0)", "p % q", "nobody",
)  # fmt: skip
VARYING: Sequence[str] = ("{0}", "sin(9*{0})", "1 + 0.1*{0}", "1/{0}", "exp(9*{0})", "{0}**2")
"""Formulas of the time, a position, a velocity, or the parameter of a wire or a landscape."""

_VARIABLES = re.compile(r"in the parameters and (\w+(?:, \w+)*)")

WILD = 0.06
"""The probability of a hostile number; a level has dozens, and one is enough."""

RARE = 0.25
"""The probability of an optional field."""

BODIES = ("a", "b", "c", "d", "e")
JOINTS = ("j1", "j2", "j3", "j4")
QUANTITIES = (
    "system.energy", "a.position.x", "b.speed", "system.loss.friction", "t", "j1.tension",
    "a.angle.max", "b.velocity.y.mean", "a.relative.b.distance", "a.contact.b.normal",
    "a.acceleration", "system.unexplained_energy", "system.center.y", "j1.length.integral",
)  # fmt: skip


@cache
def _schema() -> dict[str, Any]:
    return grammar()


class Grammar:
    """Generates random levels, most of them well formed."""

    def __init__(self, random: Random) -> None:
        self._schema = _schema()
        self._random = random
        self._bodies = BODIES[: random.choice((1, 2, 2, 3, 5))]
        self._joints = JOINTS[: random.choice((0, 0, 1, 1, 2, 4))]
        self._names: Mapping[str, Sequence[str]] = {
            "body": self._bodies,
            "joints": self._joints or JOINTS,
            "forces": tuple(self._schema["$defs"]["Effects"]["properties"]),
            "parameter": ("p", "q"),
            "quantity": QUANTITIES,
        }

    def level(self) -> dict[str, Any]:
        """Return a level as in its file."""
        fields: Mapping[str, Part] = self._schema["properties"]
        random = self._random
        made: dict[str, Any] = {"format": 1, "title": "fuzz"}
        made["parameters"] = {name: self._parameter(fields["parameters"]) for name in ("p", "q")}
        made["bodies"] = {name: self._of_mapping(fields["bodies"]) for name in self._bodies}
        made["effects"] = self.value(fields["effects"])
        made["joints"] = {name: self._of_mapping(fields["joints"]) for name in self._joints}
        for name, field in fields.items():
            if name not in made and name != "$schema" and random.random() < RARE:
                made[name] = self.value(field)
        return made

    def _parameter(self, part: Part) -> dict[str, Any]:
        """Return a parameter, most likely with a default value inside its limits."""
        random, drawn = self._random, self._of_mapping(part)
        if random.random() < WILD:
            return dict(drawn)
        limits = {"min": random.choice((0.5, 1, -1, 0)), "max": random.choice((1, 2))}
        return {**drawn, "value": 1, **limits}

    def value(self, part: Part) -> Any:  # noqa: ANN401 (whatever JSON holds)
        """Return a value that a part of the schema allows, or almost."""
        if "$ref" in part:
            part = self._schema["$defs"][part["$ref"].rpartition("/")[2]]
        if "oneOf" in part:
            return self.value(self._random.choice(part["oneOf"]))
        if "const" in part or "enum" in part:
            return part["const"] if "const" in part else self._random.choice(part["enum"])
        kind = part["type"]
        if kind == "object":
            return self._object(part)
        if kind == "array":
            return self._list(part)
        if kind == "string":
            return self._text(part)
        return self._random.random() < 0.5 if kind == "boolean" else self._number(part)

    def _of_mapping(self, part: Part) -> Any:  # noqa: ANN401 (whatever JSON holds)
        (inside,) = part["patternProperties"].values()
        return self.value(inside)

    def _object(self, part: Part) -> dict[str, Any]:
        if "patternProperties" in part:
            names = self._names.get(part.get(NAMES, ""), ("one", "two"))
            return {name: self._of_mapping(part) for name in names}
        needed = part.get("required", ())
        fields: Mapping[str, Part] = part.get("properties", {})
        usual = RARE if len(fields) > 2 else 0.6
        return {
            name: self.value(inside)
            for name, inside in fields.items()
            if name in needed or self._random.random() < usual
        }

    def _list(self, part: Part) -> list[Any]:
        if "prefixItems" in part:
            return [self.value(item) for item in part["prefixItems"]]
        least = part.get("minItems", 0)
        count = min(least + self._random.choice((0, 0, 1, 2, 5)), part.get("maxItems", 9))
        item = {NAMES: part[NAMES], **part["items"]} if NAMES in part else part["items"]
        return [self.value(item) for _ in range(count)]

    def _text(self, part: Part) -> str:
        random = self._random
        if names := self._names.get(part.get(NAMES, "")):
            return random.choice(names if random.random() > WILD else ("nobody",))
        return "#4cc9f0" if "pattern" in part else random.choice(("", "text", "\u200b"))

    def _number(self, part: Part) -> float | str:
        random = self._random
        least = part.get("minimum", part.get("exclusiveMinimum", -1e308))
        most = part.get("maximum", part.get("exclusiveMaximum", 1e308))
        if random.random() < WILD:
            return random.choice((*HOSTILE, least, most))
        if "string" not in part["type"]:
            usual = (1, 10) if part["type"] == "integer" else (1, 60, 240, 1e-3, 10)
            return min(random.choice(usual), most / 2)
        variables = _VARIABLES.search(part.get("$comment", ""))
        if variables and random.random() < 0.5:
            return random.choice(VARYING).format(random.choice(variables[1].split(", ")))
        if random.random() < 0.4:
            return round(random.uniform(max(least, -5), min(most, 5)), 2)
        fitting = (n for n in ORDINARY if isinstance(n, str) or least < n <= most)
        return random.choice([n for n in fitting if least < 0 or not str(n).startswith("-")])
