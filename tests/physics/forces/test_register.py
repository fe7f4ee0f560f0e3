"""Every force that there is does what its effect says of itself: registered means swept."""

from collections.abc import Sequence
from contextlib import nullcontext
from importlib import import_module
from math import log2
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sandbox.model.effects import EFFECTS
from sandbox.model.effects.contract import Effect, IncompleteError, Sight
from sandbox.model.errors import LevelError
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.model.quantities import quantities
from sandbox.model.switched_forces import switchable
from sandbox.physics import forces
from sandbox.physics.forces import declared_laws
from sandbox.physics.forces.law import Law
from sandbox.physics.run import build, simulate
from sandbox.physics.state.motion import Instant
from tests.effects import BODIES, examples
from tests.physics.scenes import disc, level

FORCES = [effect for effect in EFFECTS.values() if effect.is_force]
LAWS = [effect for effect in FORCES if effect.is_law]
SMOOTH = [effect for effect in FORCES if not effect.is_rough]
ROUGH = [effect for effect in FORCES if effect.is_rough]
COUNT = len(BODIES)
Places = tuple[tuple[float, float], ...]
APART: Places = ((1.2, 0.3), (-2, 1.5), (0.4, -2.5))
SIGHTS: dict[Sight, str] = {
    "position": "position",
    "angle": "angle",
    "velocity": "velocity",
    "time": "t",
}


