"""Joints that are cut, stick or catch while a scene runs."""

from sandbox.physics.joints.joints import Joints
from sandbox.physics.state.kick import Kick


def let_go(joints: Joints, name: str, t: float) -> None:
    """Cut a joint at a time [s]; what is open, or cut already, is left alone.

    A spring is a force, and has its switch for that.
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
    """Weld those that have just met where they are."""
    assert joints.touches and joints.solids and joints.weld  # noqa: PT018 (all come together)
    joints.touches.end_step()
    for a, b in joints.touches.latest:
        if joints.solids.join(a, b):
            joints.weld(a, b)


def catch(joints: Joints, name: str, t: float) -> bool:
    """Tie a joint that is open, at a time [s]; tell whether it is one of those solved together.

    It holds what there is then. What it stops is an impact, which is still to come.
    """
    latches = joints.latches
    if latches is None or name in latches.tied:
        return False
    latches.tied[name] = t
    if name in joints.springs:
        return False
    latches.tie(name, t)
    return True
