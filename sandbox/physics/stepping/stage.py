"""The contract of a stage: a part of a step that only some levels need.

A step is a drift and a kick. Whatever else a level declares takes part in it as a *stage*: it says
at which moments it acts, and leaves the others out. In the order of a step, these are

    before_drift    between two kicks: it may change places and velocities, and must then tell the
                    forces by how much velocities jumped (`Forces.shift`, `Forces.restart`)
    in_kick         after pymunk's drift, before it kicks: it may give forces, and change velocities
    after_kick      after pymunk's solver: it may change velocities
    after_step      when the step is counted

and beside the steps

    started         the first kick was found
    refit           somebody has put bodies elsewhere, from where the run goes on

A stage in a kick also acts in those of bodies that are held where they are, again and again until
nothing changes, and gives the same each time. It never looks at the world, and at another stage
only through what the scene has for both.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.scene.scene import Scene
from sandbox.physics.state.kick import Work
from sandbox.physics.stepping.applied_forces import Forces
from sandbox.physics.stepping.kicks import Kicks

if TYPE_CHECKING:
    from sandbox.physics.energy.step_record import StepRecord
    from sandbox.physics.events.impact_response import Impact

Act = Callable[[], None]


class Setup(NamedTuple):
    """What a stage is made of: the level, its scene, its forces, and its kicks."""

    level: Level
    values: Values
    stepping: Stepping
    scene: Scene
    forces: Forces
    kicks: Kicks

    @property
    def leapfrog(self) -> bool:
        """Whether velocities are half a step from places; else it is stock pymunk."""
        return not self.stepping.is_stock


Begin = Callable[[Setup], None] | None
"""Puts a scene where its run begins, if that is not the level's start."""


class Stage(NamedTuple):
    """The moments at which a stage acts, and what it tells; see the contract above.

    Attributes
    ----------
    before_drift, after_step
        Act without being told anything.
    in_kick, after_kick
        Act in the kick that they are told.
    started
        Takes the velocities before the first kick and the accelerations in it, (n, 3) each [m/s,
        rad/s, m/s², rad/s²]; returns those right at the start if it knows them better.
    refit
        Takes the time [s].
    contacts
        Returns the contacts of the last kick, if pymunk does not have them.
    impacts
        Returns the impacts at their own times in the last drift.
    begun
        Returns the velocities that the last kick began with, if not those of the step before it:
        (n, 3) [m/s, rad/s].
    record
        Adds to the record of a step what the stage did in it.
    calls
        How often a step calls Python for it, but for what acts in kicks.
    """

    before_drift: Act | None = None
    in_kick: Work | None = None
    after_kick: Work | None = None
    after_step: Act | None = None
    started: Callable[[Array, Array], Array | None] | None = None
    refit: Callable[[float], None] | None = None
    contacts: Callable[[], Contacts] | None = None
    impacts: "Callable[[], Sequence[Impact]] | None" = None
    begun: Callable[[], Array] | None = None
    record: "Callable[[StepRecord], StepRecord] | None" = None
    calls: int = 0


class Stages:
    """The stages of a world, one after the other at each moment.

    Attributes
    ----------
    before_drift, after_step
        What acts then; most levels have nothing.
    started, refit, contacts, impacts, begun, record
        See `Stage`.
    calls
        How often a step calls Python for all of them, but for what acts in kicks.
    """

    def __init__(self, stages: Sequence[Stage], kicks: Kicks) -> None:
        self.before_drift = tuple(s.before_drift for s in stages if s.before_drift)
        self.after_step = tuple(s.after_step for s in stages if s.after_step)
        self.started = tuple(s.started for s in stages if s.started)
        self.refit = tuple(s.refit for s in stages if s.refit)
        self.contacts = next((s.contacts for s in stages if s.contacts), None)
        self.impacts = next((s.impacts for s in stages if s.impacts), None)
        self.begun = next((s.begun for s in stages if s.begun), None)
        self.record = tuple(s.record for s in stages if s.record)
        self.calls = sum(s.calls for s in stages)
        kicks.call(
            [s.in_kick for s in stages if s.in_kick],
            [s.after_kick for s in stages if s.after_kick],
        )


def set_up(
    level: Level, values: Values, stepping: Stepping, scene: Scene, begin: Begin = None
) -> Setup:
    """Return what the stages of a world are made of."""
    contact = level.effects.contact is not None
    # joints take turns with contacts: there their last pull acts from the start of a kick
    pulling = scene.joints.together if contact and scene.direct is None else None
    forces = Forces(scene, pulling, leapfrog=not stepping.is_stock)
    kicks = Kicks(scene, forces, 1 / stepping.rate, touching=contact)
    setup = Setup(level, values, stepping, scene, forces, kicks)
    if begin is not None:
        begin(setup)
    return setup
