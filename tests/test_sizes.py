"""No module and no function of the packages is too long to be read at one go."""

import ast
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

MODULE = 350
"""The most lines of a module."""
FUNCTION = 45
"""The most lines of a function, its docstring included."""


def test_modules_and_functions_are_short() -> None:
    long = []
    for path in (
        path for name in ("sandbox", "validation") for path in (ROOT / name).rglob("*.py")
    ):
        text, name = path.read_text(encoding="utf-8"), path.relative_to(ROOT)
        if (lines := len(text.splitlines())) > MODULE:
            long.append(f"{name} has {lines} lines; divide it into modules of at most {MODULE}")
        for part in ast.walk(ast.parse(text)):
            if isinstance(part, ast.FunctionDef) and part.end_lineno is not None:
                lines = part.end_lineno - part.lineno + 1
                if lines > FUNCTION:
                    long.append(f"{name}: {part.name} has {lines} lines, of at most {FUNCTION}")
    assert not long, "\n".join(long)
