"""The cost of a step is counted, and nothing else is counted with it."""

import gc
from collections.abc import Mapping

from sandbox.model.level import Level, Stepping
from sandbox.physics.accuracy.counted_step_cost import CALL, counted_cost
from tests.physics.scenes import GRAVITY, atwood, disc, floor, incline, level
from validation.case import textbook


def test_what_the_garbage_collector_calls_meanwhile_is_not_counted() -> None:
    """Objects of others may end in these steps; a request then got one of two answers."""
    scene = incline(0.3)
    alone = counted_cost(scene, {}, Stepping(rate=60))
    before = gc.get_threshold()

    def collected(_phase: str, _info: Mapping[str, object]) -> None:
        for _ in range(100):
            len(())

    gc.callbacks.append(collected)
    gc.set_threshold(1)
    try:
        beside = counted_cost(scene, {}, Stepping(rate=60))
    finally:
        gc.set_threshold(*before)
        gc.callbacks.remove(collected)

    assert beside == alone


def test_strings_and_rods_cost_few_calls_beside_pymunk() -> None:
    """What Python does around their arithmetic is most of the time of a step."""
    pendulum = textbook("lagrange/simple-pendulum")
    eighth = pendulum.stepping.model_copy(update={"scheme": "eighth-order", "rate": 30})
    machine = atwood(1.0, 1.5)

    def calls(scene: Level, stepping: Stepping) -> float:
        values = {name: parameter.value for name, parameter in scene.parameters.items()}
        return counted_cost(scene, values, stepping) / CALL

    assert calls(machine, machine.stepping) <= 17  # 16.7; 19.7 with calls for each body
    assert calls(pendulum, pendulum.stepping) <= 28  # 27.4; 36 with arrays of one number
    assert calls(pendulum, eighth) <= 17 * 31  # 29.8 in each of its parts; 41


def test_contacts_that_stay_as_they_are_are_not_worked_out_anew() -> None:
    """Ten discs on a floor, each on a rod from the one before: an island of ten and ten."""
    discs = {f"disc{i}": disc((i, 0.1), radius=0.1, friction=0.3) for i in range(10)}
    ends = [[-1, 0.5], *discs]
    rods = {f"rod{i}": {"type": "rod", "ends": ends[i : i + 2]} for i in range(10)}
    effects = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}
    chain = level({"floor": floor(friction=0.3), **discs}, effects, joints=rods)

    assert counted_cost(chain, {}, chain.stepping) / CALL <= 490  # 482; 509 with all anew
