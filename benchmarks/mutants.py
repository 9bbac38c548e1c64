"""Which small errors no test notices: a random sample of mutants of `vicode/`, tried in a copy of the checkout.

`python -m benchmarks.mutants --count 50 --seed 1 [--package store]`

First the tests run once with probes, which record the tests that reach each mutated statement (some minutes). Then each
mutant meets the tests that reach it, those of its own package first. A survivor is equivalent, or is needless code, or
lacks a test. Only a failed test kills: mutants that reach the time limit, and those without a run of tests, are counted
apart. `--at vicode/store/patcher.py:120 --tests tests/store` tries all mutants of a line or file on chosen tests.
"""

import argparse
import ast
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any, NoReturn

# Loaded before a process is forked for each mutant: libraries that take long to import and do not import vicode.
import playwright.sync_api  # noqa: F401
import pytest
from hypothesis import HealthCheck, Phase, settings

ROOT = Path(__file__).parents[1]
FAST = "not browser and not nightly"
# The elements of pages, command lines, and modules of texts and colors.
LEFT_OUT = re.compile(r"vicode/(editor/(?!session|view)|cli/|findings/|.*/(messages|descriptions|texts|palettes)\.py)")
SWAPPED: dict[type[ast.AST], type[ast.AST]] = {
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt,
    ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In, ast.And: ast.Or, ast.Or: ast.And,
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.FloorDiv: ast.Mult, ast.BitAnd: ast.BitOr,
}  # fmt: skip
FIXED_FIELDS = {"decorator_list", "annotation", "returns", "bases"}
PROBE = """
import os
seen = set()
def hit(site):
    pair = site, os.environ.get("PYTEST_CURRENT_TEST", "")
    if pair[1] and pair not in seen:
        seen.add(pair)
        with open(os.path.join(os.path.dirname(__file__), "hits"), "a") as file:
            file.write("%s\\t%s\\n" % pair)
"""
settings.register_profile(
    "mutants", derandomize=True, database=None, max_examples=40, deadline=None,
    phases=(Phase.explicit, Phase.generate), suppress_health_check=[HealthCheck.too_slow],
)  # fmt: skip

Part = ast.expr | ast.stmt | ast.keyword


class Outcome(StrEnum):
    """What the tests say of a mutant."""

    KILLED = "killed"
    SURVIVED = "survived"
    LIMIT = "reached the time limit"
    NOT_RUN = "not run"


@dataclass(frozen=True, slots=True)
class Reach:
    """The tests that reach each statement (FILE:LINE) and each file.

    Attributes:
        hits: The tests by statement and by file.
        seconds: The time of each test without its set-up.
        setups: The longest set-up of each file of tests: the first of its tests to run prepares what they share.
    """

    hits: dict[str, set[str]]
    seconds: dict[str, float]
    setups: dict[str, float]


@dataclass(frozen=True, slots=True)
class Mutant:
    """The bytes `start` to `end` of a file replaced by `text`.

    `statement` is the line where its statement begins, 0 outside of functions.
    """

    file: str
    line: int
    statement: int
    start: int
    end: int
    text: str

    def apply(self) -> bytes:
        source = (ROOT / self.file).read_bytes()
        return source[: self.start] + self.text.encode() + source[self.end :]

    def describe(self) -> str:
        old, new = (ROOT / self.file).read_bytes(), self.apply()
        start, end = old.rfind(b"\n", 0, self.start) + 1, old.index(b"\n", self.end)
        parts = ("-", old[start:end]), ("+", new[start : end + len(new) - len(old)])
        lines = [f"{mark} {line}" for mark, part in parts for line in part.decode().splitlines()]
        return "\n".join([f"{self.file}:{self.line}", *lines])

    def compiles(self) -> bool:
        with suppress(SyntaxError):
            return bool(compile(self.apply(), self.file, "exec", dont_inherit=True))
        return False