def named(effects: Sequence[Effect]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("effect", effects, ids=[effect.name for effect in effects])


def scene(effects: dict[str, Any], places: Places = APART, **rest: object) -> Level:
    """Return three bodies that move and turn, on which effects act; the first is not round."""
    bodies = {
        name: disc(place, mass=3 + i, velocity=[0.3 - i, 0.4], angular_velocity=0.2 * i - 0.3)
        for i, (name, place) in enumerate(zip(BODIES, places, strict=True))
    }
    bodies[BODIES[0]]["shape"] = {"type": "box", "width": 0.9, "height": 4}
    return level(bodies, {"rotation": {}, **effects}, **rest)


def laws_of(effect: Effect) -> list[tuple[Law, ...]]:
    """Return the laws of an effect, for each thing that a level may say of it."""
    found = []
    for said in examples(effect.name, 1.5):
        made = build(scene({effect.name: said}, stepping={"rate": 1000})).scene
        found.append((made.gravity,) if made.gravity else made.laws)
    return found


def somewhere(seed: int, times: int | None = None) -> Instant:
    """Return bodies anywhere but close to each other, or to a centre; moving anyhow."""
    draw = np.random.default_rng(seed)
    shape = () if times is None else (times,)
    around = np.array([[3, 0, 0], [-3, 2, 1], [0, -4, 2]])
    place = around + draw.uniform(-1, 1, (*shape, COUNT, 3))
    moves = draw.uniform(-2, 2, (*shape, COUNT, 3))
    t = draw.uniform(0, 0.5, shape)
    return Instant(t, place[..., :2], place[..., 2], moves[..., :2], moves[..., 2])


def wrench(law: Law, motion: Instant) -> Array:
    found = np.zeros((*motion.angle.shape, 3))
    law.add(motion, found)
    return found


FOR_EACH_LAW = [effect for effect in FORCES if not effect.rotates_velocity]


@named(FOR_EACH_LAW)
def test_a_force_depends_on_what_its_effect_says_and_on_nothing_else(effect: Effect) -> None:
    seen: set[Sight] = set()
    for law in (law for laws in laws_of(effect) for law in laws):
        here, there = somewhere(1), somewhere(2)
        for sight, field in SIGHTS.items():
            other = here._replace(**{field: getattr(there, field)})
            if sight == "velocity":
                other = other._replace(angular_velocity=there.angular_velocity)
            if sight == "time":  # long after what ends has ended
                other = here._replace(t=np.asarray(100.5))
            if not np.array_equal(wrench(law, here), wrench(law, other)):
                seen.add(sight)

    assert seen == set(effect.depends_on)


@named(FOR_EACH_LAW)
def test_a_force_that_stores_energy_is_minus_the_slope_of_it_and_no_other_has_any(
    effect: Effect,
) -> None:
    """Its torque too. Central differences of h = 1e-5: h² times the third slope, eps U / h."""
    h = 1e-5
    for law in (law for laws in laws_of(effect) for law in laws):
        here = somewhere(3)
        if law.effect.book != "potential":
            assert not law.potential_energy(here).any()
            continue
        found = wrench(law, here)
        for body, axis in np.ndindex(COUNT, 3):
            step = np.zeros((COUNT, 3))
            step[body, axis] = h
            ahead, behind = (
                law.potential_energy(
                    here._replace(position=here.position + s[:, :2], angle=here.angle + s[:, 2])
                ).sum()
                for s in (step, -step)
            )
            slope = -(ahead - behind) / (2 * h)
            assert found[body, axis] == pytest.approx(slope, abs=1e-6, rel=1e-6)


@named(FOR_EACH_LAW)
def test_bodies_that_meet_feel_a_finite_force_or_may_not_start_there(effect: Effect) -> None:
    here, (first, *_, last) = somewhere(1), APART
    here.position[1] = here.position[0]
    for said, laws in zip(examples(effect.name, 1.5), laws_of(effect), strict=True):
        with np.errstate(all="ignore"):
            finite = all(np.isfinite(wrench(law, here)).all() for law in laws)
        refused = pytest.raises(LevelError, match=r"which start at the same position")
        with nullcontext() if finite else refused:
            scene({effect.name: said}, (first, first, last))


@named(FOR_EACH_LAW)
def test_a_law_is_the_same_for_one_step_and_for_a_run(effect: Effect) -> None:
    for law in (law for laws in laws_of(effect) for law in laws):
        run = somewhere(4, times=3)
        force, energy = wrench(law, run), law.potential_energy(run)
        assert force.shape == (3, COUNT, 3)
        for i in range(3):
            one = Instant(*(np.asarray(part[i]) for part in run))
            assert force[i] == pytest.approx(wrench(law, one), rel=1e-12, abs=1e-12)
            assert energy[i] == pytest.approx(law.potential_energy(one), rel=1e-12, abs=1e-12)


@named(FORCES)
def test_the_books_of_a_force_close(effect: Effect) -> None:
    """What a kick takes is where the effect says: nothing but the scheme's own error is left.

    At 1000 Hz, over 0.1 s: 3e-6 J at the most of some 10 J (centrifugal); momentum to 2e-14.
    """
    for said in examples(effect.name, 1.5):
        this = scene({effect.name: said}, stepping={"rate": 1000})
        every = list(quantities(this))
        names = [found.name for found in every if found.needs_ledger]
        trace = simulate(this, duration=0.1, record=["system.kinetic_energy", *names])

        assert effect.rotates_velocity or any(effect.account_name in found.name for found in every)
        assert max(np.abs(trace.columns["system.unexplained_energy"])) < 1e-5
        assert max(np.abs(trace.columns["system.unexplained_momentum"])) < 1e-12


@named(FORCES)
def test_what_an_event_has_switched_off_acts_no_more(effect: Effect) -> None:
    for said in examples(effect.name, 1.5):
        event = {"at": 0.05, "off": [effect.name]}
        if effect.name not in switchable(scene({effect.name: said})):
            continue
        world = build(scene({effect.name: said}, stepping={"rate": 200}, events={"end": event}))
        seen = (world.advance(steps) for steps in (9, 3, 8))
        acted, free, later = (np.c_[one.velocity, one.angular_velocity] for one in seen)

        assert np.abs(acted - free).max() > 0, said
        assert later == pytest.approx(free, abs=1e-12), said


def end(this: Level, rate: float, scheme: str = "fourth-order") -> Array:
    stepping = this.stepping.model_copy(update={"rate": rate, "scheme": scheme})
    world = build(this, stepping=stepping)
    return world.advance(round(rate)).position


@named(SMOOTH)
def test_what_is_smooth_is_of_fourth_order_by_that_scheme(effect: Effect) -> None:
    """The error falls by 16 as the step is halved, unless it is rounding already."""
    for said in examples(effect.name, 1.5):
        this = scene({effect.name: said})
        coarse, fine, finest = (end(this, rate) for rate in (20, 40, 80))
        errors = [float(np.abs(place - finest).max()) for place in (coarse, fine)]

        assert errors[0] < 1e-12 or log2(errors[0] / errors[1]) > 3.5, said


@named(ROUGH)
def test_what_is_not_smooth_or_sees_velocities_has_no_fourth_order(effect: Effect) -> None:
    for said in examples(effect.name):
        with pytest.raises(LevelError, match=f"which rules out the effect '{effect.name}'"):
            scene({effect.name: said}, stepping={"scheme": "fourth-order"})


TURNS = [effect for effect in LAWS if effect.rotates_velocity]


def test_what_turns_velocities_keeps_speeds_and_looks_at_no_velocity() -> None:
    """Such as a magnetic field; see also `test_turning`."""
    for effect in TURNS:
        for said in examples(effect.name, 1.5):
            world = build(scene({effect.name: said}, stepping={"rate": 240}))
            begun = np.hypot(*world.snapshot.velocity.T)
            here, there = somewhere(1), somewhere(2)
            for turn in world.scene.rotations:
                other = here._replace(velocity=there.velocity)
                assert np.array_equal(turn.rate(here), turn.rate(other))
                assert turn.rate(somewhere(4, times=3)).shape == (3, COUNT)

            assert np.hypot(*world.advance(200).velocity.T) == pytest.approx(begun, rel=1e-13)


@pytest.mark.parametrize("path", sorted(Path(str(forces.__file__)).parent.glob("*.py")))
def test_what_makes_laws_is_of_an_effect(path: Path) -> None:
    module = import_module(f"{forces.__name__}.{path.stem}")
    if hasattr(module, "laws") and module is not declared_laws:
        assert path.stem in {effect.name for effect in LAWS}


AETHER = Effect(name="aether", book="potential")


def test_an_effect_without_a_law_is_told_with_the_file_that_is_missing() -> None:
    assert list(declared_laws.missing([*LAWS, AETHER])) == [
        "the effect 'aether' is declared in sandbox/model/effects/aether.py, but it has no law:"
        " add sandbox/physics/forces/aether.py with a function 'laws'"
    ]


def test_a_law_without_its_parts_is_told_with_its_file() -> None:
    (law,) = laws_of(EFFECTS["drag"])[0]
    turning = Effect(name="drag", book="none", depends_on=("velocity",))

    with pytest.raises(IncompleteError, match=r"VelocityRotation, but Drag .* has no 'rate'"):
        declared_laws._require(turning, law)
    with pytest.raises(IncompleteError, match=r"aether.py says that it is of 'drag'"):
        declared_laws._require(AETHER, law)
    with pytest.raises(IncompleteError, match=r"add a function 'flows' to .*forces/drag.py"):
        declared_laws.part_of(EFFECTS["drag"], "flows")
