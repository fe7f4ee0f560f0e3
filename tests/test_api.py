"""The sandbox in programs and notebooks does what its page says."""

import doctest
import json
import subprocess
import sys
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from IPython.core.interactiveshell import InteractiveShell
from PIL import Image

import sandbox
from sandbox import api, notebook
from sandbox.model import level_catalog
from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.loading import choose
from sandbox.physics import run

PAGE = Path(__file__).parents[1] / "docs" / "how-to" / "use-python.md"


@pytest.mark.sweep
def test_every_example_of_the_page_gives_what_it_says() -> None:
    found = doctest.testfile(str(PAGE), module_relative=False, optionflags=doctest.ELLIPSIS)

    assert found.attempted > 15
    assert found.failed == 0


def test_all_that_is_offered_is_there_and_nothing_else() -> None:
    assert set(sandbox.__all__) <= set(dir(sandbox))  # so that a notebook completes them
    for name in sandbox.__all__:
        assert getattr(sandbox, name) is getattr(api, name, sandbox.__version__)
    with pytest.raises(AttributeError, match="'sandbox' has no attribute 'lod'"):
        sandbox.lod  # noqa: B018


def test_the_package_alone_imports_no_engine() -> None:
    code = "import sys, sandbox; sys.exit('pymunk' in sys.modules or 'numpy' in sys.modules)"

    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.sweep
def test_a_run_has_the_bits_of_the_command_lines() -> None:
    level = sandbox.load("lagrange/double-pendulum")

    trace = sandbox.simulate(level, duration=1.0)

    same = run.simulate(level, choose(level, {}), 1.0)
    assert all((trace.columns[name] == same.columns[name]).all() for name in same.columns)


def test_a_parameter_that_is_not_there_is_told() -> None:
    with pytest.raises(SandboxError, match="m1"):
        sandbox.simulate(sandbox.load("newton/atwood"), {"m": 1.0})


def test_all_mistakes_of_a_made_level_are_told() -> None:
    with pytest.raises(LevelError) as caught:
        sandbox.make({"format": 1, "title": "x", "bodies": {"a": {"mas": 1}}, "duraton": 2})

    told = str(caught.value)
    assert "duraton" in told
    assert "mas" in told


def test_numbers_of_numpy_are_numbers_and_other_things_are_told() -> None:
    document = json.loads(level_catalog.find("kinematics/free-fall").read_text(encoding="utf-8"))
    level = sandbox.make({**document, "duration": np.float32(2.5)})
    assert level.duration(level.defaults) == 2.5

    with pytest.raises(LevelError, match="set"):
        sandbox.make({**document, "duration": {1}})


@pytest.mark.sweep
def test_a_notebook_shows_levels_and_traces() -> None:
    shell = InteractiveShell.instance()
    notebook.load_ipython_extension(shell)
    level = sandbox.load("kinematics/free-fall")
    trace = sandbox.simulate(level)

    assert shell.display_formatter is not None
    shown, _ = shell.display_formatter.format(level)
    told, _ = shell.display_formatter.format(trace)

    assert shown["image/png"].startswith(b"\x89PNG")
    assert "Free fall" in told["text/html"]
    assert told["text/html"].count("<tr>") == 12


def test_a_film_of_a_trace_lasts_as_long_as_the_trace() -> None:
    trace = sandbox.simulate(sandbox.load("newton/atwood"), duration=0.4)

    with Image.open(BytesIO(notebook.animation(trace).gif)) as film:
        assert film.n_frames == 11  # type: ignore[attr-defined] # of a GIF


@pytest.mark.sweep
def test_in_ipython_levels_and_traces_show_themselves_without_an_extension() -> None:
    code = (
        "from IPython.core.interactiveshell import InteractiveShell\n"
        "shell = InteractiveShell.instance()\n"
        "shell.run_cell('from sandbox import load, simulate')\n"
        "shell.run_cell('level = load(\"newton/atwood\"); trace = simulate(level)')\n"
        "show = shell.display_formatter.format\n"
        "print(*(sorted(show(shell.user_ns[name])[0]) for name in ('level', 'trace')))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == (
        "['image/png', 'text/plain'] ['text/html', 'text/plain']"
    )
