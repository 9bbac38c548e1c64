"""vicode tournament: the same table however the matches are executed, and what a difference of the versions shows."""

import csv
import json
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from tests.cli.git_folder import commit, git, init

PROJECT = """\
vicode: 1
project: Team
languages: [python]
world: hall.world:World
constants: {skill: 0.3}
components:
  Foot: {implementation: "hall.foot:Foot", parameters: {power: 0.0}}
agents: {player: {root: Player}}
"""
PLAYER = """\
vicode: 1
component: Player
uses: {foot: Foot}
initial: Play
states:
  Play: {modulates: {foot: {power: skill}}}
"""
FOOT = """\
from vicode.bica import Component

class Foot(Component):
    def modulate(self, *, power=0.0):
        self.power = power

    def work(self):
        self.world.kick(power=self.power * 1)
"""
WORLD = """\
from pathlib import Path
from random import Random

class World:
    def __init__(self, match=None, noise=None):
        self.match, self.noise, self.goals, self.heard = match, noise, 0, 0

    @staticmethod
    def start_match(seed):
        if seed == 2 and Path("trouble").exists():
            raise ValueError("no ball")
        return Match(seed)

    def kick(self, *, power):
        self.goals += self.noise.random() < power

    def hear(self, team):
        team.prepare()
        mate, = (each for own in self.match.teams if self in own for each in own if each is not self)
        if mate.heard:
            team.hear(mate.heard)
        assert team.size == 1 + bool(mate.heard)

    def tell(self, team):
        self.heard = team.tell()

class Match:
    tick_ns = 1_000_000_000

    def __init__(self, seed):
        self.teams = [[World(self, Random(f"{seed} {side} {n}")) for n in range(2)] for side in range(2)]
        self.now_s = 0

    @property
    def finished(self):
        return self.now_s >= 10

    @property
    def goals(self):
        return [sum(world.goals for world in own) for own in self.teams]

    def advance(self, now_ns):
        self.now_s = now_ns / 1e9

    def summary(self):
        return {"seconds": self.now_s}
"""


def write(folder: Path) -> Path:
    files = {"project.yaml": PROJECT, "player.yaml": PLAYER, "hall/world.py": WORLD, "hall/foot.py": FOOT}
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@pytest.fixture
def versions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Path]:
    """The folders `good` and `bad`: robots of the second kick half as well. We are in their parent."""
    monkeypatch.chdir(tmp_path)
    good, bad = write(tmp_path / "good"), write(tmp_path / "bad")
    change(bad / "project.yaml", "skill: 0.3", "skill: 0.15")
    return good, bad


