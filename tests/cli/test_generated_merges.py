"""Random merges by git of generated files that were edited by hand: what either side wrote never leaves the tree.

The oracle looks at lines only: each edit contains a word of its own. After each command, the word is in a design, a
generated file, a patch or a copy; or the command has failed with a finding and has written nothing.
"""

import random
import re
from collections import Counter
from collections.abc import Callable, Collection
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from tests.cli.git_folder import ENVIRONMENT, git
from vicode.store import find_conflicts, resolve_conflicts

PROJECT = "vicode: 1\nproject: Lamps\nlanguages: [python, cpp]\n"
LAMP = """\
vicode: 1
component: Lamp
doc: A lamp.
variables:
  count: {initial: 1001, doc: So many.}
  other: 1002
module: {python: "LIMIT = 1003", cpp: "const int LIMIT = 1003;"}
initial: Dark
states:
  Dark:
    doc: No light.
    enter:
      python: |
        self.a = 1004
        self.b = 1005
        self.c = 1006
      cpp: |
        int a = 1004;
        int b = 1005;
        int c = 1006;
    transitions:
      - {to: Lit, when: count > 1007}
      - {to: Lit, after: 1008}
  Lit:
    actions:
      - set: {other: 1009}
      - code: {python: self.d = 1010, cpp: int d = 1010;}
    transitions:
      - {to: Dark, when: other < 1011, doc: Off.}
  Broken: {final: true}
"""
DESIGN = Path("lamps/lamp.yaml")
FOLDER = Path("lamps/generated")
FILES = (FOLDER / "python/lamps/lamp.py", FOLDER / "cpp/lamps/lamp.cpp")
STYLES = ("merge", "diff3", "zdiff3")
NUMBER = re.compile(r"\b10\d\d\b")


class Writer:
    """Makes edits; `words` are those that stand in the work tree."""

    def __init__(self, seed: int) -> None:
        self.chance = random.Random(seed)
        self.favorite = seed
        self.next = 7_770_000

    def word(self) -> str:
        self.next += 1
        return str(self.next)

    def change_number(self, file: Path) -> None:
        """Replace a number of the first version, in a region or outside: a value, a test, a time, code."""
        text = file.read_text()
        found = list(NUMBER.finditer(text))
        # Both sides of a merge often change the same one.
        at = found[self.favorite % len(found)] if self.chance.random() < 0.5 else self.chance.choice(found)
        file.write_text(text[: at.start()] + self.word() + text[at.end() :])

    def insert_line(self, file: Path) -> None:
        """Insert a comment before any line of code, in a region or outside."""
        lines = file.read_text().split("\n")
        places = [at for at, line in enumerate(lines) if line.strip() and at]
        at = self.chance.choice(places)
        indent = lines[at][: len(lines[at]) - len(lines[at].lstrip())]
        mark = "#" if file.suffix == ".py" else "//"
        lines.insert(at, f"{indent}{mark} {self.word()}")
        file.write_text("\n".join(lines))

    def insert_code(self, file: Path) -> None:
        """Insert a statement into a region."""
        lines = file.read_text().split("\n")
        at = self.chance.choice([at for at, line in enumerate(lines) if "<vicode " in line])
        indent = lines[at][: len(lines[at]) - len(lines[at].lstrip())]
        word = self.word()
        line = f"x_{word} = {word}" if file.suffix == ".py" else f"int x_{word} = {word};"
        lines.insert(at + 1, indent + line)
        file.write_text("\n".join(lines))

    def append_method(self, file: Path) -> None:
        word = self.word()
        code = f"def f_{word}():\n    return {word}" if file.suffix == ".py" else f"int f_{word}() {{ return {word}; }}"
        file.write_text(f"{file.read_text()}\n\n{code}\n")

    def edit_design(self, _file: Path) -> None:
        """Replace a number or add a state, and generate if that is possible."""
        if self.chance.random() < 0.5:
            self.change_number(DESIGN)
        else:
            word = self.word()
            DESIGN.write_text(f"{DESIGN.read_text()}  S{word}: {{transitions: [{{to: Dark, after: {word}}}]}}\n")
        vicode("gen", "lamps")

    def edit(self) -> None:
        edits: tuple[Callable[[Path], None], ...] = (
            self.change_number,
            self.insert_line,
            self.insert_code,
            self.append_method,
            self.edit_design,
            self.edit_design,
        )
        self.chance.choice(edits)(self.chance.choice(FILES))


def tree() -> dict[str, str]:
    """All files that a person sees."""
    files = (file for file in Path("lamps").rglob("*") if file.is_file() and ".vicode" not in file.parts)
    return {file.as_posix(): file.read_text() for file in files}


