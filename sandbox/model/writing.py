"""A level that a program has made, as the text of a file that people can read."""

import json
from collections.abc import Mapping
from typing import Any


def text(document: Mapping[str, Any]) -> str:
    """Return a level as JSON, a body, joint or check a line."""
    parts = []
    for key, value in document.items():
        said = _json(value)
        if key in ("bodies", "joints"):
            said = _block("{}", [f"{_json(name)}: {_json(part)}" for name, part in value.items()])
        elif key == "checks":
            said = _block("[]", [_json(part) for part in value])
        parts.append(f"  {_json(key)}: {said}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _block(brackets: str, lines: list[str]) -> str:
    return f"{brackets[0]}\n" + ",\n".join(f"    {line}" for line in lines) + f"\n  {brackets[1]}"


def _json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)
