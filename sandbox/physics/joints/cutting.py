"""Joints that let go while a scene runs."""

from sandbox.physics.joints.joints import Joints


def let_go(joints: Joints, name: str, t: float) -> None:
    """Cut a joint at a time [s]; what is cut already is left alone.

    A spring is a force, and has its switch for that.
    """
    if name in joints.cut:
        return
    joints.cut[name] = t
    if name in joints.own:
        joints.own[name].leave()
    elif name not in joints.springs:
        assert joints.together
        joints.together.drop(name)
        if joints.solids:
            joints.solids.part(name)