def words() -> set[str]:
    return words_of("\n".join(tree().values()))


def words_of(text: str) -> set[str]:
    return set(re.findall(r"777\d{4}", re.sub(r"(?<=\d)[_'](?=\d)", "", text)))


def require_kept(command: list[str], counts: Counter[str], given_up: Collection[str] = ()) -> int:
    """Run a command; the words stay, and a refusal writes nothing."""
    before, wanted = tree(), words().difference(given_up)
    code = vicode(*command)
    if code and not any(file.endswith(".patch") for file in tree().keys() - before.keys()):
        assert tree() == before, f"{command} failed and wrote"
        counts["refused"] += 1
    else:
        counts["written"] += 1
    assert wanted <= words(), f"{command} lost {wanted - words()}"
    return code


def resolve_markers(chance: random.Random) -> set[str]:
    """Remove the markers of git as a person does; return the words of the sides that the person gives up."""
    given_up: set[str] = set()
    for file in (DESIGN, *FILES):
        text = file.read_text()
        while conflicts := find_conflicts(text):
            takes_theirs = chance.random() < 0.5
            part = conflicts[0]
            given_up |= words_of(part.ours if takes_theirs else part.theirs)
            text = resolve_conflicts(text, conflicts[:1], takes_theirs=takes_theirs)
        file.write_text(text)
    return given_up


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Path:
    for name, value in ENVIRONMENT.items():
        monkeypatch.setenv(name, value)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lamps").mkdir()
    (tmp_path / "lamps/project.yaml").write_text(PROJECT)
    DESIGN.write_text(LAMP)
    git(tmp_path, "init", "-q", "-b", "main")
    assert vicode("gen", "lamps") == 0
    git(tmp_path, "add", "--all")
    git(tmp_path, "commit", "-q", "-m", "begin")
    return tmp_path


def merge_and_sync(folder: Path, seed: int, counts: Counter[str]) -> None:
    writer = Writer(seed)
    git(folder, "config", "merge.conflictStyle", STYLES[seed % 3])
    written = set()
    for branch in ("theirs", "ours"):
        git(folder, "reset", "-q", "--hard")
        git(folder, "checkout", "-q", "-B", branch, "main")
        git(folder, "clean", "-qfdx", "-e", ".vicode")
        vicode("gen", "lamps")
        for _edit in range(writer.chance.randint(2, 4)):
            writer.edit()
        counts["edits"] += 1
        written |= words()
        git(folder, "add", "--all")
        git(folder, "commit", "-q", "--no-verify", "--allow-empty", "-m", branch)
    git(folder, "merge", "--no-edit", "theirs", check=False)
    # A word that the other side replaced, such as that of an earlier edit, is no loss.
    assert written - words() <= set(), f"seed {seed}: the merge lost {written - words()}"
    counts["conflicts"] += any("<<<<<<<" in text for text in tree().values())
    require_kept(["gen", "lamps"], counts)
    require_kept(["sync", "lamps"], counts)
    given_up: set[str] = set()
    if any("<<<<<<<" in text for text in tree().values()):
        require_kept(["sync", "lamps", "--outside-regions"], counts)
        given_up = resolve_markers(writer.chance)
        require_kept(["gen", "lamps"], counts)
    side = writer.chance.choice(["file", "design"])
    for options in ([], ["--outside-regions"], ["--outside-regions", "--take", side]):
        code = require_kept(["sync", "lamps", *options], counts, given_up)
        counts["settled"] += not code and not vicode("sync", "--check", "lamps")
    # What was kept as a patch stays when there is more.
    for file in FILES:
        writer.append_method(file)
    require_kept(["sync", "lamps", "--outside-regions", "--take", side], counts, given_up)


@pytest.mark.parametrize("has_driver", [False, True])
@pytest.mark.parametrize("merges", [4, pytest.param(150, marks=pytest.mark.nightly)])
def test_nothing_that_a_side_wrote_is_lost(
    repository: Path, record_property: Callable[[str, object], None], has_driver: bool, merges: int
) -> None:
    if has_driver:
        assert vicode("hook", "install") == 0
        git(repository, "add", "--all")
        git(repository, "commit", "-q", "--no-verify", "-m", "hooks")
    counts: Counter[str] = Counter()
    for seed in range(merges):
        merge_and_sync(repository, seed, counts)
    record_property("counts", dict(counts))
    assert counts["written"] > merges
    assert counts["refused"] > merges
    assert counts["conflicts"]
