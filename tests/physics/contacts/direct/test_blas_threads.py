"""Large islands are solved in one thread, whatever NumPy would do by itself."""

from collections.abc import Iterator

import pytest
from threadpoolctl import ThreadpoolController

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.contacts.direct import blas_threads, linear_systems
from sandbox.physics.joints.exact.dense_systems import solve
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, Spec, disc, fixed, level


def row(count: int) -> Level:
    """Discs on a floor, each joined to the next by a rod."""
    bodies: dict[str, Spec] = {f"disc{i}": disc((i, 0.25), radius=0.25) for i in range(count)}
    floor = fixed({"type": "segment", "start": [-5, 0], "end": [count + 5, 0]})
    joints: dict[str, Spec] = {
        f"rod{i}": {"type": "rod", "ends": [f"disc{i}", f"disc{i + 1}"]} for i in range(count - 1)
    }
    return level({"floor": floor, **bodies}, {**GRAVITY, "contact": {}}, joints=joints)


@pytest.fixture
def two_threads() -> Iterator[ThreadpoolController]:
    """Let NumPy work in two threads, as it does by itself where there are two cores."""
    found = ThreadpoolController().select(user_api="blas")
    blas_threads._threads.cache_clear()
    with found.limit(limits=2, user_api="blas"):
        yield found
    blas_threads._threads.cache_clear()


@pytest.mark.parametrize(("count", "expected"), [(3, 2), (40, 1)])
def test_only_large_islands_are_kept_in_one_thread(
    count: int, expected: int, two_threads: ThreadpoolController, monkeypatch: pytest.MonkeyPatch
) -> None:
    threads: set[int] = set()

    def watched(matrix: Array, wanted: Array) -> Array:
        threads.update(one["num_threads"] for one in two_threads.info())
        return solve(matrix, wanted)

    world = build(row(count))
    world.advance(2)
    monkeypatch.setattr(linear_systems, "solve", watched)
    world.advance(2)

    assert threads == {expected}
    assert {one["num_threads"] for one in two_threads.info()} == {2}
