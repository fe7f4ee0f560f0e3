"""What only a separate process can show: its imports, and how it ends."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.cli.helpers import Write
from tests.elsewhere import ROOT, limited, python

WINDOW = {"pygame", "pygame_gui"}
PLOTS = {"matplotlib", "scipy", "jinja2"}


def imported(code: str) -> set[str]:
    """Return the packages that are loaded after some code has run."""
    ending = "import json, sys\nsys.stderr.write(json.dumps(sorted(sys.modules)))"
    done = python("-c", f"{code}\n{ending}")
    return {name.partition(".")[0] for name in json.loads(done.stderr)}


def command(*arguments: object) -> str:
    """Return the code that runs a command."""
    argv = ["sandbox", *map(str, arguments)]
    return (
        f"import sys\nsys.argv = {argv!r}\nfrom sandbox.__main__ import main\n"
        "try:\n    main()\nexcept SystemExit as exit_:\n    assert not exit_.code, exit_.code"
    )


def test_importing_the_sandbox_imports_nothing_heavy() -> None:
    assert not imported("import sandbox") & (WINDOW | PLOTS | {"pymunk", "numpy", "pydantic"})


def test_help_imports_neither_model_nor_engine_nor_window() -> None:
    loaded = imported(command("--help"))

    assert not loaded & (WINDOW | PLOTS | {"pymunk", "numpy", "pydantic"})


@pytest.mark.sweep
@pytest.mark.parametrize("arguments", [["list"], ["check", "newton/atwood"]])
def test_what_only_reads_levels_imports_neither_engine_nor_window(arguments: list[str]) -> None:
    assert not imported(command(*arguments)) & (WINDOW | PLOTS | {"pymunk"})


@pytest.mark.sweep
def test_simulate_imports_no_window(write: Write, tmp_path: Path) -> None:
    loaded = imported(command("simulate", write(), "--output", tmp_path / "out.csv"))

    assert "pymunk" in loaded
    assert not loaded & (WINDOW | PLOTS)


@pytest.mark.sweep
def test_a_picture_is_drawn_without_a_word_from_libraries(write: Write, tmp_path: Path) -> None:
    path, output = write(), tmp_path / "out.png"

    done = python("-m", "sandbox", "render", path, "--output", output)

    assert (done.returncode, done.stdout, done.stderr) == (0, f"{output}: {path}\n", "")


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("arguments", "status"),
    [(["check", "nothing"], 1), (["simulate", "newton/atwood", "--output", "no/where.csv"], 2)],
)
def test_a_mistake_is_one_message_without_a_traceback(arguments: list[str], status: int) -> None:
    done = python("-m", "sandbox", *arguments)

    assert done.returncode == status
    assert done.stdout == ""
    assert done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.sweep
@pytest.mark.skipif(sys.platform == "win32", reason="a process cannot be sent a Ctrl-C there")
def test_ctrl_c_ends_a_run_quietly_and_leaves_no_file(write: Write, tmp_path: Path) -> None:
    """With an attraction, most of the time is spent in callbacks, where an exception is lost."""
    path = write(
        effects={"attraction": [{"mu": "g"}]},
        bodies={
            "ball": {
                "shape": {"type": "disc", "radius": 1},
                "mass": 1,
                "position": [5, 0],
                "velocity": [0, "sqrt(g/5)"],
            }
        },
        checks=[],
    )
    endless = ["simulate", path, "--duration", "1e5", "--output", tmp_path / "out.csv"]
    code = (
        f"import sys; sys.argv = {['sandbox', *map(str, endless)]}\n"
        "from sandbox import interrupts; interrupts.install(); print('ready', flush=True)\n"
        "from sandbox.__main__ import main; main()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", limited() + code],
        cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    ) as process:  # fmt: skip
        assert process.stdout
        assert process.stdout.readline() == "ready\n"
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        output, error = process.communicate()

    assert (process.returncode, output, error) == (130, "", "")
    assert list(tmp_path.iterdir()) == [path]
