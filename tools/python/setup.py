"""What pip does: builds the module with CMake in build/python, as tools/build does, and takes the package from there."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = Path(__file__).resolve().parent
SOURCES = HERE.parents[1]
BUILD = SOURCES / "build/python"


def version():
    found = re.search(r"project\(articular VERSION ([0-9.]+)", (SOURCES / "CMakeLists.txt").read_text())
    return found.group(1)


def call(what, *command):
    """Ends with the end of what the command said, where it fails."""
    environment = dict(os.environ, CCACHE_BASEDIR=str(SOURCES), CCACHE_NOHASHDIR="1")
    done = subprocess.run(
        command, cwd=SOURCES, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    if done.returncode != 0:
        print(done.stdout[-4000:], file=sys.stderr)
        sys.exit(
            f"articular: {what} failed; its messages stand above. What it needs, on Debian 12:\n"
            "    tools/install-packages --program pybind11-dev python3-dev python3-numpy"
        )


class BuildWithCMake(build_ext):
    def build_extension(self, extension):
        if shutil.which("cmake") is None:
            sys.exit("articular: cmake is not installed; tools/install-packages --program installs it")
        call("configuring", "cmake", "--preset", "release", "-B", str(BUILD), "-DBUILD_TESTING=OFF",
             f"-DPython_EXECUTABLE={sys.executable}")
        jobs = str(max(1, min(os.cpu_count() or 1, memory_gigabytes() // 2)))
        call("the build", "cmake", "--build", str(BUILD), "--target", "articular_python", "--parallel", jobs)
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        (module,) = (BUILD / "python/articular").glob("_core*" + target.suffix)
        shutil.copy2(module, target)


def memory_gigabytes():
    """Free now; a compiler needs up to 2."""
    found = re.search(r"MemAvailable: *(\d+)", Path("/proc/meminfo").read_text())
    return int(found.group(1)) // 1_000_000


def scenarios():
    """For share/articular/scenarios, where the module looks for what is shipped."""
    folders = {}
    for ending in ["toml", "csv", "vtp", "vtu"]:
        for file in (SOURCES / "scenarios").rglob(f"*.{ending}"):
            place = "share/articular" / file.relative_to(SOURCES).parent
            folders.setdefault(str(place), []).append(os.path.relpath(file, HERE))
    return sorted(folders.items())


BUILD.mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    options={"egg_info": {"egg_base": str(BUILD)}, "build": {"build_base": str(BUILD / "wheel")}},  # not beside us
    packages=["articular"],
    package_data={"articular": ["py.typed", "_core/*.pyi"]},
    data_files=scenarios(),
    ext_modules=[Extension("articular._core", [])],
    cmdclass={"build_ext": BuildWithCMake},
)
