import json
from pathlib import Path

import pytest

from sandbox import interrupts, standard_streams
from sandbox.__main__ import main
from sandbox.model import level_catalog
from tests.cli.helpers import Outcome, Run, Write, fall


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs a command in this process."""
    for module in (interrupts, standard_streams):
        monkeypatch.setattr(module, "install", lambda: None)
    for name, value in (("SDL_VIDEODRIVER", "dummy"), ("SDL_AUDIODRIVER", "dummy")):
        monkeypatch.setenv(name, value)

    def run(*arguments: object) -> Outcome:
        capsys.readouterr()
        monkeypatch.setattr("sys.argv", ["sandbox", *map(str, arguments)])
        with pytest.raises(SystemExit) as exit_:
            main()
        assert isinstance(exit_.value.code, int)
        return Outcome(exit_.value.code, *capsys.readouterr())

    return run


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Writes a level file: a falling ball with the given changes."""

    def write(name: str = "fall.json", **parts: object) -> Path:
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps({**fall(), **parts}), encoding="utf-8")
        return path

    return write


@pytest.fixture
def chapters(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, write: Write) -> Path:
    """A catalog of one level, `motion/fall`."""
    monkeypatch.setattr(level_catalog, "root", lambda: tmp_path / "levels")
    write("levels/motion/fall.json")
    return tmp_path / "levels"
