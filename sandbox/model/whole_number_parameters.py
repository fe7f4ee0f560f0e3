"""Parameters that are used as whole numbers only, such as a number of bodies.

A level need not declare them: all that it does with such a parameter is to round it, or to compare
it with whole numbers.
"""

import ast

from sandbox.model.contained_expressions import expressions
from sandbox.model.level import Level

ROUNDING = frozenset({"floor", "ceil"})


def acts_as_whole_number(level: Level, parameter: str) -> bool:
    """Return whether a level only rounds a parameter, or compares it with whole numbers."""
    found = {str(each.source) for _, each in expressions(level) if parameter in each.names_written}
    return bool(found) and all(_is_rounded(ast.parse(each.strip()), parameter) for each in found)


def _is_rounded(tree: ast.AST, parameter: str) -> bool:
    """Whether a formula only rounds a parameter, or compares it with whole numbers."""
    if isinstance(tree, ast.Name):
        return tree.id != parameter
    if isinstance(tree, ast.Call) and isinstance(tree.func, ast.Name) and tree.func.id in ROUNDING:
        return all(_names(each, parameter) or _is_rounded(each, parameter) for each in tree.args)
    if isinstance(tree, ast.Compare):
        sides = tree.left, *tree.comparators
        return all(_is_whole(side) or _names(side, parameter) for side in sides)
    return all(_is_rounded(part, parameter) for part in ast.iter_child_nodes(tree))


def _is_whole(tree: ast.AST) -> bool:
    value = tree.value if isinstance(tree, ast.Constant) else None
    return isinstance(value, int) or (isinstance(value, float) and value.is_integer())


def _names(tree: ast.AST, parameter: str) -> bool:
    return isinstance(tree, ast.Name) and tree.id == parameter
