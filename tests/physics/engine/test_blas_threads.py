"""Scenes of many bodies are solved in one thread, whatever NumPy would do by itself."""

from collections.abc import Iterator

import pytest
from threadpoolctl import ThreadpoolController

from sandbox.model.level import Level
from sandbox.physics.engine import blas_threads
from sandbox.physics.run import build
from tests.levels.playing import fingerprint
from tests.physics.scenes import GRAVITY, Spec, box, disc, floor, level

STEPS = 10


@pytest.fixture
def libraries(monkeypatch: pytest.MonkeyPatch) -> Iterator[ThreadpoolController]:
    """The libraries of a program that has not asked for one thread."""
    monkeypatch.delenv("OPENBLAS_NUM_THREADS", raising=False)
    blas_threads._threads.cache_clear()
    yield ThreadpoolController().select(user_api="blas")
    blas_threads._threads.cache_clear()


def stack() -> Level:
    """Boxes on each other, which are solved directly."""
    bodies = {f"box{i}": box((0, 0.5 + i), size=(1, 1), friction=0.6) for i in range(40)}
    effects = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}
    return level({**bodies, "floor": floor(friction=1)}, effects)


def net() -> Level:
    """Knots joined by rods, in rows and columns."""
    side = range(8)
    bodies = {f"k{i}{k}": disc((i + k / 100, k), radius=0.1) for i in side for k in side}
    rods: dict[str, Spec] = {
        f"r{i}{k}{m}{n}": {"type": "rod", "ends": [f"k{i}{k}", f"k{m}{n}"]}
        for i in side
        for k in side
        for m, n in ((i + 1, k), (i, k + 1))
        if m in side and n in side
    }
    hook: Spec = {"type": "rod", "ends": ["k00", [0, 2]]}
    return level(bodies, GRAVITY, joints={**rods, "hook": hook})


@pytest.mark.parametrize("scene", [stack(), net()], ids=["stack", "net"])
def test_the_bits_do_not_depend_on_threads(scene: Level, libraries: ThreadpoolController) -> None:
    ends = []
    for threads in (1, 2):
        with libraries.limit(limits=threads, user_api="blas"):
            ends.append(fingerprint(build(scene).advance(STEPS)))
            assert {one["num_threads"] for one in libraries.info()} == {threads}
        blas_threads._threads.cache_clear()

    assert ends[0] == ends[1]


def test_small_scenes_do_not_pay(libraries: ThreadpoolController) -> None:
    with libraries.limit(limits=2, user_api="blas"):
        assert blas_threads.in_one_thread(print, 3) is print
        assert blas_threads.in_one_thread(print, 40) is not print
