"""Every row has the same bits, whoever runs it in whatever batches; failures are explained."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from random import Random

import pytest

from sandbox.experiments.batch_scheduling import conduct
from sandbox.experiments.executors import ProcessExecutor, SerialExecutor
from sandbox.experiments.experiment_folder import PARTS, RESULTS, Store
from sandbox.experiments.plan import Plan
from sandbox.experiments.row_runs import Task, pack, run
from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import Message
from tests.elsewhere import PATIENCE, ROOT
from tests.experiments.making import RANGE, plan, table
from tests.patience import alive
from tests.test_parallel_processes import until

THROW = "kinematics/projectile"
DRAG, END = "newton/projectile-with-drag", "ball.position.x@end"


def throws(count: int = 60) -> Plan:
    return plan(THROW, {"angle": f"6:85:{count}", "speed": "10±1"}, RANGE, draws=2, duration=6)


@pytest.mark.sweep
def test_one_process_and_two_make_the_same_file(tmp_path: Path) -> None:
    found = throws()
    table(found, tmp_path / "one")
    table(found, tmp_path / "two", ProcessExecutor(2))
    files = [(tmp_path / name / RESULTS).read_bytes() for name in ("one", "two")]
    assert files[0] == files[1]


@pytest.mark.parametrize(
    ("level", "vary", "measure"),
    [
        (THROW, {"angle": "6:85:12"}, RANGE),
        ("newton/incline-with-friction", {"angle": "20:40:6"}, "block.speed@end"),
        ("newton/projectile-with-drag", {"without": "none, drag", "angle": "40, 50"}, "t@landing"),
    ],
)
def test_a_row_is_the_same_in_whatever_batch(
    level: str, vary: dict[str, str], measure: str
) -> None:
    found = plan(level, vary, measure, duration=0.4)
    packed = pack(found)
    whole = run(Task(packed, 0, found.runs)).columns
    single = [run(Task(packed, i, i + 1)).columns for i in range(found.runs)]
    assert whole == [[cell for [cell] in column] for column in zip(*single, strict=True)]


def test_without_an_effect_a_run_is_that_of_the_level_without_it(tmp_path: Path) -> None:
    found = plan("newton/projectile-with-drag", {"without": "none, drag"}, "ball.position.x@1")
    with_drag, free = table(found, tmp_path)["ball.position.x@1"].to_pylist()
    assert free == pytest.approx(15 * 0.5**0.5, rel=1e-9)
    assert with_drag < free


def test_a_run_that_fails_is_a_row_with_its_reason(tmp_path: Path) -> None:
    """Drawn values may be outside the level's range."""
    rows = table(plan(THROW, {"angle": "88.5±1.5"}, RANGE, draws=40), tmp_path)
    failed = [reason for reason in rows["failure"].to_pylist() if reason]
    assert 0 < len(failed) < 40
    assert all("must lie between 5 and 90 deg" in reason for reason in failed)
    missing = [x is None for x in rows[RANGE].to_pylist()]
    assert missing == [reason is not None for reason in rows["failure"].to_pylist()]


def test_a_scheme_that_is_not_for_a_level_is_a_reason(tmp_path: Path) -> None:
    vary = {"scheme": "leapfrog, fourth-order"}
    found = plan("newton/incline-with-friction", vary, "block.speed@end", duration=0.1)
    reasons = table(found, tmp_path)["failure"].to_pylist()
    assert reasons[0] is None
    assert reasons[1]


def started(folder: Path, jobs: int) -> "subprocess.Popen[bytes]":
    command = ["experiment", DRAG, "--vary", "angle=20:80:150", "--duration", "0.3",
               "--measure", END, "--output", folder, "--jobs", jobs]  # fmt: skip
    return subprocess.Popen(
        [sys.executable, "-m", "sandbox", *map(str, command)],
        cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
    )  # fmt: skip


def parts(folder: Path) -> int:
    return len(list((folder / PARTS).glob("*.parquet")))


def killed_on_the_way(folder: Path, seed: int, wait: float) -> bool:
    """Kill a command some time after its first part is there [s]; return whether it was at work."""
    with started(folder, seed) as process:
        assert until(lambda: parts(folder) > 0 or process.poll() is not None)
        time.sleep(wait)
        process.kill()
    return parts(folder) > 0 and not (folder / RESULTS).exists()


