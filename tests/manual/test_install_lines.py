"""Install lines install this distribution: on PyPI, `vicode` is another project with the same command."""

import ast
import re
import tomllib
from collections.abc import Iterator
from functools import cache

import pytest

from tests.manual.code_blocks import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
EXTRAS = PROJECT["optional-dependencies"]
FOLDERS = ("docs", "vicode", "templates", "designs", "benchmarks", ".ci")
SUFFIXES = {".md", ".js", ".json", ".html", ".css", ".yaml", ".yml", ".j2", ".txt", ".toml", ""}

_COMMAND = r"\b(?:(?:pip3?|pipx|uv tool|uv pip) (?:install|download|wheel|run|upgrade)\b|uvx |uv add )"
_INSTALL = re.compile(rf"(?P<before>.?){_COMMAND}(?P<arguments>(?:(?!{_COMMAND})[^\n])*)")
_END = re.compile(r" && | \|\|? |; | \(|\)| # | {2,}|, ")
_OPTIONS_WITH_VALUES = {
    *("--with", "--wheel-dir", "-w", "--dest", "-d", "--python"),
    *("--resolution", "--index-url", "--target"),
}
_NAME = re.compile(r"(?P<name>[A-Za-z0-9][\w.-]*)(?:\[(?P<extras>[\w,$*-]+)\])?(?:[<>=!~].*)?$")


@cache
def texts() -> list[tuple[str, str]]:
    return list(_read_texts())


def _read_texts() -> Iterator[tuple[str, str]]:
    """Each text that a reader sees or a program runs, with its origin; of Python, the constants."""
    files = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*") if path.is_file()]
    for path in [*files, *ROOT.glob("*.md"), ROOT / "Makefile"]:
        name = str(path.relative_to(ROOT))
        if path.suffix == ".py":
            source = path.read_text(encoding="utf-8")
            if re.search(r"\b(pip|pipx|uv|uvx)\b|vicode\[", source):
                yield from ((name, text) for text in _strings(ast.parse(source)))
        elif path.suffix in SUFFIXES or "templates" in path.parts:
            yield name, path.read_text(encoding="utf-8", errors="replace")


def _strings(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
        elif isinstance(node, ast.JoinedStr):
            yield "".join(str(part.value) if isinstance(part, ast.Constant) else "{}" for part in node.values)


def requirements(text: str) -> Iterator[str]:
    """What the install lines in a text install."""
    for match in _INSTALL.finditer(text):
        arguments, quote = match["arguments"].strip(), match["before"]
        if quote and quote in "'\"`":
            arguments = re.split(f" *{quote}(?:[ .,:;)]|$)", arguments)[0]
        words = re.findall(r"'[^']*'|\"[^\"]*\"|[^\s'\"`]+", _END.split(arguments)[0])
        skips = False
        for word in words:
            bare = word.strip("'\"").rstrip(".,")
            if not skips and bare and not bare.startswith("-"):
                yield bare
            skips = word in _OPTIONS_WITH_VALUES


def problem_of(requirement: str) -> str:
    """Why a requirement is not ours, or ""."""
    is_path = "://" not in requirement and (requirement.startswith((".", "/")) or requirement.endswith(".whl"))
    if is_path:
        wheel = requirement.rpartition("/")[2]
        is_ours = not wheel.endswith(".whl") or wheel.startswith(f"{PROJECT['name'].replace('-', '_')}-")
        extras = re.findall(r"\[([\w,]+)\]$", requirement)
        return (
            ""
            if is_ours and {*",".join(extras).split(",")} <= {"", *EXTRAS}
            else "a wheel or an extra that does not exist"
        )
    match = _NAME.match(requirement)
    if match is None:
        return "neither a name nor a path"
    if match["name"] == PROJECT["name"]:
        return "" if {*(match["extras"] or "").split(",")} <= {"", *EXTRAS} else "an extra that does not exist"
    extras = (each for extra in EXTRAS.values() for each in extra)
    libraries = {re.split(r"[<>=\[]", each)[0] for each in (*PROJECT["dependencies"], *extras)}
    return "" if match["name"] in libraries else "another distribution"


def test_install_lines_install_this_distribution() -> None:
    found = [(origin, each) for origin, text in texts() for each in requirements(text)]
    assert {(origin, each, problem_of(each)) for origin, each in found if problem_of(each)} == set()
    origins = {origin for origin, _each in found}
    assert {"README.md", "Makefile", ".ci/versions", "docs/in-ci.md", "vicode/cli/sim.py"} <= origins
    assert {"vicode/vscode/README.md", "vicode/vscode/extension.js", "vicode/bica/net_session.py"} <= origins


def test_the_extras_refer_to_this_distribution() -> None:
    own = {each for extra in EXTRAS.values() for each in extra if each.startswith("vicode")}
    assert own == {f"{PROJECT['name']}[test]"}
    assert PROJECT["name"] == "vicode-fsm"


def test_no_text_names_an_extra_of_another_distribution() -> None:
    wrong = re.compile(rf"\bvicode\[(?:{'|'.join(EXTRAS)})[\],]")
    shown = ((origin, re.sub(r"/path/to/vicode\[", "", text)) for origin, text in texts())
    assert {origin for origin, text in shown if wrong.search(text)} == set()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("- run: pip install vicode\n", ["vicode"]),
        ("Install it with 'pip install vicode', or set the command.", ["vicode"]),
        (
            "it with: pip install 'vicode[net]' (on a robot: pip install eclipse-zenoh)",
            ["vicode[net]", "eclipse-zenoh"],
        ),
        ("(`pip install vicode`). If the", ["vicode"]),
        ("`pip install -U 'vicode[sim]'`.", ["vicode[sim]"]),
        ("pipx install vicode && vicode edit", ["vicode"]),
        ("uv tool install --python 3.12 vicode", ["vicode"]),
        ("uvx vicode edit", ["vicode", "edit"]),
    ],
)
def test_install_lines_are_found(text: str, expected: list[str]) -> None:
    assert list(requirements(text)) == expected
    assert problem_of(expected[0])


@pytest.mark.parametrize("given", ["vicode_fsm", "git+https://example.org/vicode", "a/vicode-1.whl", "./x[none]", "v"])
def test_other_requirements_are_refused(given: str) -> None:
    assert problem_of(given)


@pytest.mark.parametrize(
    "given", ["/path/to/vicode[sim,net]", "./tools/vicode_fsm-0.1.0-py3-none-any.whl", "vicode-fsm[net]"]
)
def test_a_checkout_a_wheel_and_the_distribution_are_allowed(given: str) -> None:
    assert not problem_of(given)
