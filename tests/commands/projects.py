"""The projects of the table: one line each."""

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from tests.cli.command_runner import vicode
from tests.commands import odd_names
from tests.commands.random_projects import write_random_project
from tests.manual.code_blocks import ROOT, code_blocks

PYTHON, CPP, XABSL = "python", "cpp", "xabsl"


@dataclass(frozen=True, slots=True, kw_only=True)
class TableProject:
    """A project.

    Attributes:
        write: Writes it to a folder that does not exist.
        design: The file of the root component.
        languages: Those that it is generated in.
        folder: The name of its folder.
        needs: What a run needs besides the project, "" for nothing; such a project is not run.
        has_bridge: Whether its robots may connect to a bridge.
        has_program: Whether it has a main.cpp.
        has_matches: Whether its world has matches of two teams.
        is_large: Whether only the nightly run takes it; the program of the page drives a circle in real time.
    """

    name: str
    kind: str
    write: Callable[[Path], None]
    design: str
    languages: tuple[str, ...] = (PYTHON, CPP)
    folder: str = "project"
    needs: str = ""
    has_bridge: bool = False
    has_program: bool = False
    has_matches: bool = False
    is_large: bool = False

    def __str__(self) -> str:
        return self.name.replace(" ", "_")


def _sample(name: str, folder: Path) -> None:
    shutil.copytree(ROOT / "designs" / name, folder, ignore=shutil.ignore_patterns("__pycache__"))


def _page(page: str, folder: Path) -> None:
    """The files of a page; later blocks replace earlier ones."""
    for block in code_blocks(ROOT / "docs" / page, "yaml", "python"):
        if block.name:
            _write(folder / block.name, block.text)


def _cpp_page(folder: Path) -> None:
    """The rescue project with the program of the page on C++."""
    _sample("rescue", folder)
    (block, *_rest) = code_blocks(ROOT / "docs/cpp.md", "cpp")
    _write(folder / "main.cpp", block.text)


def _xabsl_page(folder: Path) -> None:
    """The behavior of the page, imported."""
    behavior = folder.with_name("behavior")
    for block in code_blocks(ROOT / "docs/coming-from-xabsl.md", "xabsl"):
        _write(behavior / block.name, block.text)
    _import(behavior / "agents.xabsl", folder)


def _import(agents: Path, folder: Path) -> None:
    assert vicode("import", str(agents), "--out", str(folder)) == 0


def _recorded(program: str) -> Callable[[Path], None]:
    return partial(_import, ROOT / "tests/xabsl/cases/programs" / program / "agents.xabsl")


def _write(file: Path, text: str) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")


def _random(number: int) -> Callable[[Path], None]:
    return partial(write_random_project, number=number)


# Names of classes, namespaces and members of both runtimes, of the standard libraries, and of modules.
RUNTIME_CLASSES = ("Clock", "Index", "Remove", "Root", "State", "Component", "Calls", "Team", "Observer", "World")
RUNTIME_MEMBERS = ("name", "start", "next", "value", "speed", "period", "machine", "observer", "result", "data")
MODULES = ("vicode", "json", "std", "types", "asyncio", "string", "vector", "math")
KEYWORDS = ("match", "type", "list", "print", "id", "main", "final", "override", "module")
ALL = (PYTHON, CPP, XABSL)

