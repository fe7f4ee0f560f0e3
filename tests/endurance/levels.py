"""Levels that run for very long: `python -m tests.endurance.levels`.

Each is played in a world of its own, and started anew where it has come to its end or had to stop.
What a step takes and what the process holds must be at the end what they were at the beginning.
"""

from dataclasses import dataclass
from time import process_time

import typer

from sandbox.model import catalog
from sandbox.model.errors import SandboxError
from sandbox.model.loading import load
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from tests.endurance.memory import held

USED = (
    "newton/atwood", "newton/incline-with-friction", "kinematics/projectile",
    "lagrange/simple-pendulum", "lagrange/double-pendulum", "rotation/rolling",
    "momentum/cradle", "momentum/bouncing-ball", "energy/kepler-ellipse", "machines/car-over-bumps",
)  # fmt: skip
STRIDE = 10
"""Steps from one that is looked at to the next."""

PARTS = 10
LEAK = 20.0
"""MB, by which what is held may have grown."""

SLOWER = 1.5
"""How many times as long the steps of the cheapest later tenth may take as those of the first: a
machine that others use is never quieter than it is."""


@dataclass
class Run:
    """The result for a level: seconds per step and MB, one value for each part."""

    seconds: list[float]
    memory: list[float]
    runs: int

    @property
    def sound(self) -> bool:
        """Whether neither has grown."""
        slower = min(self.seconds[PARTS // 2 :]) / min(self.seconds[: PARTS // 2])
        return slower <= SLOWER and self.memory[-1] - self.memory[0] <= LEAK


def play(name: str, steps: int) -> Run:
    """Take a number of steps of a level, restarting it again and again."""
    level, found = load(catalog.find(name)), Run([], [], 1)
    world = build(level)
    whole = count_steps(world)
    for _ in range(PARTS):
        begun = process_time()
        for _ in range(steps // PARTS // STRIDE):
            try:
                world.advance(STRIDE)
                over = world.steps >= whole
            except SandboxError:
                over = True
            if over:
                world, found.runs = build(level), found.runs + 1
        found.seconds.append((process_time() - begun) / (steps // PARTS))
        found.memory.append(held())
    return found


def main(steps: int = 10_000_000) -> None:
    """Take a number of steps in all, and report the trends of time and memory."""
    sound = True
    for name in USED:
        found = play(name, steps // len(USED))
        sound &= found.sound
        micro = ", ".join(f"{1e6 * s:.0f}" for s in found.seconds)
        grown = found.memory[-1] - found.memory[0]
        typer.echo(f"{name}: {found.runs} runs; µs a step: {micro}; grown by {grown:.1f} MB")
    raise typer.Exit(not sound)


if __name__ == "__main__":
    typer.run(main)