def find_mutants(file: str, line_starts: list[int], node: ast.AST, statement: int = 0) -> Iterator[Mutant]:
    """All mutants of a node and of what it contains."""
    if _is_fixed(node):
        return
    statement = node.lineno if statement and isinstance(node, ast.stmt) else statement
    for part, text in (*_change_operators(node), *_change_values(node), *_drop_parts(node)):
        start = line_starts[part.lineno - 1] + part.col_offset
        end = line_starts[(part.end_lineno or 0) - 1] + (part.end_col_offset or 0)
        yield Mutant(file, part.lineno, statement, start, end, text)
    for field, value in ast.iter_fields(node):
        is_body = field == "body" and isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and field not in FIXED_FIELDS:
                yield from find_mutants(file, line_starts, child, getattr(child, "lineno", 0) if is_body else statement)


def _is_fixed(node: ast.AST) -> bool:
    """Whether it stays as it is: an error, a docstring, a type, a list of names."""
    match node:
        case ast.Assert() | ast.Raise() | ast.JoinedStr() | ast.Import() | ast.ImportFrom():
            return True
        case ast.Expr(ast.Constant()) | ast.Assign([ast.Name("__all__")]) | ast.If(ast.Name("TYPE_CHECKING")):
            return True
        case ast.Call(ast.Name("cast" | "TypeVar" | "Finding")):
            return True
    return False


def _change_operators(node: ast.AST) -> Iterator[tuple[Part, str]]:
    match node:
        case ast.Compare(left, [operator, *more], comparators):
            yield node, f"({ast.unparse(ast.Compare(left, [_swap(operator), *more], comparators))})"
        case ast.BoolOp(operator, values):
            yield node, f"({ast.unparse(ast.BoolOp(_swap(operator), values))})"
        case ast.BinOp(left, operator, right) if type(operator) in SWAPPED and not (_is_text(left) or _is_text(right)):
            yield node, f"({ast.unparse(ast.BinOp(left, _swap(operator), right))})"
        case ast.UnaryOp(ast.Not() | ast.USub(), operand):
            yield node, f"({ast.unparse(operand)})"


def _swap(operator: ast.AST) -> Any:
    return SWAPPED[type(operator)]()


def _is_text(node: ast.expr) -> bool:
    """Whether it is a literal that has no arithmetic."""
    literals = ast.JoinedStr | ast.List | ast.Tuple | ast.ListComp
    return isinstance(node, literals) or (isinstance(node, ast.Constant) and isinstance(node.value, str))


def _change_values(node: ast.AST) -> Iterator[tuple[Part, str]]:
    match node:
        case ast.Constant(bool(value)):
            yield node, str(not value)
        case ast.Constant(int(value)):
            yield node, str(value + 1)
        case ast.Constant(str(value)) if re.fullmatch(r"[\w-]+", value):
            yield node, repr(value + "x")
        case ast.Return(ast.expr() as value) if ast.unparse(value) != "None":
            yield node, "return None"
    for condition in node.ifs if isinstance(node, ast.comprehension) else [getattr(node, "test", None)]:
        if condition is not None:
            yield from ((condition, value) for value in ("True", "False") if ast.unparse(condition) != value)


def _drop_parts(node: ast.AST) -> Iterator[tuple[Part, str]]:
    match node:
        case ast.Break() | ast.Continue():
            yield node, "continue" if isinstance(node, ast.Break) else "break"
        case ast.AugAssign() | ast.Expr(ast.Call()) | ast.Assign([ast.Attribute() | ast.Subscript()]):
            yield node, "pass"
        case ast.Call(_, arguments, keywords) if len(arguments) + len(keywords) > 1:
            yield from ((keyword, "") for keyword in keywords if keyword.arg)


def draw(options: argparse.Namespace) -> list[Mutant]:
    """A sample of the mutants of the packages, or all of the given lines."""
    found: list[Mutant] = []
    for path in sorted((ROOT / "vicode").rglob("*.py")):
        file, source = path.relative_to(ROOT).as_posix(), path.read_bytes()
        if not LEFT_OUT.match(file) and any(file.startswith(f"vicode/{name}") for name in options.package or [""]):
            line_starts = [0, *(match.end() for match in re.finditer(rb"\n", source))]
            found += find_mutants(file, line_starts, ast.parse(source))
    if options.at:
        chosen = {each.removeprefix("./") for each in options.at}
        return [each for each in found if chosen & {each.file, f"{each.file}:{each.line}"} and each.compiles()]
    random.Random(options.seed).shuffle(found)
    return [mutant for mutant in found[: options.count * 2] if mutant.compiles()][: options.count]


