"""The C++ program of a deployment: generated and hand-written sources, and what builds them with CMake."""

import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from vicode.generators import generate
from vicode.generators.cpp.compiler import find_compiler
from vicode.store import OpenProject

BUILD_SCRIPT = "build.sh"
_MAIN, _CMAKE = "main.cpp", "CMakeLists.txt"
_PROGRAM = re.compile(r"^\s*add_executable\s*\(\s*([\w.+-]+)", re.MULTILINE)
_LIVE = re.compile(r"^\s*#\s*include\s+.*live\.hpp", re.MULTILINE)
LIVE_HINT = "programs in C++ can be watched with 'live: true' in project.yaml (docs/cpp.md)"
_SCRIPT = """\
#!/bin/sh
cd "$(dirname "$0")" || exit 1
cmake -S . -B build -DCMAKE_BUILD_TYPE=Release && cmake --build build
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class DeployedCppProgram:
    """A generated package, and the program that CMake builds with it."""

    package: str
    executable: str

    @property
    def launch(self) -> str:
        """The commands that build the program, if it is not built yet, and replace the shell by it."""
        program = f"build/{self.executable}"
        return f"test -x {program} || ./{BUILD_SCRIPT} || exit 1\nexec {program}"


def write_cpp_program(opened: OpenProject, component: str, folder: Path) -> DeployedCppProgram:
    """Add generated code and build files to a folder with the hand-written files of the project.

    Raises:
        OSError: The project has no C++ program.
        UnsoundDesignError: A design cannot be generated.
    """
    project = opened.project
    if not (folder / _MAIN).is_file() and not (folder / _CMAKE).is_file():
        raise OSError(f"the project has no {_MAIN} and no {_CMAKE}; docs/cpp.md has a program to start with")
    # The program was written for the code of all designs.
    files = generate(project, languages=["cpp"], sources=opened.design_paths)
    generated = PurePosixPath(project.generated)
    place = folder / (generated if not generated.is_absolute() and ".." not in generated.parts else "generated")
    for file in files:
        target = place / file.path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(file.text, encoding="utf-8")
    if not project.live and any(_LIVE.search(path.read_text("utf-8", "replace")) for path in folder.glob("*.cpp")):
        raise OSError(f"the program includes live.hpp, which does not exist; {LIVE_HINT}")
    (package,) = {PurePosixPath(file.path).parts[1] for file in files if file.component == component}
    library = next(file.text for file in files if file.path == f"cpp/{package}/{_CMAKE}")
    if not (folder / _CMAKE).is_file():
        sources = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.cpp"))
        by_hand = [source for source in sources if not (folder / source).is_relative_to(place)]
        _write_cmake(folder, (place / "cpp" / package).relative_to(folder).as_posix(), _library(library), by_hand)
    script = folder / BUILD_SCRIPT
    if not script.exists():
        # A project may build for another machine.
        script.write_text(_SCRIPT, encoding="utf-8")
    script.chmod(0o755)
    return DeployedCppProgram(package=package, executable=_executable(folder / _CMAKE))


def build_here(folder: Path) -> bool:
    """Build a deployed program if this machine has CMake and a compiler; return whether it did.

    Raises:
        OSError: The program does not compile.
    """
    if shutil.which("cmake") is None or find_compiler() is None:
        return False
    if subprocess.run([folder.resolve() / BUILD_SCRIPT], check=False).returncode:
        raise OSError(f"{folder / BUILD_SCRIPT} failed")
    return True


def _library(text: str) -> str:
    found = re.search(r"add_library\((\w+)", text)
    assert found is not None
    return found[1]


def _write_cmake(folder: Path, package: str, library: str, sources: list[str]) -> None:
    program = "robot" if library != "robot" else "robot_program"
    listed = "".join(f'    "{source}"\n' for source in sources)
    (folder / _CMAKE).write_text(
        f"""\
cmake_minimum_required(VERSION 3.16)
project(robot LANGUAGES CXX)

add_subdirectory({package})
add_executable({program}
{listed})
target_include_directories({program} PRIVATE ${{CMAKE_CURRENT_SOURCE_DIR}})
target_link_libraries({program} PRIVATE {library})
""",
        encoding="utf-8",
    )


def _executable(file: Path) -> str:
    """The first program of a CMake file.

    Raises:
        OSError: It has none.
    """
    found = _PROGRAM.search(file.read_text(encoding="utf-8", errors="replace"))
    if found is None:
        raise OSError(f"{file.name} of the project has no add_executable that names a program")
    return found[1]
