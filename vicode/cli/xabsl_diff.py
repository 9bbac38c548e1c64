"""Runs two versions of an XABSL behavior on the same inputs and shows the first difference."""

import argparse
import sys
from collections.abc import Iterator, Mapping
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vicode.bica import options
from vicode.cli.source_encoding import add_encoding_argument
from vicode.cli.xabsl_behavior import print_behavior_findings
from vicode.services.xabsl_encoding import find_encoding

if TYPE_CHECKING:
    from vicode.xabsl.version_comparison import BehaviorVersion, Row, VersionDifference

_RANDOM = "random"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("old", metavar="OLD.xabsl", type=Path, help="XABSL file with the agents of the old version")
    add("new", metavar="NEW.xabsl", type=Path, help="XABSL file with the agents of the new version")
    add("--inputs", metavar="CSV", default=_RANDOM, help="inputs, one row per cycle (default: random)")
    add("--seed", type=int, default=0, metavar="N", help="seed of random inputs (default: 0)")
    add_encoding_argument(parser)
    add("--cycles", type=options.count, default=500, metavar="N", help="number of random cycles (default: 500)")


def run(args: argparse.Namespace) -> int:
    """Compare the versions; return 1 if they differ, 2 if they cannot run."""
    from vicode.xabsl.engine import LoadError, ReplayError

    versions = [_load(path, find_encoding(path, args.encoding)) for path in (args.old, args.new)]
    old, new = versions
    if old is None or new is None:
        return 2
    try:
        return _compare(args, old, new)
    except LoadError as error:
        for problem in error.problems:
            print(f"vicode: {problem}", file=sys.stderr)
        return 2
    except (ReplayError, UnicodeDecodeError) as error:
        print(f"{args.inputs}: {error}", file=sys.stderr)
        return 2


def _load(agents: Path, encoding: str) -> "BehaviorVersion | None":
    from vicode.xabsl.behavior_loader import load_behavior
    from vicode.xabsl.compiler import compile_source
    from vicode.xabsl.version_comparison import BehaviorVersion

    source = load_behavior(agents, encoding)
    compiled = compile_source(source)
    if compiled.program is None:
        print_behavior_findings([each for each in compiled.findings if each.severity == "error"], agents, encoding)
        return None
    return BehaviorVersion(source, compiled)


def _compare(args: argparse.Namespace, old: "BehaviorVersion", new: "BehaviorVersion") -> int:
    from vicode.xabsl.version_comparison import compare_versions

    count, visited = 0, set[tuple[str, str]]()
    for name, rows in _runs(args, old, new):
        count += len(rows)
        found = compare_versions(old, new, rows, visited)
        if found is not None:
            print("\n".join(_describe(found, name, (args.old.as_posix(), args.new.as_posix()))))
            return 1
    source = f"seed {args.seed}" if args.inputs == _RANDOM else args.inputs
    print(
        f"both versions agree in {count} cycle{'' if count == 1 else 's'} ({source}); "
        f"{len(visited)} of {old.state_count} states were active"
    )
    return 0


def _runs(
    args: argparse.Namespace, old: "BehaviorVersion", new: "BehaviorVersion"
) -> "Iterator[tuple[str, list[Row]]]":
    """The rows of each run: those of the file, or random ones for each agent that both versions have."""
    from vicode.xabsl.engine.replay import read_rows
    from vicode.xabsl.version_comparison import random_rows

    if args.inputs != _RANDOM:
        yield "", read_rows(Path(args.inputs).read_text(encoding="utf-8").splitlines())
        return
    for agent in dict.fromkeys((*old.agents, *new.agents)):
        if agent in old.agents and agent in new.agents:
            yield agent, list(random_rows((old, new), agent, cycles=args.cycles, seed=args.seed))
        else:
            print(f"agent {agent} is only in {(args.old if agent in old.agents else args.new).as_posix()}")


def _describe(found: "VersionDifference", agent: str, titles: tuple[str, str]) -> Iterator[str]:
    where = f"agent {agent}, " if agent else ""
    yield f"{where}cycle {found.cycle}, {found.time_ms / 1000:.3f} s: {_subject(found)}"
    for title, value in zip(titles, found.values, strict=True):
        yield f"  {title}: {value or '–'}"
    inputs = ", ".join(f"{'*' * (name in found.changed)}{name}={value}" for name, value in sorted(found.inputs.items()))
    yield f"  inputs (* set in this cycle): {inputs or 'none'}"
    columns = [[line for step in record["tree"] for line in _step_lines(step)] for record in found.records]
    width = max(len(line) for line in (titles[0], *columns[0]))
    yield f"  {titles[0]:<{width}}   {titles[1]}"
    for left, right in zip_longest(*columns, fillvalue=""):
        yield f"  {left:<{width}} {'≠' if left != right else ' '} {right}".rstrip()


def _subject(found: "VersionDifference") -> str:
    words = {
        "active": "the active options and basic behaviors differ",
        "agent": "the agents differ",
        "errors": "the messages of the engine differ",
        "state": f"the state of {found.component} differs",
        "changed_from": f"the previous state of {found.component} differs",
    }
    section, _dot, name = found.field.partition(".")
    known = {"parameters": f"parameter {name} of {found.component} differs", "values": f"{name} differs"}
    fallback = f"{found.field.removesuffix('_ns')} of {found.component} differs"
    return words.get(found.field) or known.get(section) or fallback


def _step_lines(step: Mapping[str, Any]) -> Iterator[str]:
    before = f" (from {step['changed_from']})" if step["changed_from"] else ""
    arguments = ", ".join(f"{name}={value}" for name, value in step["parameters"].items())
    call = f"({arguments})" if arguments else ""
    state = f" {step['state']}{before}, {step['state_time_ns'] / 1e9:.3f} s" if step["state"] else ""
    yield f"{step['component']}{call}{state}"
    yield from (f"  {name}={value}" for name, value in (step.get("values") or {}).items())
