"""Builds errmap._core with CMake: pip install --no-build-isolation ./cli/python."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]
# A build of the program that is there already is used, and kept.
BUILD = Path(os.environ.get(
    "ERRMAP_BUILD", ROOT / f"build-{sys.implementation.cache_tag}"))


def version() -> str:
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(errmap VERSION (\S+)", text).group(1)


class Build(build_ext):
    def build_extension(self, extension: Extension) -> None:
        subprocess.run(
            ["cmake", "-S", ROOT, "-B", BUILD, "-DCMAKE_BUILD_TYPE=Release",
             "-DERRMAP_BUILD_TESTS=OFF", "-DERRMAP_PYTHON=ON",
             f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(
            ["cmake", "--build", BUILD, "--target", "errmap_python",
             "--parallel", str(os.cpu_count() or 1)], check=True)
        built = next((BUILD / "python" / "errmap").glob("_core*.so"))
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(built, target)


setup(version=version(), ext_modules=[Extension("errmap._core", [])],
      cmdclass={"build_ext": Build})
