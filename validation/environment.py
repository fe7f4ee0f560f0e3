"""The environment of a measurement: versions, machine, and cores."""

import os
import platform
from importlib.metadata import version

from sandbox.version import __version__


def environment() -> dict[str, str]:
    """Return the versions and the machine, by which a reader can judge the figures."""
    return {
        "sandbox": __version__,
        "python": platform.python_version(),
        **{package: version(package) for package in ("pymunk", "numpy", "pydantic")},
        "platform": platform.platform(),
        "processor": _processor(),
        "cores": str(os.cpu_count()),
    }


def _processor() -> str:
    """Return the processor's name; on systems other than Linux only its family."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            for line in lines:
                if line.startswith("model name"):
                    return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()
