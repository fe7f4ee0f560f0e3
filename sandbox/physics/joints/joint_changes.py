"""Joints that are cut, tied, or weld bodies that stick, while a scene runs."""

from sandbox.physics.joints.joints import Joints
from sandbox.physics.state.kick import Kick


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
    assert joints.touches and joints.solids and joints.weld  # noqa: PT018 (all come together)
    joints.touches.end_step()
    for a, b in joints.touches.latest:
        if joints.solids.join(a, b):
            joints.weld(a, b)


def catch(joints: Joints, name: str, t: float) -> bool:
    """Tie an open joint at a time [s], and return whether it is solved together with others.

    It keeps its value at that time. The impact of motion that it stops is not solved here.
    """
    latches = joints.latches
    if latches is None or name in latches.tied:
        return False
    latches.tied[name] = t
    if name in joints.springs:
        return False
    latches.tie(name, t)
    return True
