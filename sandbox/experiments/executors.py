"""Where an experiment runs: on the cores of this machine or on a cluster, with identical results.

Dask is imported only if a cluster is asked for.
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import islice
from typing import TYPE_CHECKING, Protocol, TypeVar

from sandbox.model.errors import SandboxError, brief
from sandbox.optional_packages import needed_for
from sandbox.parallel_processes import AHEAD, spread
from sandbox.version import __version__

if TYPE_CHECKING:
    from distributed import Client

Item = TypeVar("Item")
Result = TypeVar("Result")

PATIENCE = 10
"""The longest time to wait for a scheduler's answer [s]."""


class Executor(Protocol):
    """Runs work items somewhere."""

    @property
    def jobs(self) -> int:
        """The number of items that are worked on at a time."""

    def results(self, work: Callable[[Item], Result], items: Iterable[Item]) -> Iterator[Result]:
        """Yield the result of each item, in the order in which they are finished.

        Raises `SandboxError` if it cannot continue.
        """


class SerialExecutor:
    """The current process, which runs one item after the other."""

    jobs = 1

    def results(self, work: Callable[[Item], Result], items: Iterable[Item]) -> Iterator[Result]:
        """Yield the result of each item, one after the other."""
        return map(work, items)


class ProcessExecutor:
    """Processes on this machine; none outlives this one."""

    def __init__(self, jobs: int) -> None:
        self.jobs = jobs

    def results(self, work: Callable[[Item], Result], items: Iterable[Item]) -> Iterator[Result]:
        """Yield the result of each item, in the order in which they are finished."""
        for _, result in spread(work, items, self.jobs):
            yield result


class Cluster:
    """The workers of a Dask cluster; made by `cluster`."""

    def __init__(self, client: "Client", address: str) -> None:
        self._client, self._address = client, address
        self.jobs = sum(client.nthreads().values())
        if not self.jobs:
            raise SandboxError(
                "the cluster at {address} has no workers: start some with 'dask worker {address}'",
                address=address,
            )
        self._refuse_others()

    def results(self, work: Callable[[Item], Result], items: Iterable[Item]) -> Iterator[Result]:
        """Yield the result of each item as it is finished; lost workers are replaced."""
        from distributed import as_completed

        coming = iter(items)
        first = [self._submit(work, item) for item in islice(coming, AHEAD * self.jobs)]
        waiting = as_completed(first, loop=self._client.loop)
        try:
            for future in waiting:
                yield future.result()
                future.release()
                for item in islice(coming, 1):
                    waiting.add(self._submit(work, item))
        except SandboxError:
            raise
        except Exception as error:
            what = brief(" ".join(f"{error}".split()) or type(error).__name__, 200)
            raise SandboxError(
                "the cluster at {address} has failed: {what}", address=self._address, what=what
            ) from error

    def _submit(self, work: Callable[[Item], Result], item: Item) -> object:
        return self._client.submit(work, item, pure=False)

    def _refuse_others(self) -> None:
        """Refuse workers of another version, whose results might differ."""
        try:
            found = self._client.run(_versions)
        except Exception as error:
            raise SandboxError(
                "a worker of the cluster at {address} lacks the sandbox, or something that it"
                " needs ({error}); install the same version there: python -m pip install"
                " 'mechanics-sandbox[cluster]'",
                address=self._address,
                error=brief(str(error)),
            ) from error
        for worker, versions in found.items():
            for name, theirs in versions.items():
                if theirs != (ours := _versions()[name]):
                    raise SandboxError(
                        "the worker {worker} has {name} {there}, but this machine {here}: with"
                        " different versions rows would not be the same to the last bit",
                        worker=worker,
                        name=name,
                        there=theirs,
                        here=ours,
                    )


def _versions() -> dict[str, str]:
    import platform
    from importlib.metadata import version

    packages = {name: version(name) for name in ("numpy", "pymunk", "scipy")}
    return {"sandbox": __version__, "python": platform.python_version(), **packages}


@contextmanager
def cluster(address: str, workers: int = 1) -> Iterator[Cluster]:
    """Use a Dask cluster whose scheduler is at an address, such as `tcp://127.0.0.1:8786`.

    It waits for some workers, for at most as long as a scheduler may take to answer. Raises
    `SandboxError` if no scheduler answers at the address.
    """
    with needed_for("--cluster", "cluster"):
        from distributed import Client
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise SandboxError(
            "no scheduler answers at {address}: start one with 'dask scheduler', and workers"
            " with 'dask worker ADDRESS'",
            address=brief(address),
        ) from error
    try:
        with suppress(TimeoutError):  # go on with the workers that came
            client.wait_for_workers(workers, timeout=3 * PATIENCE)
        yield Cluster(client, address)
    finally:
        client.close(timeout=PATIENCE)


def local(jobs: int) -> Executor:
    """Return an executor with a number of processes on this machine."""
    return ProcessExecutor(jobs) if jobs > 1 else SerialExecutor()
