"""A cluster of several machines, here of two workers on this one, comes to the same bits."""

import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from sandbox.experiments.executors import cluster
from sandbox.experiments.storage import RESULTS
from sandbox.model.errors import SandboxError
from tests.elsewhere import ROOT
from tests.experiments.making import RANGE, plan, table

THROW = "kinematics/projectile"


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """Yield the address of a scheduler with two workers, started as the documents say."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    place = f"tcp://127.0.0.1:{port}"
    scheduler = ["scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard"]
    worker = ["worker", place, "--nworkers", "2", "--nthreads", "1", "--no-dashboard",
              "--memory-limit", "0"]  # fmt: skip
    both = [
        subprocess.Popen(
            [sys.executable, "-m", "distributed.cli.dask_" + command[0], *command[1:]],
            cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )
        for command in (scheduler, worker)
    ]  # fmt: skip
    try:
        yield place
    finally:
        for process in reversed(both):
            process.terminate()
            process.wait(30)


@pytest.mark.filterwarnings("ignore")  # whatever Dask says of itself
def test_a_cluster_and_this_process_make_the_same_file(tmp_path: Path, address: str) -> None:
    found = plan(THROW, {"angle": "6:85:200", "g": "9.81±0.01"}, RANGE, draws=2)
    table(found, tmp_path / "here")
    with cluster(address, workers=2) as there:
        assert there.jobs == 2
        table(found, tmp_path / "there", there)
    files = [(tmp_path / name / RESULTS).read_bytes() for name in ("here", "there")]
    assert files[0] == files[1]


@pytest.mark.filterwarnings("ignore")
def test_a_cluster_that_is_not_there_is_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sandbox.experiments.executors.PATIENCE", 1)
    with (
        pytest.raises(SandboxError, match=r"no scheduler answers at tcp://127\.0\.0\.1:9"),
        cluster("tcp://127.0.0.1:9"),
    ):
        pass
