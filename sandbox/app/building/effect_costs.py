"""What each effect costs in a step of the level, measured in another process."""

from collections.abc import Mapping

from sandbox.app.background_process import BackgroundTask
from sandbox.app.words.formatting import number
from sandbox.app.words.language import say
from sandbox.editing.edits.effects import costs
from sandbox.model.level import Level


class EffectCosts(BackgroundTask):
    """Measures what each effect costs, for one state of a level at a time."""

    def __init__(self) -> None:
        super().__init__()
        self._version: object = None
        self._found: dict[str, float] = {}

    def measure(self, level: Level, version: object) -> None:
        """Begin to measure the effects of a level."""
        self._version, self._found = version, {}
        self._work.start(costs, level)
        self.news = object()

    def follow(self) -> None:
        """Take what has been measured."""
        for effect, seconds in self._work.results():
            self._found[effect] = seconds
            self.news = object()

    def of(self, version: object) -> Mapping[str, float]:
        """Return the known costs of a step for a state of the level, by effect [s]."""
        return self._found if version is self._version else {}

    def is_for(self, version: object) -> bool:
        """Whether the costs for a state of the level are known, or being measured."""
        return version is self._version


def costs_in_words(costs: Mapping[str, float]) -> str:
    """Return costs as text, such as `friction +3.1 µs`."""
    return ", ".join(f"{say(effect)} {_signed(cost * 1e6)} µs" for effect, cost in costs.items())


def _signed(value: float) -> str:
    """Return a time to two digits, and to a tenth at most: less is noise."""
    value = round(value, 1)
    return f"{'-' if value < 0 else '+'}{number(abs(value), 2)}" if value else "0"
