"""Joints that are cut, tied, or weld bodies that stick, while a scene runs."""

from collections.abc import Iterable

from sandbox.physics.joints.scene_joints import Joints
from sandbox.physics.state.kick_context import Kick


def let_go(joints: Joints, name: str, t: float) -> None:
    """Cut a joint at a time [s], unless it is open or cut already.

    A spring is a force law, which has its own switch.
    """
    if name in joints.cut or not joints.holds(name, t):
        return
    joints.cut[name] = t
    if name in joints.own:
        joints.own[name].leave()
    elif name not in joints.springs:
        assert joints.together
        joints.together.drop(name)
        if joints.solids:
            joints.solids.part(name)


def stick(joints: Joints, _kick: Kick) -> None:
    """Weld the bodies that have just met, at their present positions."""
    assert joints.touches and joints.solids and joints.weld  # noqa: PT018 (they exist together or not at all)
    joints.touches.end_step()
    for a, b in joints.touches.latest:
        if joints.solids.join(a, b):
            joints.weld(a, b)


def catch(joints: Joints, names: Iterable[str], t: float) -> bool:
    """Tie open joints at a time [s], and return whether any is solved together with others.

    They keep their values at that time. The impact of motion that they stop is not solved here.
    """
    latches = joints.latches
    if latches is None:
        return False
    new = [name for name in dict.fromkeys(names) if name not in latches.tied]
    latches.tied.update(dict.fromkeys(new, t))
    exact = [name for name in new if name not in joints.springs]
    if exact:
        latches.tie(exact, t)
    return bool(exact)
