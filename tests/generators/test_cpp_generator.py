"""Generated C++ compiles without warnings, is formatted, and does not allocate memory."""

import platform
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.cpp_tools import STANDARD, WARNINGS, find_gpp, outputs, start, write_project, write_unit
from tests.generators.code_tools import write_files
from vicode.cli import main
from vicode.generators import generate
from vicode.generators.cpp.names import escape, namespace
from vicode.generators.plan import PackagePlan
from vicode.model.design import Assign, Declaration, Design, Guard, State, Transition
from vicode.model.names import package_name
from vicode.model.project import Project
from vicode.templating import read_asset

C_HEADERS = """
cctype cerrno cfenv cinttypes clocale csetjmp csignal cstdlib ctime cwchar cwctype arpa/inet.h dirent.h dlfcn.h fcntl.h
netdb.h poll.h pthread.h sched.h semaphore.h strings.h sys/ioctl.h sys/mman.h sys/select.h sys/socket.h sys/stat.h
sys/wait.h syslog.h termios.h unistd.h
"""
DESIGNS = Path(__file__).parents[2] / "designs"
CASES = Path(__file__).parent / "cpp_designs"
FOLDERS = {
    "rescue": DESIGNS / "rescue",
    "blink": DESIGNS / "blink",
    "forward": DESIGNS / "forward",
    "hostile": CASES / "hostile",
    "code": CASES / "code",
}


@pytest.fixture(scope="module")
def gpp() -> str:
    return find_gpp()


@pytest.fixture(scope="module")
def generated(tmp_path_factory: pytest.TempPathFactory) -> dict[Path, str]:
    """The folders with the code of all projects, and their packages."""
    written = {}
    for name, folder in FOLDERS.items():
        out = tmp_path_factory.mktemp(name)
        written[out / "cpp"] = write_project(folder, out)
    out = tmp_path_factory.mktemp("large")
    write_files(generate(large_project(500), languages=["cpp"]), out)
    write_unit(out / "cpp", "large")
    written[out / "cpp"] = "large"
    return written


def large_project(count: int) -> Project:
    """A ring of states."""
    states = tuple(
        State(
            name=f"S{index}",
            actions=(Assign(values=(("n", "n + 1"),)),),
            transitions=(Transition(to=f"S{(index + 1) % count}", guard=Guard(when=f"n > {index}")),),
        )
        for index in range(count)
    )
    values = (Declaration(name="n", initial="0"),)
    return Project(
        name="large", designs=(Design(component="Ring", outputs=values, initial=states[0].name, states=states),)
    )


@pytest.mark.parametrize(
    ("name", "taken", "escaped"),
    [
        ("M_PI", (), "M_PI_"),
        ("FP_NAN", (), "FP_NAN_"),
        ("M_PI", ("M_PI_",), "M_PI_2_"),
        ("INT8_MAX", (), "INT8_MAX_"),
        ("CLOCKS_PER_SEC", (), "CLOCKS_PER_SEC_"),
    ],
)
def test_names_of_macros_get_an_underscore(name: str, taken: tuple[str, ...], escaped: str) -> None:
    assert escape(name, taken) == escaped


def test_no_namespace_has_a_name_of_the_headers(gpp: str, tmp_path: Path) -> None:
    """Of all words in the headers of C and POSIX, none is refused as the name of a project."""
    includes = "".join(f"#include <{header}>\n" for header in C_HEADERS.split())
    includes = f'#include "bica.hpp"\n{includes}'
    (tmp_path / "headers.cpp").write_text(includes, encoding="utf-8")
    (tmp_path / "bica.hpp").write_text(read_asset("cpp/bica.hpp"), encoding="utf-8")
    (text,) = outputs([start([gpp, "-std=gnu++17", "-E", "-P", "headers.cpp"], tmp_path)])
    words = {package_name(word) for word in re.findall(r"\b[a-z]\w*", text)} | {"main", "std", "class"}
    assert len(words) > 3000
    packages = (
        PackagePlan(project=Project(name=word), name=word, modules={}, has_declarations=False) for word in sorted(words)
    )
    used = dict.fromkeys(namespace(each) for each in packages)
    lines = "".join(f"namespace {name} {{}}\n" for name in used)
    (tmp_path / "all.cpp").write_text(f"{includes}{lines}int main() {{}}\n", encoding="utf-8")
    assert outputs([start([gpp, "-std=gnu++17", "-fsyntax-only", "all.cpp"], tmp_path)]) == [""]