def change(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def tournament(*words: str, first: str = "good", second: str = "bad", matches: int = 6, out: str = "out") -> int:
    return vicode("tournament", first, second, "--matches", str(matches), "--out", out, *words)


def table(out: str = "out") -> list[dict[str, str]]:
    with Path(out, "runs.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def read_json(capsys: pytest.CaptureFixture[str]) -> dict[str, float]:
    result: dict[str, float] = json.loads(capsys.readouterr().out)
    return result


def goals(capsys: pytest.CaptureFixture[str]) -> list[float]:
    result = read_json(capsys)
    return [result["goals_a"], result["goals_b"]]


def test_the_table_is_the_same_on_one_core_on_two_and_on_a_cluster(versions: tuple[Path, Path]) -> None:
    assert tournament("--jobs", "1", out="one") == 0
    assert tournament("--jobs", "2", out="two") == 0
    for name in ("runs.csv", "tournament.md"):
        assert Path("one", name).read_bytes() == Path("two", name).read_bytes()
    assert [(row["seed"], row["home"]) for row in table("one")] == [(seed, home) for seed in "123" for home in "AB"]
    assert {(row["error"], row["stopped"], row["time_s"]) for row in table("one")} == {("", "finished", "10.0")}
    if find_spec("distributed") is None:
        pytest.skip("Dask is missing: install the extra cluster")
    from distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address="127.0.0.1:0") as cluster:
        assert tournament("--cluster", cluster.scheduler_address, out="there") == 0
    assert Path("there/runs.csv").read_bytes() == Path("one/runs.csv").read_bytes()


def test_a_worse_version_loses_significantly(versions: tuple[Path, Path], capsys: pytest.CaptureFixture[str]) -> None:
    assert tournament("--json", matches=16) == 0
    result = read_json(capsys)
    assert result["p"] < 0.05
    assert result["difference"] > 1
    assert (result["matches"], result["failed"]) == (16, 0)
    rows = table()
    assert result["goals_a"] == sum(int(row["world.goals_a"]) for row in rows)
    assert tournament(first="bad", second="good", matches=16, out="turned") == 0
    assert "B is better." in capsys.readouterr().out
    # The match of A at home is that of B at home with exchanged versions.
    turned = {(row["seed"], row["home"]): row["world.goals_b"] for row in table("turned")}
    assert [turned[row["seed"], "BA"[row["home"] == "B"]] for row in rows] == [row["world.goals_a"] for row in rows]


def test_equal_versions_are_equal(versions: tuple[Path, Path], capsys: pytest.CaptureFixture[str]) -> None:
    assert tournament("--json", second="good/player.yaml", matches=10) == 0
    result = read_json(capsys)
    assert (result["p"], result["difference"], result["won"]) == (1, 0, result["lost"])
    assert result["goals_a"] == result["goals_b"] > 0


def test_a_revision_plays_with_its_own_code(versions: tuple[Path, Path], capsys: pytest.CaptureFixture[str]) -> None:
    """The modules of both versions have the same names."""
    top = write(Path("repository/robots").resolve()).parent
    change(top / "robots/hall/foot.py", "self.power * 1", "0")
    init(top)
    git(top, "tag", "old")
    change(top / "robots/hall/foot.py", "power=0)", "power=1)")
    commit(top, "better")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(top)
        assert tournament("--json", first="robots", second="old:robots/player.yaml", matches=2) == 0
        # Each of two robots scores in each of ten iterations, in two matches.
        assert goals(capsys) == [40, 0]
        assert tournament("--json", first="old:robots", second="HEAD:robots", matches=2, out="turned") == 0
        assert goals(capsys) == [0, 40]
        assert tournament(first="robots", second="HEAD:robot") == 2
        assert "revision HEAD has no 'robot'; write the path from the root" in capsys.readouterr().err
        assert tournament(first="robots", second="never:robots") == 2
        assert "unknown revision 'never'" in capsys.readouterr().err


def test_the_same_command_plays_only_what_is_missing(
    versions: tuple[Path, Path], capsys: pytest.CaptureFixture[str]
) -> None:
    assert tournament(matches=2) == 0
    runs = Path("out/runs.jsonl")
    before = runs.read_bytes()
    assert tournament(matches=4) == 0
    assert runs.read_bytes().startswith(before)
    assert len(runs.read_bytes().splitlines()) == 5
    change(versions[1] / "hall/foot.py", "self.power * 1", "0")
    assert tournament(matches=4) == 2
    assert "out/runs.jsonl has runs with another version B; choose another --out" in capsys.readouterr().err
    assert tournament("--again", matches=4) == 0
    assert {row["world.goals_b"] for row in table()} == {"0"}


def test_a_failed_match_is_a_row_and_its_seed_does_not_count(
    versions: tuple[Path, Path], capsys: pytest.CaptureFixture[str]
) -> None:
    Path("trouble").touch()
    assert tournament("--json") == 1
    result = read_json(capsys)
    assert (result["matches"], result["failed"]) == (4, 2)
    assert [bool(row["error"]) for row in table()] == [False, False, True, True, False, False]
    assert table()[2]["error"].startswith("the match failed: ValueError: no ball [hall/world.py:")
    Path("trouble").unlink()
    assert tournament() == 0


def test_an_error_of_a_robot_fails_the_match(versions: tuple[Path, Path], capsys: pytest.CaptureFixture[str]) -> None:
    change(versions[1] / "hall/foot.py", "self.power * 1", "self.force")
    assert tournament(matches=2) == 1
    out = capsys.readouterr().out
    assert "2 matches, 2 failed" in out
    assert "A at home, seed 1: Foot, work" in out
    assert "No seed was played in both matches without an error: nothing is compared." in out
    assert "chance" not in out + Path("out", "tournament.md").read_text(encoding="utf-8")
    assert tournament("--json", matches=2) == 1
    result = json.loads(capsys.readouterr().out)
    assert (result["failed"], result["difference"], result["p"]) == (2, None, None)
    assert [(each["home"], each["seed"]) for each in result["errors"]] == [("A", 1), ("B", 1)]
    assert all(each["error"].startswith("Foot, work") for each in result["errors"])


def test_an_error_of_closing_a_robot_fails_the_match(
    versions: tuple[Path, Path], capsys: pytest.CaptureFixture[str]
) -> None:
    change(versions[1] / "hall/foot.py", "    def work", "    def close(self):\n        1 / 0\n\n    def work")
    assert tournament(matches=2) == 1
    assert "2 matches, 2 failed" in capsys.readouterr().out


def test_what_is_not_played_is_said(versions: tuple[Path, Path], capsys: pytest.CaptureFixture[str]) -> None:
    change(versions[1] / "hall/foot.py", "*, power=0.0", "*, force=0.0")
    assert tournament(matches=2) == 1
    error = capsys.readouterr().err
    assert "warning P212" in error
    assert "vicode: cannot play bad: correct 1 warning first" in error


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        ("project.yaml", "world: hall.world:World\n", "", "vicode: good has no world in which matches can be played"),
        ("hall/world.py", "def start_match", "def begin", "has no attribute 'start_match'"),
    ],
)
def test_a_project_without_matches_is_told_so(
    versions: tuple[Path, Path], capsys: pytest.CaptureFixture[str], file: str, old: str, new: str, message: str
) -> None:
    change(versions[0] / file, old, new)
    assert tournament(matches=2) > 0
    printed = capsys.readouterr()
    assert message in printed.out + printed.err


@pytest.mark.parametrize("number", ["3", "0", "5000"])
def test_the_number_of_matches_is_even(capsys: pytest.CaptureFixture[str], number: str) -> None:
    assert vicode("tournament", "a", "b", "--out", "out", "--matches", number) == 2
    assert "argument --matches: write an even number up to 4000" in capsys.readouterr().err
