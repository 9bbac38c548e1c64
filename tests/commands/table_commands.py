"""The commands of the table: one function each, which runs a command on a project and checks what it made.

What a command writes is read by the program that it is for, where there is one in the test environment.
"""

import csv
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit
from xml.etree import ElementTree

import pygraphviz
import pytest
from jsonschema import Draft202012Validator
from mcap.reader import make_reader
from PIL import Image
from pypdf import PdfReader

from tests.cli.command_runner import vicode
from tests.commands.projects import CPP, PYTHON, XABSL, TableProject
from tests.cpp_tools import STANDARD, WARNINGS, find_gpp, outputs, start, write_unit
from vicode.conformance.suite_runner import list_cases
from vicode.services.project_loader import load_projects
from vicode.traces.reader import trace_schema

LIMIT_S = 60.0
SECONDS = "3"
_VALIDATOR = Draft202012Validator(trace_schema())


@dataclass(frozen=True)
class Workplace:
    """A folder with a project, which is the current folder."""

    project: TableProject
    root: Path
    capfd: pytest.CaptureFixture[str]

    @property
    def folder(self) -> Path:
        return self.root / "projects" / self.project.folder

    @property
    def design(self) -> Path:
        return self.folder / self.project.design

    def run(self, *words: str | Path, code: int = 0) -> str:
        """Run a command of vicode; return what it prints. It must end with this code."""
        self.capfd.readouterr()
        got = vicode(*map(str, words))
        out, err = self.capfd.readouterr()
        assert got == code, f"vicode {' '.join(map(str, words))}: exit code {got}\n{out}{err}"
        return out

    def trace(self, name: str = "run.jsonl") -> Path:
        """The trace of a run of the project."""
        self.run("run", self.design, "--seconds", SECONDS, "--trace", self.root / name, "--values")
        return self.root / name

    def generate(self, language: str) -> Path:
        """Generate in a language; return the folder with its package."""
        out = self.root / "out"
        self.run("gen", self.folder, "--language", language, "--out", out)
        return out / language


def check(place: Workplace) -> None:
    assert "error" not in place.run("check", place.folder)


def generate_and_compare(place: Workplace) -> None:
    for language in place.project.languages:
        place.generate(language)
        place.run("gen", place.folder, "--language", language, "--out", place.root / "out", "--check")