def test_no_compiler_warns(gpp: str, generated: dict[Path, str]) -> None:
    """With and without exceptions and run-time types, for a computer and for a controller."""
    compilers = [gpp, *filter(None, [shutil.which("clang++")])]
    variants = [(), ("-fno-exceptions", "-fno-rtti", "-DBICA_NO_HOST")]
    commands = [
        (folder, [compiler, *STANDARD, *WARNINGS, *flags, "-I.", "-fsyntax-only", f"{package}_unit.cpp"])
        for folder, package in generated.items()
        for compiler in compilers
        for flags in variants
    ]
    for first in range(0, len(commands), 4):
        assert outputs([start(command, folder) for folder, command in commands[first : first + 4]]) == [""] * len(
            commands[first : first + 4]
        )


PRODUCTS = """
vicode: 1
component: Product
outputs: {x: 0.1, square: 0.0, hypotenuse: 0.0, angle: 0.0}
initial: Equal
common:
  transitions: [{to: Other, when: x * square - angle > 100}]
states:
  Equal:
    enter: [{set: {angle: x * 2.5 - square}}]
    actions: [{set: {x: x + 0.1, square: (x + 0.1) * (x + 0.1), hypotenuse: "hypot(x, 0.3)", angle: degrees(x) + 0.1}}]
    transitions: [{to: Other, when: x * x - square != 0}]
  Other:
    actions: [{set: {x: "x * x + max(x * 0.1 - 2, square)"}}]
    leave: [{set: {x: x * square - 2}}]
    transitions: [{to: Equal, when: radians(x) * square + x > 0}]
"""
FUSED = re.compile(r"^\s+(?:vfn?m(?:add|sub)\d*\w\w|fn?m(?:add|sub)|fml[as])\s", re.MULTILINE)


TARGETS = [("aarch64-linux-gnu-g++", "")]
if platform.machine() == "x86_64":
    X86 = "-march=haswell"
    TARGETS += [("g++", X86), ("g++", f"{X86} -ffp-contract=fast"), ("clang++", X86)]


@pytest.mark.parametrize(("compiler", "flags"), TARGETS, ids=lambda value: str(value).replace(" ", ""))
def test_no_compiler_fuses_multiplications(compiler: str, flags: str, tmp_path: Path) -> None:
    """The only fused instruction is that of a function outside of generated code."""
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is missing: sudo apt install g++ clang g++-aarch64-linux-gnu")
    (tmp_path / "products.yaml").write_text(PRODUCTS, encoding="utf-8")
    package = write_project(tmp_path, tmp_path)
    plain = "double plain(double a, double b, double c) { return a * b + c; }"
    (tmp_path / "cpp" / "fused.cpp").write_text(f'{plain}\n#include "{package}_unit.cpp"\n', encoding="utf-8")
    for level in ("-O2", "-O3", "-Os"):
        command = [compiler, *STANDARD, level, *flags.split(), "-I.", "-S", "-o-", "fused.cpp"]
        (assembly,) = outputs([start(command, tmp_path / "cpp")])
        assert len(FUSED.findall(assembly)) == 1, level


def test_code_for_controllers_includes_no_threads_and_streams(gpp: str, generated: dict[Path, str]) -> None:
    folder, package = next(iter(generated.items()))
    command = [gpp, *STANDARD, "-DBICA_NO_HOST", "-I.", "-M", f"{package}_unit.cpp"]
    (listed,) = outputs([start(command, folder)])
    headers = {Path(name).name for name in listed.split()}
    assert not headers & {"thread", "chrono", "cstdio", "iostream", "string", "vector"}


