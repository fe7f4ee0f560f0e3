"""The user's actions on a run, each with its step: enough to repeat the run to the last bit."""

import json
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.errors import SandboxError, brief
from sandbox.model.loading import choose, parse
from sandbox.model.rules.conditions.numbers_and_shapes import MAX_STEPS
from sandbox.model.translatable_message import Message
from sandbox.physics.stepping.run_continuation import alter, branch
from sandbox.physics.stepping.world import World

Finite = Annotated[float, Field(allow_inf_nan=False)]


class Action(Model):
    """An action of the user between two steps."""

    step: Annotated[int, Field(ge=0, le=MAX_STEPS)]
    """the number of steps before it"""
    kind: Literal["grab", "drag", "release", "place", "branch", "alter"]
    """grab a body, pull the grabbed body, let go of it, move a body, continue the run with other
    parameters, or with other parts"""
    body: str = ""
    """the body to grab or to place"""
    point: Annotated[tuple[Finite, Finite], Field(strict=False)] = (0.0, 0.0)
    """[x, y] in m: the point of the grab, the target of the pull, or the new position"""
    parameters: Mapping[str, Annotated[Finite, Field(strict=False)]] = {}
    """for a branch, the new values of the parameters that change"""
    level: Mapping[str, Any] = {}
    """for an alteration, the level as which the run continues, with its state at that step"""


def perform(action: Action, world: World) -> World:
    """Perform an action, and return the world in which the run continues.

    Raises `SandboxError` if the action is not possible. A branch or alteration then leaves the
    world unchanged.
    """
    if action.kind in ("grab", "place") and action.body not in world.scene.bodies:
        raise SandboxError(Message("there is no body '{name}' to move", name=brief(action.body)))
    match action.kind:
        case "grab":
            world.grab(action.body, action.point)
        case "drag":
            world.drag(action.point)
        case "release":
            world.release()
        case "place":
            world.place({action.body: action.point})
        case "branch":
            return branch(world, choose(world.level, {**world.values, **action.parameters}))
        case "alter":
            return alter(world, parse(json.dumps(action.level), "what the run goes on as"))
    return world