def compile_python(place: Workplace) -> None:
    """Every generated module is imported by a process with the project in its path."""
    folder = place.generate(PYTHON)
    modules = [path.relative_to(folder).with_suffix("").as_posix().replace("/", ".") for path in folder.rglob("*.py")]
    names = [name.removesuffix(".__init__") for name in modules if not name.endswith("__main__")]
    code = f"import importlib\nfor name in {names!r}: importlib.import_module(name)"
    paths = os.pathsep.join(map(str, (folder, place.folder, *sys.path)))
    _call([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": paths})


def compile_cpp(place: Workplace) -> None:
    """Warnings are errors; the header of the components and each source file can be compiled alone."""
    folder = place.generate(CPP)
    (package,) = (path.name for path in folder.iterdir() if path.is_dir())
    write_unit(folder, package)
    command = [find_gpp(), *STANDARD, *WARNINGS, "-fsyntax-only", "-I.", f"{package}_unit.cpp"]
    assert outputs([start(command, folder)]) == [""]


def compile_xabsl(place: Workplace) -> None:
    (agents,) = place.generate(XABSL).rglob("agents.xabsl")
    place.run("xabsl", "compile", agents, "-o", place.root / "behavior.dat", "--symbols", place.root / "behavior.sym")
    assert (place.root / "behavior.dat").stat().st_size


def run_with_trace(place: Workplace) -> None:
    header, *iterations, summary = _read_trace(place.trace())
    for line in (header, *iterations, summary):
        _VALIDATOR.validate(line)
    assert len(iterations) > 20
    assert all(line["tree"] for line in iterations)
    assert {str(line["errors"]) for line in iterations} == {"[]"}


def replay(place: Workplace) -> None:
    count = len(_read_trace(place.trace())) - 2
    assert f"same states in {count} iterations" in place.run("replay", "run.jsonl", "--design", place.folder)


def sweep(place: Workplace) -> None:
    """The value of the file, or the error that there is none to set."""
    (loaded,) = load_projects([str(place.design)])
    project = loaded.open_project.project
    (root,) = (each for each in project.designs if each.component in loaded.requested)
    declared = {each.name: each for each in project.constants}
    declared |= {f"{root.component}.{each.name}": each for each in root.parameters}
    name, text = next(((name, each.initial) for name, each in declared.items() if each.initial), ("none", "1"))
    words = ("--set", f"{name}={text}", "--seeds", "2", "--seconds", SECONDS, "--out", "results")
    place.run("sweep", place.design, *words, code=0 if declared else 2)
    if declared:
        rows = list(csv.DictReader(Path("results/runs.csv").read_text(encoding="utf-8").splitlines()))
        assert [(row["seed"], row["error"]) for row in rows] == [("1", ""), ("2", "")]


def tournament(place: Workplace) -> None:
    """A project against itself, in two matches of its world."""
    words = ("--matches", "2", "--seconds", SECONDS, "--out", "results")
    assert "p = 1: the difference may be chance" in place.run("tournament", place.folder, place.design, *words)


def trace_stats(place: Workplace) -> None:
    place.trace()
    assert place.run("trace", "stats", "run.jsonl", "--design", place.folder).startswith("1 run, ")


def trace_diff(place: Workplace) -> None:
    assert "same states for" in place.run("trace", "diff", place.trace("a.jsonl"), place.trace("b.jsonl"))


def trace_export(place: Workplace) -> None:
    place.trace()
    place.run("trace", "export", "run.jsonl", "--mcap", "run.mcap")
    topics: dict[str, set[str]] = {}
    with Path("run.mcap").open("rb") as stream:
        for _schema, channel, message in make_reader(stream).iter_messages():
            topics.setdefault(channel.topic, set()).add(json.dumps(sorted(json.loads(message.data))))
    assert topics


def deploy(place: Workplace) -> None:
    """The program starts with a Python that has no packages, from another folder."""
    place.run("deploy", place.design, "--to", "robot", "--python", sys.executable, "--arguments=")
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    printed = _call([place.root / "robot/run", "--ticks", "20"], cwd="/", env=environment)
    assert "20 iterations" in printed or "state:" in printed


def deploy_cpp(place: Workplace) -> None:
    place.run("deploy", place.design, "--to", "robot", "--language", "cpp")
    _call([place.root / "robot/run"])


def conform(place: Workplace) -> None:
    printed = place.run("conform", place.design, "--iterations", "60")
    assert " agree in 60 iterations " in printed, printed


def written_tests(place: Workplace) -> None:
    """What the written suite expects holds in the reference interpreter and in Python."""
    place.run("test", "gen", place.design, "--out", "suites")
    place.run("test", "mutate", place.design, "suites")
    cases = [case for case in list_cases("suites/test_all.py") if case.language == PYTHON]
    assert cases
    for case in cases:
        case.check()


def documentation(place: Workplace) -> None:
    """All links of the site lead to files."""
    place.run("docs", place.folder, "--out", "site")
    pages = sorted(Path("site").rglob("*.html"))
    assert pages
    for page in pages:
        links = _Links()
        links.feed(page.read_text(encoding="utf-8"))
        for link in links.found:
            url = urlsplit(link)
            if url.scheme or url.netloc or not url.path:
                continue
            assert (page.parent / unquote(url.path)).exists(), f"{page}: {link}"


def diff_with_itself(place: Workplace) -> None:
    shutil.copytree(place.folder, place.root / "copy")
    assert place.run("diff", place.folder, place.root / "copy") == ""


def export_pictures(place: Workplace) -> None:
    for form in ("svg", "pdf", "png"):
        place.run("export", place.design, "--format", form, "-o", f"picture.{form}")
    assert ElementTree.parse("picture.svg").getroot().tag.endswith("svg")
    assert len(PdfReader("picture.pdf").pages) == 1
    with Image.open("picture.png") as picture:
        picture.load()


def export_dot(place: Workplace) -> None:
    """Graphviz draws it, also at the positions of the diagram: `nop2` is what `neato -n2` runs."""
    text = place.run("export", place.design, "--format", "dot", "-o", "-")
    for engine in ("dot", "nop2"):
        plain = pygraphviz.AGraph(string=text).draw(format="plain", prog=engine).decode()
        assert "Error" not in place.capfd.readouterr().err
        assert plain.splitlines()[0] != "graph 1 0 0"


def export_texts(place: Workplace) -> None:
    for form, first in (("mermaid", "---"), ("plantuml", "@startuml")):
        assert place.run("export", place.design, "--format", form, "-o", "-").startswith(first)


def sync_after_gen(place: Workplace) -> None:
    place.run("gen", place.folder)
    before = _contents(place.root)
    place.run("sync", place.folder, "--check")
    place.run("sync", place.folder)
    assert _contents(place.root) == before


def attach(place: Workplace) -> None:
    """The robot stops at a breakpoint of a viewer, and continues."""
    words = ["run", str(place.design), "--watch", "0", "--control", "--without-hold"]
    words += ["--real-time", "--tick-ms", "5", "--plain"]
    with _vicode(place, *words) as process:
        port, token = _watched(process)
        with socket.create_connection(("127.0.0.1", port), timeout=LIMIT_S) as viewer:
            lines = map(json.loads, viewer.makefile("rb"))

            def send(**message: object) -> None:
                viewer.sendall(json.dumps(message).encode() + b"\n")

            send(token=token, rate_hz=200)
            (robot,) = next(line["robots"] for line in lines if line.get("robots"))
            root = robot["root"]
            states = [[name, state] for name, each in robot["components"].items() for state in each["states"]]
            send(id=1, robot=robot["name"], do="break", places=[*states, ["", "error"]])
            # A state may never be entered; an exception is raised.
            send(id=2, robot=robot["name"], do="raise", component=root, message="stop here")
            reached = next(line for line in lines if line.get("paused"))
            assert reached["tree"][0]["component"] == root
            assert reached["tree"][0]["state"] in robot["components"][root]["states"]
            send(id=3, robot=robot["name"], do="break", places=[])
            send(id=4, robot=robot["name"], do="resume")
            assert next(
                line
                for line in lines
                if "tree" in line and not line["paused"] and line["iteration"] > reached["iteration"]
            )


def bridge(place: Workplace) -> None:
    """A robot connects in lock step, gets an answer to each tick, and leaves."""
    with _vicode(place, "bridge", str(place.design), "--port", "0", "--plain") as process:
        assert process.stdout is not None
        port = re.search(r"127\.0\.0\.1:(\d+)", process.stdout.readline())
        assert port is not None
        with socket.create_connection(("127.0.0.1", int(port[1])), timeout=LIMIT_S) as robot:
            lines = robot.makefile("rb")
            assert b"accepted" in lines.readline()
            robot.sendall(b'{"hello": {"robot": "r1", "pace": "client"}}\n')
            assert "welcome" in json.loads(lines.readline())
            for number in range(3):
                robot.sendall(json.dumps({"tick": number * 0.05}).encode() + b"\n")
                assert json.loads(lines.readline())["tick"] == number * 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class TableCommand:
    """A command; `fits` tells which projects it is for."""

    name: str
    run: Callable[[Workplace], None]
    fits: Callable[[TableProject], bool] = field(default=lambda _project: True)


def _runs(project: TableProject) -> bool:
    return not project.needs


COMMANDS = (
    TableCommand(name="check", run=check),
    TableCommand(name="gen", run=generate_and_compare),
    TableCommand(name="compile Python", run=compile_python),
    TableCommand(name="compile C++", run=compile_cpp, fits=lambda project: CPP in project.languages),
    TableCommand(name="compile XABSL", run=compile_xabsl, fits=lambda project: XABSL in project.languages),
    TableCommand(name="run", run=run_with_trace, fits=_runs),
    TableCommand(name="sweep", run=sweep, fits=_runs),
    TableCommand(name="tournament", run=tournament, fits=lambda project: project.has_matches),
    TableCommand(name="replay", run=replay, fits=_runs),
    TableCommand(name="trace stats", run=trace_stats, fits=_runs),
    TableCommand(name="trace diff", run=trace_diff, fits=_runs),
    TableCommand(name="trace export", run=trace_export, fits=_runs),
    TableCommand(name="deploy", run=deploy, fits=_runs),
    TableCommand(name="deploy C++", run=deploy_cpp, fits=lambda project: project.has_program),
    TableCommand(name="conform", run=conform, fits=lambda project: len(project.languages) > 1),
    TableCommand(name="test", run=written_tests),
    TableCommand(name="docs", run=documentation),
    TableCommand(name="diff", run=diff_with_itself),
    TableCommand(name="export pictures", run=export_pictures),
    TableCommand(name="export dot", run=export_dot),
    TableCommand(name="export texts", run=export_texts),
    TableCommand(name="sync", run=sync_after_gen),
    TableCommand(name="attach", run=attach, fits=_runs),
    TableCommand(name="bridge", run=bridge, fits=lambda project: project.has_bridge),
)


def _call(command: list[str | Path], **options: Any) -> str:
    done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT_S, check=False, **options)
    assert (done.returncode, done.stderr) == (0, ""), f"{command}: exit code {done.returncode}\n{done.stderr}"
    return done.stdout


@contextmanager
def _vicode(place: Workplace, *words: str) -> Iterator["subprocess.Popen[str]"]:
    """A command that runs until the block ends."""
    command = [sys.executable, "-m", "vicode", *words]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        try:
            yield process
        finally:
            process.send_signal(signal.SIGINT)
            try:
                process.communicate(timeout=LIMIT_S)
            finally:
                process.kill()
        assert process.returncode == 128 + signal.SIGINT


def _watched(process: "subprocess.Popen[str]") -> tuple[int, str]:
    assert process.stderr is not None
    for line in process.stderr:
        if found := re.search(r"attach 127\.0\.0\.1:(\d+) --token (\S+)", line):
            return int(found[1]), found[2]
    raise AssertionError("the run ended")


def _read_trace(file: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]


def _contents(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class _Links(HTMLParser):
    """Collects the addresses in a page."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found += [value for name, value in attrs if name in ("href", "src") and value]
