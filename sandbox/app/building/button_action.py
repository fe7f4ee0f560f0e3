"""An action that a button can offer."""

from collections.abc import Callable
from typing import NamedTuple


class Act(NamedTuple):
    """What stands on the button, what its tool tip says, and what it does."""

    caption: str
    tip: str
    do: Callable[[], object]
