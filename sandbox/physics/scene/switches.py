"""The switches of a scene, one for each thing that events cut or switch."""

from dataclasses import replace

from sandbox.model.level import Level
from sandbox.model.switches import switched
from sandbox.physics.forces.switch import Switch, Switches
from sandbox.physics.joints.joints import Joints


def make_switches(level: Level, joints: Joints) -> Switches:
    """Make a switch for everything that events switch, and connect the springs among it."""
    switches = {name: Switch(first) for name, first in switched(level).items()}
    for name in switches.keys() & joints.springs.keys():
        joints.springs[name] = replace(joints.springs[name], switch=switches[name])
    return switches
