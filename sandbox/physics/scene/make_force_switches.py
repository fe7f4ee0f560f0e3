"""The switches of a scene, one for each force that events turn on and off or cut."""

from dataclasses import replace

from sandbox.model.level import Level
from sandbox.model.switched_forces import switched
from sandbox.physics.forces.force_switch import Switch, Switches
from sandbox.physics.joints.scene_joints import Joints


def make_switches(level: Level, joints: Joints) -> Switches:
    """Make a switch for each force that events switch, and connect those of springs."""
    switches = {name: Switch(first) for name, first in switched(level).items()}
    for name in switches.keys() & joints.springs.keys():
        joints.springs[name] = replace(joints.springs[name], switch=switches[name])
    return switches
