"""Figures show numbers without distortion, and the closed form beside the measurements."""

import re
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from sandbox.experiments import report
from sandbox.experiments.experiment_folder import RESULTS
from sandbox.experiments.parameter_axes import parse
from sandbox.reporting.html_pages import inline
from tests.experiments.making import RANGE, plan, table


def page(tmp_path: Path, vary: dict[str, str], **others: object) -> str:
    found = plan("kinematics/projectile", vary, RANGE, duration=4, **others)
    table(found, tmp_path)
    return report.write(found, tmp_path / RESULTS, tmp_path).path.read_text("utf-8")


def test_what_a_label_says_is_not_rounded() -> None:
    """Only places in the picture are rounded, to a hundredth of a point."""
    figure = Figure()
    figure.subplots().set_xticks([2.0125, 2.015])
    svg = inline(figure, "ticks")
    assert ">2.0125<" in svg
    assert ">2.0150<" in svg
    assert not re.search(r'="[^"]*\.\d{3,}', svg)


@pytest.mark.sweep
def test_a_map_has_the_closed_form_s_lines(tmp_path: Path) -> None:
    html = page(tmp_path, {"angle": "20:70:9", "speed": "5:15:10"})
    assert "lines: the closed form, at the marks of the scale" in html


@pytest.mark.sweep
def test_a_histogram_has_the_closed_form_s_outline(tmp_path: Path) -> None:
    html = page(tmp_path, {"speed": "10±0.5"}, draws=40)
    assert ">closed form<" in html
    assert "40 runs, drawn independently, seed 0" in html


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("0:90:91", "0 to 90 kg, 91 values"),
        ("1:100:3:log", "1 to 100 kg, 3 values, with equal ratios"),
        ("1, 2.5", "1, 2.5 kg"),
        (",".join(map(str, range(30))), "0, 1, …, 29 kg, 30 values"),
        ("0..1", "drawn from 0 to 1 kg, each value as likely as any other"),
        ("1±0.1", "drawn from a normal distribution, (1 ± 0.1) kg"),
    ],
)
def test_a_page_tells_in_words_what_is_varied(text: str, told: str) -> None:
    assert parse(text).described("kg") == told
