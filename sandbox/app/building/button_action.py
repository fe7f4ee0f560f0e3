"""An action offered by a button."""

from collections.abc import Callable
from typing import NamedTuple


class ButtonAction(NamedTuple):
    """The caption of a button, its tooltip, and the function that it calls."""

    caption: str
    tip: str
    do: Callable[[], object]
