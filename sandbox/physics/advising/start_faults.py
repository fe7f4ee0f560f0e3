"""All faults of a level at its start; building its world would report only the first."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from sandbox.model.level import HIGHEST_RATE, Level
from sandbox.model.translatable_message import Message
from sandbox.physics.contacts.detection.overlaps_at_start import overlaps, tolerated
from sandbox.physics.scene.make_scene import make_scene
from sandbox.physics.state.simulation_errors import JointFailure, SimulationError


class Fault(NamedTuple):
    """A reason why a level cannot start."""

    reason: Message
    names: frozenset[str]
    """The bodies and joints that it is about."""


def start_faults(level: Level) -> list[Fault]:
    """Return the overlaps of a level at its start, and the first joint that fails there.

    Nothing is run: faults that only a step reveals are not found.
    """
    with np.errstate(all="ignore"):  # non-finite values are reported by name
        return list(_faults(level))


def _faults(level: Level) -> Iterator[Fault]:
    stepping, contact, values = level.stepping, level.effects.contact, level.defaults
    if stepping.accuracy is not None:
        stepping = stepping.at(HIGHEST_RATE)
    try:
        scene = make_scene(_allowing_overlaps(level), values, stepping)
        if scene.joints.together:
            scene.joints.together.check()
    except SimulationError as error:
        yield Fault(error.reason, frozenset({error.subject}))
        return
    except JointFailure as error:
        yield Fault(error.reason, frozenset({error.joint}))
        return
    if contact and not contact.overlaps:
        smallest = tolerated(scene.space, contact, values)
        pairs = overlaps(scene.bodies, smallest, scene.hollows, scene.gates)
        for pair in sorted(set(pairs), reverse=True):
            yield Fault(pair.reason, frozenset(pair.bodies))


def _allowing_overlaps(level: Level) -> Level:
    contact = level.effects.contact
    if contact is None:
        return level
    allowed = contact.model_copy(update={"overlaps": True})
    effects = level.effects.model_copy(update={"contact": allowed})
    return level.model_copy(update={"effects": effects})
