"""The plugin of one-way surfaces: it notes the positions after each step."""

from sandbox.model.expressions import Array
from sandbox.physics.stepping.step_plugin import Plugin, Setup


def make(setup: Setup) -> Plugin:
    """Make the plugin."""
    gates = setup.scene.gates
    assert gates

    def started(_begun: Array, _acceleration: Array) -> None:
        gates.note()

    def refit(_t: float) -> None:
        gates.forget()

    return Plugin(after_step=gates.note, started=started, refit=refit, calls=1)
