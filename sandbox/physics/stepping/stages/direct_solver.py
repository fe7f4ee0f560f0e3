"""The stage of the direct solver: contacts and exact joints together (see `contacts/direct`)."""

from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.state.kick_context import Kick
from sandbox.physics.stepping.stage import Setup, Stage
from sandbox.physics.stepping.stages.non_pymunk_joints import bearing


def make(setup: Setup) -> Stage:
    """Make the stage."""
    direct, forces, dt = setup.scene.direct, setup.forces, setup.kicks.clock.dt
    assert direct

    def begin(kick: Kick) -> None:
        direct.begin(forces.acceleration_with_hand(dt), start=kick.at_step)

    def solve(kick: Kick) -> None:
        direct.solve(kick.until)

    def refit(_t: float) -> None:
        direct.forget()

    def record(step: StepRecord) -> StepRecord:
        over = step.impact_count + len(direct.drifts.separated_contacts.bodies)
        return step._replace(divided_drift=direct.drifts.drift_before, impact_count=over)

    return Stage(
        in_kick=begin,
        after_kick=bearing(setup, solve),
        refit=refit,
        record=record,
        contacts=lambda: direct.drifts.separated_contacts.followed_by(direct.contacts),
    )
