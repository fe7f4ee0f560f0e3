"""What impacts, jerks and overlaps leave in the books."""

import pytest

from sandbox.physics.run import build
from tests.physics.energy.test_ledger import rest, watched
from tests.physics.scenes import GRAVITY, G, box, disc, floor, level


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.8])
def test_an_impact_takes_what_its_restitution_says(restitution: float) -> None:
    """(1 − e²)/2 of the reduced mass times the speed of approach squared."""
    bounce = {"restitution": restitution}
    scene = level(
        {"a": disc((-1, 0), mass=2, velocity=[3, 0], **bounce), "b": disc((1, 0), restitution=1)},
        {"contact": {}, "restitution": {}},
    )

    books = watched(build(scene), 60)

    assert books[-1].loss["impacts"] == pytest.approx((1 - restitution**2) / 3 * 9, rel=1e-12)
    assert rest(books) < 1e-12


def test_impacts_in_sequence_take_the_speed_at_the_step() -> None:
    """Where pymunk's own speed is half a step old; a ball falls 1 m and bounces, e = 0.5."""
    ball = disc((0, 1.5), restitution=0.5)
    scene = level(
        {"ball": ball, "floor": floor(restitution=1)},
        {**GRAVITY, "contact": {}, "restitution": {"impacts": "sequence"}},
        stepping={"rate": 480},
    )

    books = watched(build(scene), 240)

    assert books[-1].loss["impacts"] == pytest.approx(0.75 * G, rel=1e-2)  # v dt late
    assert rest(books) < 1e-12


def test_a_rope_that_is_jerked_taut_takes_energy_as_an_impact_does() -> None:
    scene = level(
        {"bob": disc((0.5, 0), mass=2, velocity=[3, 0])},
        {},
        joints={"rope": {"type": "rope", "ends": [[0, 0], "bob"], "length": 1}},
    )

    books = watched(build(scene), 60)

    assert books[-1].loss["impacts"] == pytest.approx(9, rel=1e-12)
    assert books[-1].impulse["supports"] == pytest.approx([-6, 0, 0])


def test_what_impacts_cannot_give_is_unexplained() -> None:
    """Elastic discs that touch: pymunk solves all at once, and 0.05 % of the energy goes."""
    rows = [(x, y) for x in range(5) for y in range(x + 1)]
    discs = {
        f"d{i}": disc((x * 0.75**0.5, y - x / 2), restitution=1) for i, (x, y) in enumerate(rows)
    }
    cue = disc((-3, 0.1), velocity=[5, 0], restitution=1)
    together = level({"cue": cue, **discs}, {"contact": {}, "restitution": {}})
    sequence = level({"cue": cue, **discs}, {"contact": {}, "restitution": {"impacts": "sequence"}})

    assert rest(watched(build(together), 60)) > 1e-4
    assert rest(watched(build(sequence), 60)) < 1e-12


def test_taking_an_overlap_back_is_unexplained() -> None:
    """Two boxes are lifted apart: nothing in the scene gives the energy for it."""
    scene = level(
        {"low": box((0, 0.25)), "high": box((0, 0.65)), "floor": floor()},
        {**GRAVITY, "contact": {"overlaps": True}},
    )

    books = watched(build(scene), 120)

    assert books[-1].unexplained == pytest.approx(G * 0.1, rel=1e-3)
