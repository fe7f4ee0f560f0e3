"""The states of a few levels as one machine found them: `make bits`.

The command writes `bits.json` anew, after a change that gives the levels other bits. A machine of
the same kind must find the same bits (`test_bits.py`), and any other machine almost the same
places: the linear algebra of NumPy and SciPy, their functions and those of the C library differ in
the last digits from one family of processors to the next.
"""

import json
import platform
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pymunk
import scipy
import typer
from threadpoolctl import threadpool_info

from sandbox.model.atomic_file_writing import write_atomically
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from sandbox.physics.state.snapshot import Snapshot
from tests.levels.playing import fingerprint
from validation.case import textbook

FILE = Path(__file__).with_name("bits.json")
STEPS = 200

LEVELS = (
    "newton/atwood", "newton/incline-with-friction", "kinematics/projectile",
    "momentum/cradle", "momentum/billiard-break", "momentum/bouncing-ball",
    "energy/kepler-ellipse", "energy/brachistochrone", "rotation/rolling",
    "rotation/electric-bell", "lagrange/double-pendulum", "lagrange/rotating-hoop",
    "machines/belt-drive", "machines/car-over-bumps", "machines/ragdoll", "machines/seesaw",
    "machines/wrecking-ball",
)  # fmt: skip
"""Levels of all kinds: with and without contacts, joints, curves and fields."""


def kind() -> dict[str, Any]:
    """Return what the last digits depend on: versions, and the code chosen for the processor."""
    import_module("scipy.linalg.lapack")  # has linear algebra of its own
    features = np.show_config(mode="dicts")["SIMD Extensions"].get("found", [])
    return {
        "machine": f"{platform.system()} {platform.machine()}",
        "libc": " ".join(platform.libc_ver()),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "pymunk": pymunk.version,
        "features": features,
        "kernels": sorted({one.get("architecture", "") for one in threadpool_info()}),
    }


def state(name: str) -> Snapshot:
    """Return the state of a level after some steps, or at its end."""
    world = build(textbook(name))
    return world.advance(min(STEPS, count_steps(world)))


def main() -> None:
    """Write the file anew, with the states that this machine finds."""
    found = {name: state(name) for name in LEVELS}
    bits = {name: fingerprint(state) for name, state in found.items()}
    places = {name: state.position.ravel().tolist() for name, state in found.items()}
    said = {"kind": kind(), "bits": bits}
    lines = ",\n".join(f"  {json.dumps(name)}: {json.dumps(at)}" for name, at in places.items())
    text = json.dumps(said, indent=1).removesuffix("\n}")
    write_atomically(FILE, f'{text},\n "places": {{\n{lines}\n }}\n}}\n')
    typer.echo(f"{FILE.name}: {len(LEVELS)} levels")


if __name__ == "__main__":
    typer.run(main)