def copy_checkout(target: Path) -> None:
    """Copy what git knows or would add. Bytecode is checked by content: mutants follow each other within a second."""
    names = subprocess.check_output(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, text=True).splitlines()
    for name in filter(lambda name: (ROOT / name).is_file(), names):
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, target / name)
    command = [sys.executable, "-m", "compileall", "-q", "--invalidation-mode", "checked-hash", "vicode"]
    subprocess.run(command, cwd=target, check=True)


def record_reach(target: Path, mutants: list[Mutant]) -> Reach:
    """Run the tests once with probes; tests that fail with them are left out."""
    insert_probes(target, mutants)
    command = [sys.executable, "-m", "pytest", "-q", "-m", FAST, "--durations=0", "--durations-min=0", "-n", "2"]
    command += ["--dist", "loadfile", "--ignore=tests/architecture"]
    environment = {**os.environ, "PYTHONPATH": str(target)}
    run = subprocess.run(command, cwd=target, env=environment, stdout=subprocess.PIPE, text=True, check=False)
    seconds, setups = read_durations(run.stdout)
    for failed in re.findall(r"^(?:FAILED|ERROR) (.*?)(?: - .*)?$", run.stdout, re.MULTILINE):
        seconds.pop(failed, None)
    hits = defaultdict[str, set[str]](set)
    for line in (target / "hits").read_text(encoding="utf-8").splitlines():
        site, _tab, current = line.partition("\t")
        test, _space, phase = current.rpartition(" ")
        # What a fixture prepares may serve all tests of a file.
        file = test.partition("::")[0]
        hits[site] |= {test} if phase == "(call)" else {each for each in seconds if each.startswith(f"{file}::")}
    return Reach(hits, seconds, setups)


def read_durations(output: str) -> tuple[dict[str, float], dict[str, float]]:
    """The time of each test without its set-up, and the longest set-up of each file, as pytest reports them."""
    seconds, setups = defaultdict[str, float](float), defaultdict[str, float](float)
    for time, phase, test in re.findall(r"^([\d.]+)s (setup|call|teardown) +(.*)$", output, re.MULTILINE):
        if phase == "setup":
            file = test.partition("::")[0]
            setups[file] = max(setups[file], float(time))
        else:
            seconds[test] += float(time)
    return seconds, setups


def insert_probes(target: Path, mutants: list[Mutant]) -> None:
    """Put a call before each mutated statement, and into each function of their files."""
    (target / "mutant_probe.py").write_text(PROBE)
    for file in {mutant.file for mutant in mutants}:
        tree = ast.parse((target / file).read_bytes())
        lines = {mutant.statement for mutant in mutants if mutant.file == file}
        nodes = list(ast.walk(tree))
        bodies: Iterator[Any] = (
            getattr(node, name, None) for node in nodes for name in ("body", "orelse", "finalbody")
        )
        for body in filter(lambda body: isinstance(body, list), bodies):
            for statement in [each for each in body if each.lineno in lines]:
                body.insert(body.index(statement), _probe(f"{file}:{statement.lineno}"))
        for node in nodes:
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                node.body.insert(1 if ast.get_docstring(node) else 0, _probe(file))
        (target / file).write_text(ast.unparse(ast.fix_missing_locations(tree)), encoding="utf-8")


def _probe(site: str) -> ast.stmt:
    return ast.parse(f"__import__('mutant_probe').hit({site!r})").body[0]


def choose_tests(mutant: Mutant, reach: Reach, budget_s: float) -> list[list[str]]:
    """The tests that reach a mutant, of its package and then others, quick ones first, as many as the budget allows."""
    package = f"/{mutant.file.split('/')[1].removesuffix('.py')}/"
    reaching = reach.hits.get(f"{mutant.file}:{mutant.statement}") or reach.hits.get(mutant.file, set())
    known = sorted(reaching & reach.seconds.keys(), key=lambda test: (_cost(test, reach, set()), test))
    return [list(_take([test for test in known if (package in test) is own], reach, budget_s)) for own in (True, False)]


def _cost(test: str, reach: Reach, prepared: set[str]) -> float:
    """The seconds of a test, with the set-up of its file unless that is prepared."""
    file = test.partition("::")[0]
    return reach.seconds[test] + (0 if file in prepared else reach.setups.get(file, 0))


