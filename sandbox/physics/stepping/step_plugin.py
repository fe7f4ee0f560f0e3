"""The contract of a plugin: a part of a step that only some levels need.

A step is a drift and a kick. All other things that a level declares take part in it as a *plugin*,
which names the moments at which it acts. In the order of a step, these are

    before_drift    between two kicks: it may change positions and velocities, and must then pass
                    the jump of the velocities to the forces (`Forces.shift`, `Forces.restart`)
    in_kick         after pymunk's drift, before its kick: it may add forces, and change velocities
    after_kick      after pymunk's solver: it may change velocities
    after_step      after the step is counted

and outside the steps

    started         after the first kick was found
    refit           after bodies were moved by hand, from where the run continues

A plugin in a kick also acts in kicks of bodies that are held in place. These are repeated until
they converge, and the plugin must do the same each time. It never accesses the world, and other
plugins only through the scene.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.kick_context import Work
from sandbox.physics.stepping.applied_forces import Forces
from sandbox.physics.stepping.drifts_and_kicks import Kicks

if TYPE_CHECKING:
    from sandbox.physics.energy.step_record import StepRecord
    from sandbox.physics.events.impact_response import Impact

Act = Callable[[], None]


class Setup(NamedTuple):
    """The inputs of a plugin: the level, its parameters, and its scene, forces and kicks."""

    level: Level
    values: Values
    stepping: Stepping
    scene: Scene
    forces: Forces
    kicks: Kicks

    @property
    def leapfrog(self) -> bool:
        """Whether velocities are staggered by half a step on purpose; not with Euler's schemes."""
        return not self.stepping.is_stock


Begin = Callable[[Setup], None] | None
"""Sets the initial state of a scene, if that is not the level's start."""


class Plugin(NamedTuple):
    """The moments at which a plugin acts, and its outputs; see the contract above.

    Attributes
    ----------
    before_drift, after_step
        Act without arguments.
    in_kick, after_kick
        Act in the kick that they are given.
    started
        Takes the velocities before the first kick and the accelerations in it, (n, 3) each [m/s,
        rad/s, m/s², rad/s²]; returns the accelerations at the start if it knows them better.
    refit
        Takes the time [s].
    contacts
        Returns the contacts of the last kick, if they are not pymunk's.
    impacts
        Returns the located impacts in the last drift.
    pre_kick_velocity
        Returns the velocities at the beginning of the last kick, if they are not those after the
        step before it: (n, 3) [m/s, rad/s].
    record
        Adds the actions of the plugin in a step to its record.
    calls
        The number of Python calls in a step for it, outside kicks.
    """

    before_drift: Act | None = None
    in_kick: Work | None = None
    after_kick: Work | None = None
    after_step: Act | None = None
    started: Callable[[Array, Array], Array | None] | None = None
    refit: Callable[[float], None] | None = None
    contacts: Callable[[], Contacts] | None = None
    impacts: "Callable[[], Sequence[Impact]] | None" = None
    pre_kick_velocity: Callable[[], Array] | None = None
    record: "Callable[[StepRecord], StepRecord] | None" = None
    calls: int = 0


class Plugins:
    """The plugins of a world, in order at each moment.

    Attributes
    ----------
    before_drift, after_step
        The calls at these moments; most levels have none.
    started, refit, contacts, impacts, pre_kick_velocity, record
        See `Plugin`.
    calls
        The number of Python calls in a step for all of them, outside kicks.
    """

    def __init__(self, plugins: Sequence[Plugin], kicks: Kicks) -> None:
        self.before_drift = tuple(p.before_drift for p in plugins if p.before_drift)
        self.after_step = tuple(p.after_step for p in plugins if p.after_step)
        self.started = tuple(p.started for p in plugins if p.started)
        self.refit = tuple(p.refit for p in plugins if p.refit)
        self.contacts = next((p.contacts for p in plugins if p.contacts), None)
        self.impacts = next((p.impacts for p in plugins if p.impacts), None)
        self.pre_kick_velocity = next(
            (p.pre_kick_velocity for p in plugins if p.pre_kick_velocity), None
        )
        self.record = tuple(p.record for p in plugins if p.record)
        self.calls = sum(p.calls for p in plugins)
        kicks.add_calls(
            [p.in_kick for p in plugins if p.in_kick],
            [p.after_kick for p in plugins if p.after_kick],
        )


def set_up(
    level: Level, values: Values, stepping: Stepping, scene: Scene, begin: Begin = None
) -> Setup:
    """Return the inputs of the plugins of a world."""
    has_contacts = level.effects.contact is not None
    # joints alternate with contacts: there a kick begins with their last force
    warm_started = scene.joints.together if has_contacts and scene.direct is None else None
    forces = Forces(scene, warm_started, leapfrog=not stepping.is_stock)
    kicks = Kicks(scene, forces, 1 / stepping.rate, has_contacts=has_contacts)
    setup = Setup(level, values, stepping, scene, forces, kicks)
    if begin is not None:
        begin(setup)
    return setup
