"""The stage of sequential impacts, between drift and kick."""

from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.state.kick_context import Kick
from sandbox.physics.stepping.stage import Setup, Stage


def make(setup: Setup) -> Stage:
    """Make the stage."""
    sequence, forces = setup.scene.sequence, setup.forces
    assert sequence

    def collide(kick: Kick) -> None:
        sequence.collide(forces.law_acceleration, start=kick.at_step)
        forces.shift(sequence.last.jump)

    def record(step: StepRecord) -> StepRecord:
        return step._replace(velocity_jump=sequence.last.jump)

    return Stage(in_kick=collide, record=record)
