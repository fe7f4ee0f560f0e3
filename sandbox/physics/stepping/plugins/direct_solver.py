"""The plugin of the direct solver: contacts and exact joints together (see `contacts/direct`)."""

from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.state.kick_context import Kick
from sandbox.physics.stepping.plugins.non_pymunk_joints import bearing
from sandbox.physics.stepping.step_plugin import Plugin, Setup


def make(setup: Setup) -> Plugin:
    """Make the plugin."""
    direct, forces, dt = setup.scene.direct, setup.forces, setup.kicks.clock.dt
    assert direct

    def begin(kick: Kick) -> None:
        acceleration = forces.acceleration_with_hand(dt)
        direct.begin(acceleration, forces.belated_change, start=kick.at_step)

    def solve(kick: Kick) -> None:
        direct.solve(kick.until)

    solve_once_borne = bearing(setup, solve)

    def finish(kick: Kick) -> None:
        solve_once_borne(kick)
        forces.shift_by_impacts(direct.last)

    def refit(_t: float) -> None:
        direct.forget()

    def record(step: StepRecord) -> StepRecord:
        over = step.impact_count + len(direct.drifts.separated_contacts.bodies)
        return step._replace(divided_drift=direct.drifts.drift_before, impact_count=over)

    return Plugin(
        in_kick=begin,
        after_kick=finish,
        refit=refit,
        record=record,
        contacts=lambda: direct.drifts.separated_contacts.followed_by(direct.contacts),
    )
