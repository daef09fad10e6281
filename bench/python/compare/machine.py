"""What the figures were measured on and with."""

import platform
from importlib import metadata
from pathlib import Path


def processor():
    info = Path("/proc/cpuinfo")
    if info.is_file():
        for line in info.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def versions(facts):
    names = ["numpy", "scipy", "jax", "casadi"]
    found = [f"Python {platform.python_version()}"]
    for name in names:
        try:
            found.append(f"{name} {metadata.version(name)}")
        except metadata.PackageNotFoundError:
            continue
    if facts is not None:
        found += [f"Eigen {facts['eigen']}", f"GCC {facts['compiler']}"]
    return ", ".join(found)