@pytest.mark.sweep
@pytest.mark.parametrize("seed", [1, 2])
def test_what_was_killed_at_any_moment_goes_on_to_the_same_table(tmp_path: Path, seed: int) -> None:
    moments = Random(seed)
    found = plan(DRAG, {"angle": "20:80:150"}, END, duration=0.3)
    table(found, tmp_path / "whole")
    wait, killed = moments.random() * 0.5, tmp_path / "0"
    while not killed_on_the_way(killed, seed, wait):  # it was done by then
        wait, killed = wait / 2, tmp_path / f"{wait}"
    (killed / PARTS / "0-half.parquet").write_bytes(b"half")  # what no write leaves, and no name
    assert not (killed / RESULTS).exists()
    kept = sum(stop - start for start, stop in Store(killed, found).missing())
    assert kept < found.runs
    table(found, killed)
    assert (killed / RESULTS).read_bytes() == (tmp_path / "whole" / RESULTS).read_bytes()
    assert not (killed / PARTS).exists()


@pytest.mark.sweep
def test_a_dead_worker_ends_it_in_a_sentence_and_what_was_done_is_kept(tmp_path: Path) -> None:
    with started(tmp_path, 2) as process:
        assert until(lambda: parts(tmp_path) > 0)
        workers = [worker for server in children(process.pid) for worker in children(server)]
        os.kill(workers[0], signal.SIGKILL)
        assert process.stderr
        said = process.stderr.read().decode()
        assert process.wait(PATIENCE / 10) == 1
    assert "was ended from outside" in said
    assert "runs are kept, and the same command goes on from there" in said
    assert "Traceback" not in said
    assert until(lambda: not any(map(alive, workers)))
    assert parts(tmp_path) > 0


def children(pid: int) -> list[int]:
    return [int(c) for c in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def test_a_full_disk_is_a_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = throws(2)
    store = Store(tmp_path, found)

    def full(*_: object) -> None:
        raise SandboxError(
            Message("cannot write {tmp_path}: No space left on device", tmp_path=tmp_path)
        )

    monkeypatch.setattr("sandbox.experiments.experiment_folder.write_atomically", full)
    with pytest.raises(SandboxError, match="No space left on device"):
        conduct(found, store, SerialExecutor(), lambda _: None)
    monkeypatch.undo()
    conduct(found, store, SerialExecutor(), lambda _: None)
    assert store.complete


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes as on Unix")
def test_a_pipe_in_the_place_of_a_description_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "experiment.json")

    with pytest.raises(SandboxError, match=r"its experiment\.json cannot be read"):
        Store(tmp_path, throws(2))


@pytest.mark.parametrize("damage", ["cut off", "of another experiment"])
def test_a_damaged_part_is_named_and_made_again_once_it_is_removed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, damage: str
) -> None:
    found = throws(2)
    store = Store(tmp_path, found)
    with monkeypatch.context() as patch:
        patch.setattr(store, "finish", lambda: None)
        conduct(found, store, SerialExecutor(), lambda _: None)
    part = next((tmp_path / PARTS).iterdir())
    other = plan(THROW, {"angle": "6:85:3"}, RANGE, duration=6)
    table(other, tmp_path / "other")
    foreign = (tmp_path / "other" / RESULTS).read_bytes()
    part.write_bytes(part.read_bytes()[:50] if damage == "cut off" else foreign)

    with pytest.raises(SandboxError, match=rf"cannot read .*{part.name}: .*; remove it"):
        conduct(found, store, SerialExecutor(), lambda _: None)
    assert not list(tmp_path.glob(".*.part"))
    part.unlink()
    conduct(found, store, SerialExecutor(), lambda _: None)
    assert store.complete


def test_a_folder_holds_one_experiment(tmp_path: Path) -> None:
    table(throws(2), tmp_path)
    with pytest.raises(SandboxError, match="holds another experiment"):
        Store(tmp_path, throws(3))
    assert Store(tmp_path, throws(2)).complete
