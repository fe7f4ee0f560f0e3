"""The process in which Atheris makes levels: inputs that reach new code are mutated further.

Atheris (Google's libFuzzer for Python) records which branches of the code an input reaches. Here
the bytes of an input are the choices of the generators of levels. Attempts and results are sent
along a pipe, since nothing else remains of a process that is killed: first the number of levels
before it and its text, then its `Outcome`.
"""

import importlib
import os
import sys
from functools import partial
from io import BytesIO
from itertools import count
from multiprocessing.connection import Connection
from random import Random

LONGEST = 4000
"""The most bytes of an input: a level takes some hundred choices."""

SLOWER = 3.0
"""The slowdown of instrumented code."""


class Choices(Random):
    """A random generator that uses the bytes of an input, then zeros."""

    def __init__(self, data: bytes) -> None:
        super().__init__(0)
        self._left = BytesIO(data)

    def getrandbits(self, k: int, /) -> int:
        """Return a number of k bits."""
        return int.from_bytes(self._left.read(-(-k // 8)), "little") & ((1 << k) - 1)

    def random(self) -> float:
        """Return a number in [0, 1)."""
        return self.getrandbits(32) / 2**32


def main() -> None:
    """Explore until the pipe closes; the arguments are a pipe, a seed and a folder of inputs."""
    pipe, seed, folder = sys.argv[1:]
    line = Connection(int(pipe))
    atheris = importlib.import_module("atheris")
    with atheris.instrument_imports(include=["sandbox"]):
        from validation.fuzz import isolated_trial
        from validation.fuzz.random_levels import drawn_level
        from validation.fuzz.refused_level_repair import answered
    isolated_trial.load_libraries()
    numbers = count()

    def attempt(number: int, text: str) -> isolated_trial.Outcome:
        line.send((number, text))
        outcome = isolated_trial.attempt_within(SLOWER * isolated_trial.SECONDS, text)
        line.send(outcome)
        return outcome

    def explore(data: bytes) -> None:
        choices = Choices(data)
        level = drawn_level(choices, changed=choices.random() < 0.5)
        for _ in answered(level, partial(attempt, next(numbers))):
            pass

    limits = ["-rss_limit_mb=0", "-timeout=0", f"-max_len={LONGEST}", "-len_control=0"]
    nowhere = f"-exact_artifact_path={os.devnull}"  # else it leaves a file where the work is
    isolated_trial.limit_memory()
    atheris.Setup([sys.argv[0], f"-seed={seed}", *limits, nowhere, folder], explore)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
