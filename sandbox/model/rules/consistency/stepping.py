"""The stepping fits the simulated scene."""

from collections.abc import Iterator

from sandbox.model.level import FINEST, Level
from sandbox.model.level_parts import Fault
from sandbox.model.message import Message
from sandbox.model.schemes import unsmooth


def scheme_fits(level: Level) -> Iterator[Fault]:
    """Refuse a scheme of fourth order where forces are not smooth."""
    if level.stepping.scheme == "fourth-order" and (rule := unsmooth(level)):
        yield Fault(("stepping", "scheme"), rule)


def accuracy_alone(level: Level) -> Iterator[Fault]:
    """Refuse settings that are given in addition to an accuracy."""
    if level.stepping.accuracy is not None:
        for name in sorted(level.stepping.model_fields_set - {"accuracy"}):
            yield Fault(("stepping", name), "cannot be combined with 'accuracy'; leave out one")


def accuracy_within_reach(level: Level) -> Iterator[Fault]:
    """Refuse an accuracy that no run can reach."""
    asked = level.stepping.accuracy
    if asked is not None and asked < FINEST:
        rule = Message(
            "an accuracy of {asked:g} is below rounding; it must be at least {finest:g}",
            asked=asked,
            finest=FINEST,
        )
        yield Fault(("stepping", "accuracy"), rule)