PROJECTS = (
    TableProject(name="blink", kind="sample", write=partial(_sample, "blink"), design="blink.yaml"),
    TableProject(name="forward", kind="sample", write=partial(_sample, "forward"), design="player.yaml"),
    TableProject(
        name="meeting",
        kind="sample",
        write=partial(_sample, "meeting"),
        design="meet.yaml",
        languages=(PYTHON, XABSL),
        needs="a bridge",
        has_bridge=True,
    ),
    TableProject(
        name="rescue",
        kind="sample",
        write=partial(_sample, "rescue"),
        design="walk_corridor.yaml",
        languages=ALL,
        has_bridge=True,
    ),
    TableProject(
        name="soccer2d",
        kind="sample",
        write=partial(_sample, "soccer2d"),
        design="field_player.yaml",
        languages=(PYTHON, CPP),
        needs="a server of the soccer simulator",
    ),
    TableProject(name="team", kind="sample", write=partial(_sample, "team"), design="player.yaml", has_matches=True),
    TableProject(name="tutorial", kind="page", write=partial(_page, "tutorial.md"), design="patrol.yaml"),
    TableProject(name="own components", kind="page", write=partial(_page, "own-components.md"), design="car.yaml"),
    TableProject(
        name="C++ page",
        kind="page",
        write=_cpp_page,
        design="drive_circle.yaml",
        languages=ALL,
        has_bridge=True,
        has_program=True,
        is_large=True,
    ),
    TableProject(name="XABSL page", kind="imported", write=_xabsl_page, design="Options/defend.yaml", languages=ALL),
    TableProject(
        name="recorded p4",
        kind="imported",
        write=_recorded("p4"),
        design="Options/opt0.yaml",
        languages=ALL,
        is_large=True,
    ),
    TableProject(
        name="recorded p7",
        kind="imported",
        write=_recorded("p7"),
        design="Options/opt0.yaml",
        languages=ALL,
        is_large=True,
    ),
    *(
        TableProject(name=f"random {number}", kind="random", write=_random(number), design="player.yaml")
        for number in range(6)
    ),
    *(
        TableProject(
            name=f"named {name}",
            kind="odd names",
            folder=folder,
            design=file,
            languages=ALL,
            write=partial(odd_names.write_named, name=name, file=file),
        )
        for name, folder, file in (
            ("My robot", "my robot", "my lamp.yaml"),
            ("Robot v2.1", "robot.v2", "lamp.v2.yaml"),
            ("robot-1", "robot-1", "-lamp.yaml"),
            ("Fußgänger 足球", "Fußgänger", "Lämpchen.yml"),
            ("9 lives", "9", "9.yaml"),
            ("Root", "generated", "project2.yaml"),
            ("std", "std", "std.yaml"),
            ("Clock", "vicode", "Clock.yaml"),
            ("driver", "json", "__init__.yaml"),
            ("Index", "index", "lamp.yaml"),
            ("main", "main", "main.yaml"),
        )
    ),
    *(
        TableProject(
            name=f"{name} with main.cpp",
            kind="odd names",
            design="lamp.yaml",
            languages=ALL,
            has_program=True,
            write=partial(odd_names.write_program, name=name),
        )
        for name in ("robot", "install", "clock")
    ),
    TableProject(
        name="without project.yaml",
        kind="odd names",
        folder="my 2nd robot.v2",
        design="a lamp.v2.yaml",
        write=partial(odd_names.write_unnamed, file="a lamp.v2.yaml"),
    ),
    *(
        TableProject(name=name, kind="odd words", design=file, languages=ALL, write=partial(write, words=words))
        for name, file, write, words in (
            ("components named as classes", "Clock.yaml", odd_names.write_named_components, RUNTIME_CLASSES),
            ("components named as modules", "vicode.yaml", odd_names.write_named_components, MODULES),
            ("components named as words", "match.yaml", odd_names.write_named_components, KEYWORDS),
            ("members named as members", "lamp.yaml", odd_names.write_named_members, RUNTIME_MEMBERS),
            ("members named as modules", "lamp.yaml", odd_names.write_named_members, MODULES),
            ("members named as words", "lamp.yaml", odd_names.write_named_members, KEYWORDS),
            ("declarations named as classes", "lamp.yaml", odd_names.write_named_declarations, RUNTIME_CLASSES),
            ("declarations named as modules", "lamp.yaml", odd_names.write_named_declarations, MODULES),
            ("declarations named as words", "lamp.yaml", odd_names.write_named_declarations, KEYWORDS),
        )
    ),
)
