"""The textbook's chapter, part by part, with the levels that show each part.

`python -m validation.chapter` writes it to `docs/reference/chapter.md`.
"""

import sys
from pathlib import Path
from typing import NamedTuple

from sandbox.model import catalog
from sandbox.model.files import write_atomically
from sandbox.model.generated_files import generate
from sandbox.model.loading import load

PAGE = Path("docs") / "reference" / "chapter.md"
"""The page that is written, within a checkout."""


class Part(NamedTuple):
    """A set-up, example, figure or claim of the document; one without levels is still missing."""

    section: str
    text: str
    levels: tuple[str, ...] = ()


KINEMATICS = "3. Kinematics"
NEWTON = "4. Newton's laws"
ENERGY = "5. Work and energy"
PROJECTILE = "6. Interactive: projectile motion"
MOMENTUM = "7. Momentum, impulse, and collisions"
ROTATION = "8. Rotational dynamics"
LAGRANGE = "9. Lagrangian mechanics"
CODE = "10. Classical mechanics in code"
MACHINES = "Machines, made of all of it"

PARTS = (
    Part(KINEMATICS, "two forces on a box, tip to tail", ("newton/two-forces",)),
    Part(KINEMATICS, "decomposition of a velocity", ("kinematics/components",)),
    Part(KINEMATICS, "turning at constant speed", ("kinematics/circular-motion",)),
    Part(KINEMATICS, "uniform acceleration", ("kinematics/uniform-acceleration",)),
    Part(KINEMATICS, "free fall", ("kinematics/free-fall",)),
    Part(KINEMATICS, "projectile from a height", ("kinematics/projectile-from-height",)),
    Part(NEWTON, "first law", ("newton/first-law", "newton/friction-brings-to-rest")),
    Part(NEWTON, "second law: one force, several masses", ("newton/second-law",)),
    Part(NEWTON, "third law: two skaters push off", ("newton/third-law",)),
    Part(NEWTON, "mass that changes: a rocket", ("newton/rocket", "newton/rocket-launch")),
    Part(
        NEWTON,
        "mass that changes: sand on a conveyor belt",
        ("newton/conveyor-belt", "newton/cart-under-hopper", "newton/block-on-a-belt"),
    ),
    Part(
        NEWTON,
        "the Atwood machine",
        (
            "newton/atwood",
            "newton/atwood-equal-masses",
            "newton/atwood-thousand-to-one",
            "newton/atwood-with-a-push",
            "newton/compound-pulley",
            "newton/double-atwood",
        ),
    ),
    Part(NEWTON, "an Atwood machine with a massive pulley", ("newton/atwood-massive-pulley",)),
    Part(
        NEWTON,
        "free-body diagrams: two bodies and a string",
        ("newton/table-and-pulley", "newton/table-and-pulley-with-friction"),
    ),
    Part(
        NEWTON,
        "block on an incline",
        (
            "newton/incline",
            "newton/incline-limits",
            "newton/heavy-and-light",
            "newton/incline-with-friction",
            "newton/incline-that-holds",
        ),
    ),
    Part(
        NEWTON,
        "static and kinetic friction apart",
        ("newton/breaking-loose", "newton/incline-breaks-loose"),
    ),
    Part(NEWTON, "drag", ("newton/terminal-velocity", "newton/projectile-with-drag")),
    Part(NEWTON, "second law: drag in a wind", ("newton/wind",)),
    Part(NEWTON, "second law: buoyancy", ("newton/floating-block",)),
    Part(ENERGY, "work along a straight and an oblique path", ("energy/refrigerator",)),
    Part(ENERGY, "braking distance grows as v²", ("energy/braking-distance",)),
    Part(
        ENERGY,
        "the well of gravity near the Earth",
        ("kinematics/free-fall", "energy/well-gravity"),
    ),
    Part(
        ENERGY,
        "the well of a spring",
        (
            "energy/well-spring",
            "energy/spring-oscillator",
            "energy/damped-spring",
            "energy/critical-damping",
            "energy/spring-pendulum",
        ),
    ),
    Part(
        ENERGY,
        "a driven spring and its resonance",
        ("energy/driven-spring", "energy/resonance"),
    ),
    Part(
        ENERGY,
        "the 1/r well",
        (
            "energy/well-one-over-r",
            "energy/circular-orbit",
            "energy/kepler-ellipse",
            "energy/kepler-third-law",
            "energy/escape-velocity",
            "energy/precession",
        ),
    ),
    Part(
        ENERGY,
        "bodies that attract each other",
        ("energy/two-bodies", "energy/figure-eight"),
    ),
    Part(ENERGY, "potentials of one's own", ("energy/molecule", "energy/hardening-spring")),
    Part(ENERGY, "the 1/r hill of like charges", ("energy/repulsion",)),
    Part(ENERGY, "ball down a straight ramp: 6.26 m/s", ("energy/ramp",)),
    Part(
        ENERGY,
        "ball down a curved ramp, a zigzag and a helix",
        (
            "energy/curved-ramp",
            "energy/loop",
            "energy/zigzag",
            "energy/helix",
            "energy/four-slides",
            "energy/brachistochrone",
            "energy/cycloid-slide",
        ),
    ),
    Part(PROJECTILE, "speed and angle, apex and landing", ("kinematics/projectile",)),
    Part(PROJECTILE, "30° and 60° reach equally far", ("kinematics/complementary-angles",)),
    Part(PROJECTILE, "none reaches as far as 45°", ("kinematics/best-angle",)),
    Part(PROJECTILE, "twice the speed, four times the height", ("kinematics/doubled-speed",)),
    Part(
        PROJECTILE,
        "time of flight, whatever the horizontal speed",
        ("kinematics/time-of-flight",),
    ),
    Part(MOMENTUM, "impulse of a given force", ("momentum/force-profile",)),
    Part(MOMENTUM, "stiff and soft bumper", ("momentum/bumpers",)),
    Part(MOMENTUM, "momentum is conserved", ("momentum/center-of-mass",)),
    Part(MOMENTUM, "recoil, and a burst", ("momentum/recoil", "momentum/burst")),
    Part(MOMENTUM, "elastic, equal masses", ("momentum/elastic-equal-masses",)),
    Part(MOMENTUM, "elastic, heavy on light", ("momentum/elastic-heavy-on-light",)),
    Part(MOMENTUM, "elastic, light on heavy", ("momentum/elastic-light-on-heavy",)),
    Part(MOMENTUM, "elastic, off centre", ("momentum/glancing",)),
    Part(MOMENTUM, "elastic, again and again", ("momentum/between-walls",)),
    Part(
        MOMENTUM,
        "Newton's cradle",
        ("momentum/cradle", "momentum/cradle-on-a-line", "momentum/billiard-break"),
    ),
    Part(
        MOMENTUM,
        "between elastic and not",
        ("momentum/restitution", "momentum/bouncing-ball", "momentum/bounce-by-bounce"),
    ),
    Part(MOMENTUM, "perfectly inelastic", ("momentum/inelastic", "momentum/sticking")),
    Part(MOMENTUM, "ballistic pendulum", ("momentum/ballistic-pendulum",)),
    Part(ROTATION, "door pushed at hinge, middle and handle", ("rotation/door",)),
    Part(ROTATION, "balance beam", ("rotation/balance-beam",)),
    Part(ROTATION, "a hoop rolls slower than a disc", ("rotation/rolling", "rotation/race")),
    Part(ROTATION, "from sliding to rolling", ("rotation/slide-to-roll",)),
    Part(
        ROTATION,
        "rolling in a half-pipe, and in cycloids",
        ("rotation/half-pipe", "rotation/cycloid-bowls"),
    ),
    Part(ROTATION, "angular momentum is conserved", ("rotation/thrown-box", "rotation/skater")),
    Part(ROTATION, "a star that collapses spins faster", ("rotation/collapsing-star",)),
    Part(
        ROTATION,
        "moments of inertia and the parallel axis",
        (
            "rotation/moments-of-inertia",
            "rotation/parallel-axis",
            "rotation/drum-and-weight",
            "rotation/physical-pendulum",
            "rotation/hidden-weight",
        ),
    ),
    Part(ROTATION, "torque of a motor", ("rotation/motor", "rotation/limited-motor")),
    Part(ROTATION, "torsion pendulum", ("rotation/torsion-pendulum",)),
    Part(ROTATION, "yo-yo", ("rotation/yo-yo",)),
    Part(LAGRANGE, "pendulum", ("lagrange/simple-pendulum", "lagrange/large-pendulum")),
    Part(LAGRANGE, "double pendulum", ("lagrange/double-pendulum",)),
    Part(
        LAGRANGE,
        "bead on a wire, and on a rotating hoop",
        ("lagrange/bead-on-a-wire", "lagrange/rotating-hoop"),
    ),
    Part(
        LAGRANGE,
        "coupled oscillators",
        ("lagrange/coupled-oscillators", "lagrange/beats", "lagrange/chain-of-springs"),
    ),
    Part(LAGRANGE, "cart and pendulum", ("lagrange/cart-and-pendulum",)),
    Part(LAGRANGE, "least action", ("lagrange/least-action",)),
    Part(CODE, "projectile: range 63.7 m", ("kinematics/projectile",)),
    Part(
        CODE,
        "Euler against symplectic Euler on the pendulum",
        (
            "lagrange/euler-pendulum",
            "lagrange/symplectic-pendulum",
            "lagrange/leapfrog-pendulum",
        ),
    ),
    Part(MACHINES, "a car over bumps", ("machines/car-over-bumps",)),
    Part(MACHINES, "two carts on two slopes", ("machines/two-carts",)),
    Part(MACHINES, "a trebuchet", ("machines/trebuchet",)),
    Part(MACHINES, "a seesaw that throws", ("machines/seesaw",)),
    Part(MACHINES, "a wrecking ball", ("machines/wrecking-ball",)),
    Part(MACHINES, "a cam and its follower", ("machines/cam",)),
    Part(MACHINES, "a rope around a drum", ("machines/capstan",)),
    Part(
        MACHINES,
        "what friction holds, and lets go again and again",
        ("machines/waiters-tray", "machines/squeaking-crate"),
    ),
    Part(MACHINES, "a ladder that slides off its wall", ("machines/sliding-ladder",)),
    Part(MACHINES, "a marble run", ("machines/marble-run",)),
    Part(MACHINES, "torques at rest and in motion", ("machines/crane", "machines/drawbridge")),
    Part(MACHINES, "virtual work", ("machines/scissor-lift",)),
    Part(MACHINES, "a crank and its piston", ("machines/engine", "machines/flywheel")),
    Part(MACHINES, "a circle made a line", ("machines/chebyshev-linkage",)),
    Part(MACHINES, "a belt that drives a wheel", ("machines/belt-drive",)),
    Part(MACHINES, "ten bodies on nine pins", ("machines/ragdoll",)),
)


