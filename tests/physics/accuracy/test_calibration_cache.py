"""Settings that are kept for an accuracy, and which entries are not trusted."""

import json
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.accuracy import calibration_cache
from sandbox.physics.accuracy.calibration_cache import calibrated
from sandbox.physics.accuracy.exceptions import Cancelled
from sandbox.physics.accuracy.requested_accuracy import Setting, calibrate
from sandbox.physics.run import build, simulate
from tests.physics.accuracy.test_requested_accuracy import delivered, oscillator
from tests.physics.scenes import orbit


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[float]:
    """Keep settings in a folder of the test, and count how often one is searched for."""
    calls: list[float] = []
    real: Callable[..., Setting] = calibrate

    def counting(scene: Level, values: Values, target: float, **rest: object) -> Setting:
        calls.append(target)
        return real(scene, values, target, **rest)

    monkeypatch.setattr(calibration_cache, "calibrate", counting)
    monkeypatch.setattr(calibration_cache, "folder", lambda: tmp_path / "cache" / "accuracy")
    monkeypatch.setattr(calibration_cache, "_unkept", {})
    return calls


def kept() -> list[Path]:
    return sorted(calibration_cache.folder().glob("*.json"))


def test_a_setting_is_found_out_once(counted: list[float]) -> None:
    first = calibrated(oscillator(), target=1e-3)
    again = calibrated(oscillator(), target=1e-3)

    assert first == again
    assert counted == [1e-3]


@pytest.mark.sweep
def test_another_level_or_target_or_code_is_another_setting(
    counted: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    calibrated(oscillator(), target=1e-3)
    calibrated(oscillator(k=11), target=1e-3)
    calibrated(oscillator(), target=2e-3)
    monkeypatch.setattr(calibration_cache, "_code", lambda: "other")
    calibrated(oscillator(), target=1e-3)

    assert len(counted) == len(kept()) == 4


@pytest.mark.sweep
@pytest.mark.parametrize(
    "mangle",
    [
        lambda _: "",
        lambda text: text[:-20],
        lambda text: text.replace('"cost":', '"coast":'),
        lambda text: text.replace('"target":0.001', '"target":0'),
        lambda text: text.replace(text[2:10], "00000000"),
        lambda text: text.replace('"leapfrog"', '"magic"').replace('"fourth-order"', '"magic"'),
        lambda _: "[" * 100_000,
    ],
)
def test_a_spoilt_file_is_not_used(counted: list[float], mangle: Callable[[str], str]) -> None:
    found = calibrated(oscillator(), target=1e-3)
    [file] = kept()
    file.write_text(mangle(file.read_text()))

    again = calibrated(oscillator(), target=1e-3)

    assert found.chosen.error <= again.target
    assert again.chosen.error <= again.target
    assert len(counted) == 2
    assert calibrated(oscillator(), target=1e-3) == again  # mended
    assert len(counted) == 2


def _edited(text: str) -> str:
    """Edit an entry to say 1 Hz and explicit Euler, at the error found for something else."""
    entry = json.loads(text)
    entry[2]["chosen"]["stepping"] |= {"rate": 1.0, "scheme": "explicit-euler"}
    return json.dumps(entry)


@pytest.mark.parametrize("edit", [_edited, lambda text: text.replace('"rate":', '"rate":1')])
def test_a_setting_that_a_hand_has_changed_is_not_believed(
    counted: list[float], edit: Callable[[str], str]
) -> None:
    found = calibrated(oscillator(), target=1e-3)
    [file] = kept()
    assert edit(file.read_text()) != file.read_text()
    file.write_text(edit(file.read_text()))

    assert calibrated(oscillator(), target=1e-3).chosen.stepping == found.chosen.stepping
    assert len(counted) == 2


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_a_setting_is_not_written_through_a_link(counted: list[float], tmp_path: Path) -> None:
    other = tmp_path / "another's file"
    calibrated(oscillator(), target=1e-3)
    [file] = kept()
    content = file.read_bytes()
    other.write_bytes(content)
    file.unlink()
    file.symlink_to(other)

    calibrated(oscillator(), target=1e-3)

    assert len(counted) == 2  # nor is it read through one
    assert other.read_bytes() == content
    assert not file.is_symlink()


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_a_setting_is_not_written_into_a_folder_that_is_a_link(
    counted: list[float], tmp_path: Path
) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "cache").mkdir()
    calibration_cache.folder().symlink_to(tmp_path / "elsewhere")
    told: list[str] = []

    calibrated(oscillator(), target=1e-3, tell=told.append)

    assert "is a link, which may lead anywhere" in told[0]
    assert list((tmp_path / "elsewhere").iterdir()) == []
    assert len(counted) == 1


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no such pipes there")
def test_a_pipe_in_the_place_of_a_setting_is_not_waited_for(counted: list[float]) -> None:
    calibrated(oscillator(), target=1e-3)
    [file] = kept()
    file.unlink()
    os.mkfifo(file)

    assert calibrated(oscillator(), target=1e-3).chosen.error <= 1e-3
    assert len(counted) == 2


def test_a_folder_that_cannot_be_written_costs_only_the_memory(
    counted: list[float], tmp_path: Path
) -> None:
    (tmp_path / "cache").write_text("no folder")
    told: list[str] = []

    setting = calibrated(oscillator(), target=1e-3, tell=told.append)

    assert setting.chosen.error <= 1e-3
    assert "not kept for the next time: cannot make the folder" in told[0]
    assert calibrated(oscillator(), target=1e-3) == setting  # while the process lives
    assert len(counted) == len(told) == 1


@pytest.mark.usefixtures("counted")
def test_a_full_disk_costs_only_the_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, os.strerror(28))

    monkeypatch.setattr(calibration_cache, "write_atomically", full)
    told: list[str] = []

    assert calibrated(oscillator(), target=1e-3, tell=told.append).chosen.error <= 1e-3
    assert "No space left" in told[0]


@pytest.mark.usefixtures("counted")
def test_what_is_cancelled_is_not_kept() -> None:
    with pytest.raises(Cancelled):
        calibrated(oscillator(), stop=lambda: True)

    assert kept() == []


@pytest.mark.sweep
def test_a_level_may_ask_for_its_accuracy(counted: list[float]) -> None:
    scene = oscillator(stepping={"accuracy": 1e-5})
    world = build(scene)

    assert world.stepping == calibrated(scene, target=1e-5).chosen.stepping
    assert world.stepping.accuracy is None
    assert len(counted) == 1
    assert np.isfinite(world.advance(10).position).all()
    assert delivered(scene, world.stepping) <= 1e-5


@pytest.mark.sweep
@pytest.mark.parametrize("accuracy", [1e-7, 1e-8])
def test_a_longer_run_is_judged_for_as_long_as_it_lasts(
    counted: list[float], accuracy: float
) -> None:
    """Four times as long, an orbit that comes round early is four times as wrong."""
    name, asked = "planet.position.x", Stepping(accuracy=accuracy)
    scene = orbit(0.8)
    short = simulate(scene, record=[name], stepping=asked)
    long = simulate(scene, duration=40, record=[name], stepping=asked)

    def off(setting: Stepping) -> float:
        """Return by how much it is off within 40 s [m]."""
        rates = setting, setting.at(4 * setting.rate)
        run, finer = (
            simulate(scene, duration=40, record=[name], stepping=s).columns[name] for s in rates
        )
        return float(np.abs(run[:-1] - finer[::4][: len(run) - 1]).max())

    assert off(long.stepping) <= accuracy
    assert off(long.stepping) < off(short.stepping) / 2
    assert len(counted) == 2
