"""How the tests are run."""

import gc
import signal
from collections.abc import Iterator
from math import inf

import pytest
from hypothesis import settings

from sandbox.model import number_bounds
from sandbox.model.expressions import Expression

# A slow machine is no counterexample. What is checked is the same every time: a change that fails
# has broken something. To look for more, again and again: pytest --hypothesis-profile=searching
settings.register_profile("repeatable", deadline=None, derandomize=True)
settings.register_profile("searching", deadline=None)
settings.load_profile("repeatable")


@pytest.fixture
def hangups() -> Iterator[None]:
    """Let processes hear that their terminal is closed, even where `nohup` runs the tests."""
    number = getattr(signal, "SIGHUP", signal.SIGTERM)
    before = signal.getsignal(number)
    signal.signal(number, signal.SIG_DFL)
    yield
    signal.signal(number, before)


@pytest.fixture
def boundless(monkeypatch: pytest.MonkeyPatch) -> None:
    """Allow levels any number: the code behind the bounds must work without them, too."""
    for kind in vars(number_bounds).values():
        if isinstance(kind, type) and issubclass(kind, Expression):
            monkeypatch.setattr(kind, "most", inf)
            monkeypatch.setattr(kind, "least", 0.0)


def pytest_collection() -> None:
    """Do not search the collected tests for garbage: they all stay to the end."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Nor during the tests, where this took a tenth of the time."""
    gc.freeze()
    gc.enable()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Start with the longest tests: at the end they would leave cores idle."""
    items.sort(key=_steps, reverse=True)


def _steps(item: pytest.Item) -> float:
    mark = item.get_closest_marker("steps")
    return float(mark.args[0]) if mark else 0.0
