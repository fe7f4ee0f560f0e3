"""Actions on a run, each with its step: enough to repeat the run to the last bit."""

import json
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.loading import choose, parse
from sandbox.physics.stepping.branching import alter, branch
from sandbox.physics.stepping.world import World

Finite = Annotated[float, Field(allow_inf_nan=False)]


class Action(Model):
    """Something that a person did between two steps."""

    step: Annotated[int, Field(ge=0)]
    """how many steps had been taken"""
    kind: Literal["grab", "drag", "release", "place", "branch", "alter"]
    """took hold of a body, pulled what was held, let go of it, put a body elsewhere, let the run go
    on with other parameters, or with other parts"""
    body: str = ""
    """which, where it took hold of one or put it elsewhere"""
    point: Annotated[tuple[Finite, Finite], Field(strict=False)] = (0.0, 0.0)
    """[x, y] in m: where it took hold, where it pulled to, or where it put the body"""
    parameters: Mapping[str, Annotated[Finite, Field(strict=False)]] = {}
    """with which the run goes on, where it branches: the values of those that change"""
    level: Mapping[str, Any] = {}
    """that the run goes on as, where it was altered, with its state at that step"""


def perform(action: Action, world: World) -> World:
    """Perform the action, perhaps again; return the world in which the run goes on.

    Raises
    ------
    SandboxError
        If the world cannot stand it. One that was to be branched stays as it is.
    """
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
