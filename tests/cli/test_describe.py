"""`describe`: a scene in words."""

from pathlib import Path

import pytest

from sandbox.app.observing.scene_in_words import MANY
from sandbox.model import level_catalog
from sandbox.physics.measuring.free_body import FreeBody
from sandbox.physics.measuring.free_body_forces import FreeBodies
from tests.cli.helpers import Run


def test_says_what_is_there_how_it_moves_and_what_holds_it(run: Run) -> None:
    """Atwood's machine of 1 and 1.5 kg: a = g/5, with a tension of 2.4 m g over 2 kg."""
    told = run("describe", "newton/atwood", "--at", "0.5").out

    assert told.startswith("Atwood machine. Two masses on a light string")
    assert "Time: 0.5000 s of 1.596 s." in told
    assert "Effects: gravity." in told
    assert "left: a box of 0.500 m by 0.500 m, 1.000 kg" in told
    assert "moves up at 0.9810 m/s" in told
    assert "string: a pulley from left over the point" in told
    assert "pulls with 11.77 N" in told
    assert "acceleration: 1.9620 m/s², expected 1.9620 m/s²; passed" in told


def test_says_what_touches_and_how_hard(run: Run) -> None:
    told = run("describe", "newton/incline-that-holds", "--at", "1", "--set", "angle=10").out

    assert "block: a box of 0.800 m by 0.500 m, 2.000 kg" in told
    assert "at rest" in told
    assert "press on each other with 19.32 N" in told


def test_says_where_a_line_is_and_no_rounding_of_places_and_forces(run: Run) -> None:
    """A beam was said to be at 0, and balls at rest at −4e-18 m, with forces of 7e-9 N."""
    told = run("describe", "momentum/cradle", "--at", "0.6").out

    assert "beam: a static segment, from x = −0.3000 m, y = 1.030 m to x = 1.100 m" in told
    assert "at x = 0.2000 m, y = 0 m; at rest" in told
    assert "ball1 and ball2 touch" in told
    assert "e−" not in told


def test_says_the_forces_on_each_body_where_they_are_asked_for(run: Run) -> None:
    """2 kg on a slope of 30° with friction 0.3: m g (sin 30° − 0.3 cos 30°) remains."""
    asked = "describe", "newton/incline-with-friction", "--at", "0.5"

    told = run(*asked, "--forces").out

    assert "block: weight 19.62 N down; normal force from ramp 16.99 N left and up;" in told
    assert "friction from ramp 5.097 N right and up; together 4.713 N left and down" in told
    assert "it accelerates at 2.356 m/s²" in told
    assert "Forces:" not in run(*asked).out


def test_of_a_crowd_only_the_forces_that_are_shown_are_computed(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Those of 300 floating polygons, of which 40 are shown, took 5 s."""
    asked, of = list[str](), FreeBodies.of

    def counted(self: FreeBodies, name: str) -> FreeBody | None:
        asked.append(name)
        return of(self, name)

    monkeypatch.setattr(FreeBodies, "of", counted)
    path = tmp_path / "crowd.json"
    run("generate", "gas", "--bodies", "100", "--output", str(path))

    told = run("describe", str(path), "--at", "0.1", "--forces").out

    assert len(asked) == MANY
    assert "  and 60 more" in told


def test_says_a_torque_beside_its_force(run: Run) -> None:
    told = run("describe", "rotation/motor", "--at", "0.5", "--forces").out

    assert "with a torque of 3.560 N m" in told


@pytest.mark.parametrize("name", level_catalog.names()[::12])
def test_any_level_can_be_described_at_its_start(run: Run, name: str) -> None:
    result = run("describe", name, "--forces")

    assert result.status == 0
    assert "Bodies:" in result.out
    assert max(map(len, result.out.splitlines())) < 400


@pytest.mark.parametrize("at", ["-1", "nan", "1e9"])
def test_a_time_that_cannot_be_is_refused(run: Run, at: str) -> None:
    result = run("describe", "newton/atwood", f"--at={at}")

    assert result.status == 2
    assert "--at" in result.err