@pytest.mark.skipif(
    shutil.which("clang-format") is None, reason="clang-format is missing: sudo apt install clang-format"
)
def test_clang_format_changes_nothing(generated: dict[Path, str]) -> None:
    for folder, package in generated.items():
        files = ["bica.hpp", *(f"{package}/{path.name}" for path in (folder / package).glob("*.?pp"))]
        command = ["clang-format", "--dry-run", "--Werror", *files]
        assert outputs([start(command, folder)]) == [""]


@pytest.mark.nightly
@pytest.mark.skipif(shutil.which("clang-tidy") is None, reason="clang-tidy is missing: sudo apt install clang-tidy")
def test_clang_tidy_finds_nothing(generated: dict[Path, str]) -> None:
    # The order of arguments is the one of the design.
    checks = "-*,bugprone-*,performance-*,-bugprone-easily-swappable-parameters,-bugprone-suspicious-include"
    for folder, package in generated.items():
        command = ["clang-tidy", "--quiet", f"-checks={checks}", "--header-filter=.*", "--warnings-as-errors=*"]
        command += [f"{package}_unit.cpp", "--", *STANDARD, "-I."]
        outputs([start(command, folder)])


def test_a_missing_method_of_the_world_is_an_error_that_names_it(gpp: str, generated: dict[Path, str]) -> None:
    folder = next(folder for folder, package in generated.items() if package == "rescue")
    source = """
#include "rescue/components.hpp"
class Robot : public rescue::World {
    double amount_turned() override { return 0.0; }
};
Robot robot;
"""
    path = folder / "incomplete.cpp"
    path.write_text(source, encoding="utf-8")
    command = [gpp, *STANDARD, "-I.", "-fsyntax-only", path.name]
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert result.returncode != 0
    assert "laser_max" in result.stderr


def test_the_programs_of_the_documentation_compile(gpp: str, generated: dict[Path, str]) -> None:
    page = (DESIGNS.parent / "docs" / "cpp.md").read_text(encoding="utf-8")
    program, head, *_recorded = (block.partition("```")[0] for block in page.split("```cpp\n")[1:])
    folders = {package: folder for folder, package in generated.items()}
    (folders["rescue"] / "main.cpp").write_text(program, encoding="utf-8")
    head = f'#include "forward/components.hpp"\n{head}\nbica::Root root;\nHead head(root);\n'
    (folders["forward"] / "main.cpp").write_text(head, encoding="utf-8")
    command = [gpp, *STANDARD, *WARNINGS, "-I.", "-fsyntax-only", "main.cpp"]
    assert outputs([start(command, folders[package]) for package in ("rescue", "forward")]) == ["", ""]


def test_robots_in_several_threads_share_nothing(gpp: str, generated: dict[Path, str], tmp_path: Path) -> None:
    """The thread sanitizer finds no data race; another thread stops the robots, and reads the statistics then."""
    folder = next(folder for folder, package in generated.items() if package == "rescue")
    source, program = Path(__file__).with_name("robots_in_threads.cpp"), tmp_path / "robots"
    command = [
        gpp,
        *STANDARD,
        *WARNINGS,
        "-fsanitize=thread",
        "-I.",
        str(source),
        "rescue_unit.cpp",
        "-o",
        str(program),
    ]
    outputs([start([*command, "-pthread"], folder)])
    (printed,) = outputs([start([str(program)], folder)])
    assert printed.splitlines().count("drive_circle 1") == 2, printed


def test_a_single_header_holds_everything(gpp: str, tmp_path: Path) -> None:
    assert main(["gen", str(DESIGNS / "forward"), "--single-header", str(tmp_path / "forward.hpp")]) == 0
    (tmp_path / "sketch.cpp").write_text('#include "forward.hpp"\nbica::Root root;\n', encoding="utf-8")
    command = [gpp, *STANDARD, *WARNINGS, "-DBICA_NO_HOST", "-fno-exceptions", "-fsyntax-only", "sketch.cpp"]
    assert outputs([start(command, tmp_path)]) == [""]
