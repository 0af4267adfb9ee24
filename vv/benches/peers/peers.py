"""The libraries' programs: which there are, how they are built, how they are called."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()
PACKAGES = ["g++", "libcgal-dev", "libosd-dev", "libopenmesh-dev"]
FLAGS = ["-std=c++17", "-O3", "-march=native", "-DNDEBUG"]
# Name, source, flags. CGAL's exact numbers are not used, and so GMP need not be there.
PROGRAMS = {
    "peak": ("peak.cpp", []),
    "cgal": ("cgal.cpp", ["-DCGAL_DISABLE_GMP=1"]),
    "cgal-polyhedron": ("cgal.cpp", ["-DCGAL_DISABLE_GMP=1", "-DPOLYHEDRON"]),
    "opensubdiv": ("opensubdiv.cpp", ["-losdCPU"]),
    "openmesh": ("openmesh.cpp", ["-D_USE_MATH_DEFINES", "-lOpenMeshTools", "-lOpenMeshCore"]),
}


def say(*words):
    print(*words, file=sys.stderr, flush=True)


def installed(package):
    query = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True)
    return query.stdout if query.returncode == 0 else ""


def install():
    missing = [package for package in PACKAGES if not installed(package)]
    if not missing:
        return
    say("installing", *missing)
    as_root = [] if os.geteuid() == 0 else ["sudo"]
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    subprocess.run([*as_root, "apt-get", "update", "-qq"], check=True)
    quietly = [*as_root, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "install", "-y", "-qq", "--no-install-recommends"]
    subprocess.run([*quietly, *missing], check=True, env=environment, stdout=sys.stderr)


def build():
    """Installs what is missing, compiles what has changed and returns where each program is."""
    if not shutil.which("dpkg-query"):
        sys.exit("error: the libraries are taken from Debian's packages: " + " ".join(PACKAGES))
    install()
    folder = TARGET / "peers"
    folder.mkdir(parents=True, exist_ok=True)
    paths = {}
    for name, (source, flags) in PROGRAMS.items():
        path = paths[name] = folder / name
        sources = [HERE / source, HERE / "mesh.hpp", Path(__file__)]
        if path.exists() and all(s.stat().st_mtime < path.stat().st_mtime for s in sources):
            continue
        say("compiling", name)
        subprocess.run(["g++", *FLAGS, str(HERE / source), "-o", str(path), *flags], check=True)
    return paths


def versions():
    return {package: installed(package) for package in PACKAGES}


def call(*command):
    """Runs a program and returns what it reports, with the most memory that its process held as `peak_bytes`."""
    command = [str(word) for word in [TARGET / "peers" / "peak", *command]]
    process = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if process.returncode != 0:
        sys.exit(f"error: exit code {process.returncode}: {' '.join(command)}")
    result, end = json.JSONDecoder().raw_decode(process.stdout)
    return {**result, **json.loads(process.stdout[end:])}