def _take(tests: Iterable[str], reach: Reach, budget_s: float) -> Iterator[str]:
    prepared, left_s = set[str](), budget_s
    for test in tests:
        cost = _cost(test, reach, prepared)
        if cost <= left_s:
            left_s -= cost
            prepared.add(test.partition("::")[0])
            yield test


def try_mutant(target: Path, mutant: Mutant, groups: list[list[str]], limit_s: int) -> Outcome:
    """Run groups of tests until one kills the mutant; another end counts only if none does."""
    outcome = Outcome.SURVIVED
    for tests in filter(None, groups):
        (target / mutant.file).write_bytes(mutant.apply())
        found = run_tests(target, tests, limit_s)
        shutil.copy2(ROOT / mutant.file, target / mutant.file)
        if found is Outcome.KILLED:
            return found
        outcome = outcome if found is Outcome.SURVIVED else found
    return outcome


def run_tests(target: Path, tests: list[str], limit_s: int) -> Outcome:
    """Run tests in a copy of the checkout, for `limit_s` seconds of CPU time and 5 times as long by the clock."""
    child = os.fork()
    if not child:
        _run_tests(target, tests, limit_s)
    _pid, status = os.waitpid(child, 0)
    with suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)
    if os.WIFSIGNALED(status):
        limits = {signal.SIGXCPU, signal.SIGALRM, signal.SIGKILL}
        return Outcome.LIMIT if os.WTERMSIG(status) in limits else Outcome.KILLED
    match os.waitstatus_to_exitcode(status):
        case pytest.ExitCode.OK:
            return Outcome.SURVIVED
        case pytest.ExitCode.TESTS_FAILED | pytest.ExitCode.INTERRUPTED:  # The latter: an error of a module of tests.
            return Outcome.KILLED
    return Outcome.NOT_RUN


def _run_tests(target: Path, tests: list[str], limit_s: int) -> NoReturn:
    code: int = pytest.ExitCode.INTERNAL_ERROR
    try:
        os.setsid()
        os.chdir(target)
        os.environ.update(PYTHONPATH=str(target), VICODE_HYPOTHESIS="mutants")
        sys.path[:] = [str(target), *(path for path in sys.path if path not in {"", str(ROOT)})]
        resource.setrlimit(resource.RLIMIT_CPU, (limit_s, limit_s + 5))
        signal.alarm(5 * limit_s)
        output = os.open(target / "output", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(output, 1)
        os.dup2(output, 2)
        options = ["-x", "-q", "-n", "0", "-m", FAST, "-W", "ignore::pytest.PytestAssertRewriteWarning"]
        code = pytest.main([*options, *tests])
    finally:
        os._exit(code)


def main() -> None:
    """Draw mutants, try each, print the survivors and the counts."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--package", action="append", help="such as store or editor/session; default: all")
    parser.add_argument(
        "--at", action="append", metavar="FILE[:LINE]", help="all mutants of a line or file, instead of a sample"
    )
    parser.add_argument("--tests", nargs="+", help="try these tests, without looking for those that reach")
    parser.add_argument("--budget", type=float, default=30, help="seconds of tests of its package, and of others")
    parser.add_argument("--limit", type=int, default=110, help="seconds of CPU time of either")
    options = parser.parse_args()
    mutants, reach, counts = draw(options), None, Counter[Outcome]()
    if not options.tests:
        with tempfile.TemporaryDirectory() as folder:
            copy_checkout(Path(folder))
            reach = record_reach(Path(folder), mutants)
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder)
        copy_checkout(target)
        if options.tests and (found := run_tests(target, options.tests, options.limit)) is not Outcome.SURVIVED:
            sys.exit(f"Without a mutant, the tests are {found}:\n{(target / 'output').read_text()}")
        for mutant in mutants:
            groups = choose_tests(mutant, reach, options.budget) if reach else [options.tests]
            found = try_mutant(target, mutant, groups, options.limit)
            counts[found] += 1
            if found is not Outcome.KILLED:
                print(f"{found.capitalize()} ({sum(map(len, groups))} tests): {mutant.describe()}", flush=True)
    print(f"{len(mutants)} mutants: {', '.join(f'{counts[each]} {each}' for each in Outcome)}.")


if __name__ == "__main__":
    main()
