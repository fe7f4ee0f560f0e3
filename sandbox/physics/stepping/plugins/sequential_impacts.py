"""The plugin of sequential impacts, between drift and kick."""

from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.state.kick_context import Kick
from sandbox.physics.stepping.step_plugin import Plugin, Setup


def make(setup: Setup) -> Plugin:
    """Make the plugin."""
    sequence, forces = setup.scene.sequence, setup.forces
    assert sequence

    def collide(kick: Kick) -> None:
        sequence.collide(forces.law_acceleration, start=kick.at_step)
        forces.shift(sequence.last.jump)

    def record(step: StepRecord) -> StepRecord:
        return step._replace(velocity_jump=sequence.last.jump)

    return Plugin(in_kick=collide, record=record)
