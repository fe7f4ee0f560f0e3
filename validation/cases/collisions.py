"""Collisions on a line: momentum always, energy where they are elastic."""

from collections.abc import Iterator

from sandbox.model.expressions import Values
from sandbox.model.level import ContactEvent
from validation.case import Case, Parameters, ends
from validation.formulas import energy, momentum

AFTER = ContactEvent(event="contact", bodies=("first", "second"))


def _at_the_ends(name: str, *turned: str) -> Iterator[tuple[str, Parameters]]:
    return ((name, parameters) for parameters in ends(f"momentum/{name}", *turned))


LEVELS: tuple[tuple[str, Parameters], ...] = (
    ("elastic-equal-masses", {}),
    *_at_the_ends("elastic-equal-masses", "m2", "v2"),
    ("elastic-heavy-on-light", {}),
    *_at_the_ends("elastic-heavy-on-light", "v2"),
    ("elastic-light-on-heavy", {}),
    *_at_the_ends("elastic-light-on-heavy", "m2"),
    ("inelastic", {}),
    *_at_the_ends("inelastic", "m2"),
    ("restitution", {}),
    ("restitution", {"e": 0.0}),
    ("restitution", {"e": 0.9, "m1": 10.0, "v2": -3.0}),
    *_at_the_ends("restitution", "m1"),
)
SOLVED = "one contact between two bodies: the solver's first sweep is exact"


def cases() -> Iterator[Case]:
    """Yield the cases of collisions on a line."""
    for name, parameters in LEVELS:
        restitution = {"inelastic": 0.0, "restitution": None}.get(name, 1.0)
        yield from _collision(name, parameters, restitution)


def _collision(name: str, parameters: Parameters, restitution: float | None) -> Iterator[Case]:
    def after(p: Values) -> tuple[float, float]:
        e = p["e"] if restitution is None else restitution
        return momentum.collision_velocities(p["m1"], p["m2"], p["v1"], p["v2"], e)

    level, title = f"momentum/{name}", f"collision, {name.replace('-', ' ')}"
    for i, body in enumerate(("first", "second")):
        yield Case(
            name=f"{title}: velocity of the {body} after it",
            level=level,
            parameters=parameters,
            quantity=f"{body}.velocity.x",
            at=AFTER,
            expected=lambda p, _, i=i: after(p)[i],  # type: ignore[misc]
            tolerance=1e-12,
            because=SOLVED,
        )
    yield Case(
        name=f"{title}: momentum at every step",
        level=level,
        parameters=parameters,
        quantity="system.momentum.x",
        expected=lambda p, _: p["m1"] * p["v1"] + p["m2"] * p["v2"],
        tolerance=1e-12,
        because="an impulse acts on both bodies alike, to rounding",
    )
    yield Case(
        name=f"{title}: kinetic energy after it",
        level=level,
        parameters=parameters,
        quantity="system.kinetic_energy",
        at=AFTER,
        expected=lambda p, _: energy.kinetic_energy(
            *zip((p["m1"], p["m2"]), after(p), strict=True)
        ),
        tolerance=1e-12,
        because=SOLVED,
    )
