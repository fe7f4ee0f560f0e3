"""A cluster, here of two workers on this machine, computes the same bits."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from distributed import Client

from sandbox.experiments.batch_scheduling import conduct
from sandbox.experiments.executors import SerialExecutor, cluster
from sandbox.experiments.experiment_folder import RESULTS, Store
from sandbox.experiments.plan import Plan
from sandbox.model.errors import SandboxError
from tests.experiments.machines import Machines
from tests.experiments.making import RANGE, plan, table

THROW, END = "kinematics/projectile", "ball.position.x@end"


@pytest.fixture
def machines() -> Iterator[Machines]:
    made = Machines()
    yield made
    made.end()


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    made = Machines()
    yield made.address
    made.end()


@pytest.mark.sweep
@pytest.mark.filterwarnings("ignore")  # whatever Dask says of itself
def test_a_cluster_and_this_process_make_the_same_file(tmp_path: Path, address: str) -> None:
    found = plan(THROW, {"angle": "6:85:200", "g": "9.81±0.01"}, RANGE, draws=2)
    table(found, tmp_path / "here")
    with cluster(address, workers=2) as there:
        assert there.jobs == 2
        table(found, tmp_path / "there", there)
    files = [(tmp_path / name / RESULTS).read_bytes() for name in ("here", "there")]
    assert files[0] == files[1]


@pytest.mark.sweep
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_that_is_not_there_is_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sandbox.experiments.executors.PATIENCE", 1)
    with (
        pytest.raises(SandboxError, match=r"no scheduler answers at tcp://127\.0\.0\.1:9"),
        cluster("tcp://127.0.0.1:9"),
    ):
        pass


def drag(count: int = 60) -> Plan:
    return plan("newton/projectile-with-drag", {"angle": f"20:80:{count}"}, END, duration=0.3)


@pytest.mark.sweep
@pytest.mark.filterwarnings("ignore")
def test_what_a_lost_worker_was_at_is_done_by_another(tmp_path: Path, address: str) -> None:
    found, killed = drag(), list[int]()
    table(found, tmp_path / "here")
    store = Store(tmp_path / "there", found)
    with cluster(address, workers=2) as there, Client(address, set_as_default=False) as client:
        workers = list(client.run(os.getpid).values())

        def kill(_: int) -> None:
            if not killed:
                killed.append(workers[0])
                os.kill(workers[0], signal.SIGKILL)

        conduct(found, store, there, kill)
    assert killed
    assert store.results.read_bytes() == (tmp_path / "here" / RESULTS).read_bytes()


@pytest.mark.sweep
@pytest.mark.filterwarnings("ignore")
def test_a_scheduler_that_goes_away_is_a_sentence_and_what_was_done_is_kept(
    tmp_path: Path, machines: Machines
) -> None:
    found = drag()
    store = Store(tmp_path / "there", found)
    with (
        pytest.raises(SandboxError, match=r"the cluster at tcp.* has (failed|gone)"),
        cluster(machines.address, workers=2) as there,
    ):
        conduct(found, store, there, lambda _: machines.scheduler.kill())
    # Which batches had come by then, and whether they are neighbours, is up to the workers.
    missing = sum(end - begin for begin, end in store.missing())
    assert 0 < missing < found.runs
    conduct(found, store, SerialExecutor(), lambda _: None)
    table(found, tmp_path / "here")
    assert store.results.read_bytes() == (tmp_path / "here" / RESULTS).read_bytes()
