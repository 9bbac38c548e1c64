"""The CMake library of a project in another one: installed, as a subdirectory, and inside of a shared library."""

import json
import shutil
from pathlib import Path

import pytest

from tests.cpp_tools import find_gpp, outputs, start, write_project

LAMP = """
vicode: 1
component: Lamp
initial: Dark
states: {Dark: {transitions: [{to: Lit, after: 0.1}]}, Lit: {}}
"""
CONSUMER = """
cmake_minimum_required(VERSION 3.16)
project(consumer LANGUAGES CXX)

{library}
add_library(robot SHARED robot.cpp)
target_link_libraries(robot PRIVATE lamp::lamp)
target_link_options(robot PRIVATE -Wl,--no-undefined)
add_executable(program main.cpp)
target_link_libraries(program PRIVATE robot)
"""
ROBOT = """
#include "lamp/components.hpp"

const char* last_state() {
    bica::Root root;
    lamp::Components components(root);
    for (int tick = 0; tick < 10; ++tick) {
        root.step(components.lamp, tick * bica::Nanoseconds{20'000'000});
    }
    return components.lamp.state_name();
}
"""
MAIN = """
#include <cstdio>

const char* last_state();

int main() {
    std::puts(last_state());
    return 0;
}
"""

pytestmark = pytest.mark.skipif(shutil.which("cmake") is None, reason="cmake is missing: sudo apt install cmake")


@pytest.fixture(scope="module")
def lamp(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the generated library."""
    find_gpp()
    folder = tmp_path_factory.mktemp("lamp")
    (folder / "project.yaml").write_text("vicode: 1\nproject: Lamp\nlanguages: [cpp]\nlive: true\n", encoding="utf-8")
    (folder / "lamp.yaml").write_text(LAMP, encoding="utf-8")
    return folder / "cpp" / write_project(folder, folder)


def build(source: Path, folder: Path, *options: str) -> None:
    outputs([start(["cmake", "-S", str(source), "-B", str(folder), *options], source)])
    outputs([start(["cmake", "--build", str(folder)], source)])


def run_consumer(folder: Path, library: str, *options: str) -> str:
    """Build a project with a shared library that contains the generated one; return what its program prints."""
    for name, text in {"CMakeLists.txt": CONSUMER, "robot.cpp": ROBOT, "main.cpp": MAIN}.items():
        (folder / name).write_text(text.replace("{library}", library), encoding="utf-8")
    build(folder, folder / "build", *options)
    (printed,) = outputs([start([str(folder / "build" / "program")], folder)])
    return printed


def test_a_subdirectory_is_linked_into_a_shared_library(lamp: Path, tmp_path: Path) -> None:
    assert run_consumer(tmp_path, f'add_subdirectory("{lamp}" lamp)') == "Lit\n"
    assert (tmp_path / "build" / "lamp" / "liblamp.a").exists()


@pytest.mark.parametrize("shared", ["OFF", "ON"])
def test_an_installed_library_is_found(lamp: Path, tmp_path: Path, shared: str) -> None:
    prefix = tmp_path / "installed"
    build(lamp, tmp_path / "lamp", f"-DBUILD_SHARED_LIBS={shared}")
    outputs([start(["cmake", "--install", str(tmp_path / "lamp"), "--prefix", str(prefix)], tmp_path)])
    assert (prefix / "lib" / ("liblamp.so" if shared == "ON" else "liblamp.a")).exists()
    (tmp_path / "consumer").mkdir()
    consumer = "find_package(lamp REQUIRED)"
    assert run_consumer(tmp_path / "consumer", consumer, f"-DCMAKE_PREFIX_PATH={prefix}") == "Lit\n"


def test_texts_in_traces_are_valid_json(lamp: Path, tmp_path: Path) -> None:
    source = tmp_path / "texts.cpp"
    source.write_text(
        r"""
#include "bica.hpp"
int main() { std::puts(bica::json_text("a\xff\"\xc3\xa4\n\xe2\x82").c_str()); }
"""
    )
    program = tmp_path / "texts"
    outputs([start([find_gpp(), "-std=c++17", f"-I{lamp.parent}", str(source), "-o", str(program)], tmp_path)])
    (printed,) = outputs([start([str(program)], tmp_path)])
    assert json.loads(printed) == 'a\ufffd"ä\n\ufffd\ufffd'
