"""Levels that run for very long: `python -m tests.endurance.levels`.

Each is played in a world of its own, and started anew where it has come to its end or had to stop.
What a step takes and what the process holds must be at the end what they were at the beginning.
"""

from dataclasses import dataclass
from time import process_time

import typer

from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.loading import load
from sandbox.physics.measuring.recording import Recorder, count_steps
from sandbox.physics.run import build
from tests.endurance.memory import held

USED = (
    "newton/atwood", "newton/incline-with-friction", "kinematics/projectile",
    "lagrange/simple-pendulum", "lagrange/double-pendulum", "rotation/rolling",
    "momentum/cradle", "momentum/bouncing-ball", "energy/kepler-ellipse", "machines/car-over-bumps",
)  # fmt: skip
BOOKS = ("system.energy", "system.unexplained_energy")
"""What is recorded: the energy, and the ledger."""

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


class Playing:
    """A level that is restarted again and again; if recorded, every step is, with its energies."""

    def __init__(self, name: str, *, recorded: bool) -> None:
        self.level, self._recorded, self.runs = load(level_catalog.find(name)), recorded, 0
        self.stride = 1 if recorded else STRIDE
        self._begin()

    def _begin(self) -> None:
        self._world, self.runs = build(self.level), self.runs + 1
        self._recorder = Recorder(self._world, BOOKS) if self._recorded else None

    def go_on(self) -> None:
        """Take some steps, and begin anew where the level has ended or had to stop."""
        try:
            self._world.advance(self.stride)
            if self._recorder:
                self._recorder.note()
        except SandboxError:
            self._begin()
        if self._world.steps >= count_steps(self._world):
            self._begin()


def play(name: str, steps: int, *, recorded: bool) -> Run:
    """Take a number of steps of a level."""
    playing, found = Playing(name, recorded=recorded), Run([], [], 1)
    for _ in range(PARTS):
        begun = process_time()
        for _ in range(steps // PARTS // playing.stride):
            playing.go_on()
        found.seconds.append((process_time() - begun) / (steps // PARTS))
        found.memory.append(held())
    found.runs = playing.runs
    return found


def main(steps: int = 10_000_000, recorded: bool = False) -> None:
    """Take a number of steps in all, and report the trends of time and memory."""
    sound = True
    for name in USED:
        found = play(name, steps // len(USED), recorded=recorded)
        sound &= found.sound
        micro = ", ".join(f"{1e6 * s:.0f}" for s in found.seconds)
        grown = found.memory[-1] - found.memory[0]
        typer.echo(f"{name}: {found.runs} runs; µs a step: {micro}; grown by {grown:.1f} MB")
    raise typer.Exit(not sound)


if __name__ == "__main__":
    typer.run(main)