def parts() -> list[Part]:
    """Return all parts, and the references of levels that match none of them."""
    named = {name for part in PARTS for name in part.levels}
    others = (name for name in catalog.textbook() if name not in named)
    every = [*PARTS, *map(_by_reference, others)]
    sections = list(dict.fromkeys(part.section for part in every))
    return sorted(every, key=lambda part: sections.index(part.section))


def _by_reference(level: str) -> Part:
    section, _, text = load(catalog.find(level)).reference.partition(": ")
    return Part(section, text, (level,))


def page() -> str:
    """Return the map as Markdown."""
    every = parts()
    owed = sum(not part.levels for part in every)
    lines = [
        "# The chapter, part by part",
        "",
        f"{len(every) - owed} of {len(every)} parts can be played.",
        "This page is written by `make docs`.",
    ]
    section = ""
    for part in every:
        if part.section != section:
            section = part.section
            lines += ["", f"## {section}", "", "| part | levels |", "|---|---|"]
        levels = ", ".join(f"[{name}](../../levels/{name}.json)" for name in part.levels)
        lines.append(f"| {part.text} | {levels or '*still owed*'} |")
    return "\n".join(lines) + "\n"


def main() -> int:
    """Write the map, and return the exit status."""
    return generate(_write)


def _write() -> list[Path]:
    write_atomically(catalog.sources() / PAGE, page())
    return []


if __name__ == "__main__":
    sys.exit(main())
