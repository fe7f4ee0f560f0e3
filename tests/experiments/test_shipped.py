"""Each experiment that comes with the project runs, in a small version, and its page is drawn."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from sandbox.experiments import catalog, report, write_json_schema
from sandbox.experiments.experiment_folder import RESULTS
from sandbox.experiments.plan import Plan
from sandbox.experiments.plan_validation import make
from tests.experiments.making import table


def small(name: str, most: int = 2) -> Plan:
    """Return an experiment with two values of each axis, or two draws."""
    whole = catalog.open_plan(catalog.find(name))
    vary = {}
    for axis, text in whole.experiment.vary.items():
        listed = ",".join(text.split(",")[:most])
        vary[axis] = re.sub(r"^([-\d.]+:[-\d.]+):\d+", rf"\1:{most}", listed)
    draws = 4 if whole.experiment.draws else None
    update = {"vary": vary, "draws": draws}
    experiment = whole.experiment.model_copy(update=update)
    found, faults = make(experiment, whole.source, whole.level)
    assert not faults
    return found


def test_there_are_ten() -> None:
    assert len(catalog.names()) >= 10


@pytest.mark.sweep
@pytest.mark.parametrize("name", catalog.names())
def test_a_small_version_runs_and_is_drawn(name: str, tmp_path: Path) -> None:
    found = small(name)
    rows = table(found, tmp_path)
    assert rows["failure"].null_count == len(rows), rows["failure"].to_pylist()
    page = report.write(found, tmp_path / RESULTS, tmp_path)
    html = page.path.read_text("utf-8")
    assert not re.search(r"""(src|href)=["']?https?:""", html)  # it loads nothing
    for measure in found.measures:
        if not measure.text.endswith("@until"):
            assert "<svg" in html
            assert any(x is not None for x in rows[measure.text].to_pylist())


@pytest.mark.sweep
def test_a_braking_distance_is_that_of_the_closed_form(tmp_path: Path) -> None:
    rows = table(small("braking-with-care"), tmp_path)
    [error] = [name for name in rows.column_names if name.endswith(" error")]
    assert max(rows[error].to_pylist()) < 1e-9


@pytest.mark.sweep
def test_stages_give_what_tsiolkovsky_says(tmp_path: Path) -> None:
    """Δv = u ln(m0/m1) + u ln(m2/m3), whatever is dropped in between."""
    rows = table(small("rocket-staging"), tmp_path)
    first, shell = (np.array(rows[name].to_pylist()) for name in ("first", "shell"))
    start, upper = 80 * (1 + shell) + 5, 80 * (1 - first) * (1 + shell) + 5
    speeds = np.log(start / (start - 80 * first)) + np.log(upper / (upper - 80 * (1 - first)))
    measured = rows["both.velocity.x + upper.velocity.x@end"].to_pylist()
    assert measured == pytest.approx(100 * speeds, rel=1e-3)


def test_a_block_slides_beyond_the_angle_of_friction_only(tmp_path: Path) -> None:
    rows = table(small("incline-threshold"), tmp_path)
    for angle, mu, speed in zip(
        *(rows[n].to_pylist() for n in rows.column_names[1:4]), strict=True
    ):
        assert (speed > 1e-6) == (np.tan(np.radians(angle)) > mu)


def test_the_schema_s_file_is_that_of_the_format() -> None:
    """If not: `python -m sandbox.experiments.write_json_schema` writes it."""
    assert (catalog.root() / catalog.SCHEMA).read_text("utf-8") == write_json_schema.text()


@pytest.mark.parametrize("name", catalog.names())
def test_a_file_says_no_key_that_the_schema_does_not_know(name: str) -> None:
    known = json.loads(write_json_schema.text())["properties"]
    assert set(json.loads(catalog.find(name).read_text("utf-8"))) <= set(known)
