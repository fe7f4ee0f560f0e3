"""A Dask cluster on this machine."""

import os
import socket
import subprocess
import sys
import time

from tests.elsewhere import PATIENCE, ROOT

UNWATCHED = {"DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False"}
"""What the documents set for workers: else each looks a hundred times a second what it is doing."""


class Machines:
    """A scheduler with two workers, started as the documents say.

    Attributes
    ----------
    address
        Of the scheduler.
    scheduler, workers
        The process of the scheduler, and that which watches over the workers.
    """

    def __init__(self) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{port}"
        scheduler = ["scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard"]
        worker = ["worker", self.address, "--nworkers", "2", "--nthreads", "1", "--no-dashboard",
                  "--memory-limit", "0"]  # fmt: skip
        self.scheduler, self.workers = (
            subprocess.Popen(
                [sys.executable, "-m", "distributed.cli.dask_" + command[0], *command[1:]],
                cwd=ROOT, env={**os.environ, **UNWATCHED},
                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            )
            for command in (scheduler, worker)
        )  # fmt: skip
        self._wait(port)

    def _wait(self, port: int) -> None:
        """Wait until the scheduler listens."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self.scheduler.poll() is None:
            with socket.socket() as caller:
                if not caller.connect_ex(("127.0.0.1", port)):
                    return
            time.sleep(0.1)
        self.end()
        raise TimeoutError("the scheduler does not listen")

    def end(self) -> None:
        """End both, whether they still run or not."""
        for process in (self.workers, self.scheduler):
            process.terminate()
            process.wait(30)
