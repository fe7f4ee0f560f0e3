"""How the tests are run."""

import gc
from math import inf

import pytest
from hypothesis import settings

from sandbox.model import bounds
from sandbox.model.expressions import Expression

# A slow machine is no counterexample. What is checked is the same every time: a change that fails
# has broken something. To look for more, again and again: pytest --hypothesis-profile=searching
settings.register_profile("repeatable", deadline=None, derandomize=True)
settings.register_profile("searching", deadline=None)
settings.load_profile("repeatable")


@pytest.fixture
def boundless(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let levels hold any number: what stands behind the bounds must hold without them, too."""
    for kind in vars(bounds).values():
        if isinstance(kind, type) and issubclass(kind, Expression):
            monkeypatch.setattr(kind, "most", inf)
            monkeypatch.setattr(kind, "least", 0.0)


def pytest_collection() -> None:
    """Do not look for garbage among what is collected: all of it stays to the end."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Nor while the tests run, as if it were theirs: that took a tenth of their time."""
    gc.freeze()
    gc.enable()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the tests of the most steps: a long one at the end would leave cores idle."""
    items.sort(key=_steps, reverse=True)


def _steps(item: pytest.Item) -> float:
    mark = item.get_closest_marker("steps")
    return float(mark.args[0]) if mark else 0.0
