"""The stage of one-way surfaces: it notes the positions after each step."""

from sandbox.model.expressions import Array
from sandbox.physics.stepping.stage import Setup, Stage


def make(setup: Setup) -> Stage:
    """Make the stage."""
    gates = setup.scene.gates
    assert gates

    def started(_begun: Array, _acceleration: Array) -> None:
        gates.note()

    def refit(_t: float) -> None:
        gates.forget()

    return Stage(after_step=gates.note, started=started, refit=refit, calls=1)
