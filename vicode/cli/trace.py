"""Statistics of traces, their properties, the differences of two of them, and export to MCAP."""

import argparse
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.findings import escape_text

if TYPE_CHECKING:
    from vicode.analysis.machines import MachineAnalysis
    from vicode.runs.property_check import PropertyResult
    from vicode.traces.statistics import RunHistory, StateStatistics

_IMPOSSIBLE = "  it cannot occur"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the commands of `vicode trace`."""
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, add, act in (
        ("stats", _add_stats, _stats),
        ("check", _add_check, _check),
        ("diff", _add_diff, _diff),
        ("export", _add_export, _export),
    ):
        summary = (act.__doc__ or "").split("\n")[0]
        command = commands.add_parser(name, help=summary, description=summary)
        add(command)
        command.set_defaults(act=act)


def run(args: argparse.Namespace) -> int:
    act: Callable[[argparse.Namespace], int] = args.act
    return act(args)


def _add_stats(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("traces", metavar="TRACE", nargs="+", help="traces, or names of records of robots")
    add("--design", metavar="PATH", help="design or folder: also list what was never entered or taken")
    add("--component", metavar="NAME", help="only this component")
    add("--svg", metavar="FILE", help="draw the numbers on the diagram of the design; needs --design")


def _add_check(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("traces", metavar="TRACE", nargs="+", help="traces, or names of records of robots")
    parser.add_argument("--design", metavar="PATH", default=".", help="design or folder (default: the current folder)")


def _add_diff(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("first", metavar="A", help="a trace, or the name of a robot's record")
    parser.add_argument("second", metavar="B", help="the trace or record to compare it with")
    parser.add_argument(
        "--tolerance",
        type=options.seconds,
        default=0.0,
        metavar="S",
        help="how long states may differ, in seconds (default: 0)",
    )


def _add_export(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("trace", metavar="TRACE", help="a trace, or the name of a robot's record")
    parser.add_argument(
        "--mcap", metavar="FILE", required=True, help="the file to write; needs the extra vicode-fsm[mcap]"
    )


def _stats(args: argparse.Namespace) -> int:
    """Count how often states and transitions occurred, and how long states were active."""
    from vicode.traces.statistics import sum_states

    if args.svg and not args.design:
        raise OSError("--svg draws on the diagram of a design; give it with --design")
    histories = _read_runs(args.traces)
    states = sum_states(histories)
    transitions = sum((history.transitions for history in histories), Counter[tuple[str, str, str, str]]())
    if args.component and args.component not in states:
        raise OSError(f"no trace has states of {args.component}; known are {', '.join(states)}")
    components = [args.component] if args.component else list(states)
    designs = _find_designs(args.design, components) if args.design else {}
    seconds = sum(history.duration_ns for history in histories) / 1e9
    print(f"{len(histories)} run{'s' * (len(histories) != 1)}, {seconds:.2f} s")
    for component in components:
        own = {key[1:]: count for key, count in transitions.items() if key[0] == component}
        _print_component(component, states[component], own, designs.get(component))
    if args.svg:
        _draw(args, components[0], states, transitions, designs)
    return 0


def _check(args: argparse.Namespace) -> int:
    """Check the properties of the designs, and what is assumed of their inputs, in recorded runs."""
    from vicode.runs.property_check import PropertyCheck
    from vicode.services.project_loader import load_projects
    from vicode.traces.reader import TraceError, open_runs

    projects = [each.open_project.project for each in load_projects([args.design])]
    is_broken, count = False, 0
    try:
        for run in open_runs(map(Path, args.traces)):
            checks = [PropertyCheck(project) for project in projects]
            first_ns = None
            for iteration in run.iterations():
                first_ns = iteration.time_ns if first_ns is None else first_ns
                for check in checks:
                    check.observe(iteration)
            results = [result for check in checks for result in check.results]
            count = max(count, len(results))
            if len(args.traces) > 1:
                _print(f"{run.files[0]}:")
            for result in results:
                is_broken = is_broken or bool(result.broken_ns)
                _print(describe_result(result, first_ns or 0))
    except TraceError as error:
        raise OSError(f"{error}") from error
    if not count:
        raise OSError(f"{args.design}: no design has properties, and nothing is assumed of a component")
    return int(is_broken)


def _diff(args: argparse.Namespace) -> int:
    """Compare the states of two runs by time."""
    from vicode.traces.statistics import StateStatistics, find_difference, sum_states

    first, second = _read(args.first), _read(args.second)
    sums = sum_states([first]), sum_states([second])
    names = sorted({(component, state) for each in sums for component, states in each.items() for state in states})
    width = max((len(f"{component} {state}") for component, state in names), default=10)
    print(f"{'':{width}}  {'A times':>8} {'A s':>10}  {'B times':>8} {'B s':>10}  {'B - A s':>10}")
    for component, state in names:
        a, b = (each.get(component, {}).get(state, StateStatistics()) for each in sums)
        figures = f"{a.entries:8} {a.total_ns / 1e9:10.2f}  {b.entries:8} {b.total_ns / 1e9:10.2f}"
        _print(f"{f'{component} {state}':{width}}  {figures}  {(b.total_ns - a.total_ns) / 1e9:+10.2f}")
    found = find_difference(first, second, round(args.tolerance * 1e9))
    if found is None:
        shorter = min(first.duration_ns, second.duration_ns) / 1e9
        print(f"same states for {shorter:.2f} s")
        return 0
    states = f"{found.first or 'not active'} in A, {found.second or 'not active'} in B"
    _print(f"first difference: {found.time_ns / 1e9:.3f} s, {found.component}: {states}")
    return 1


def _export(args: argparse.Namespace) -> int:
    """Write a trace as MCAP, for viewers such as Foxglove."""
    from vicode.traces.mcap_export import export_mcap
    from vicode.traces.reader import TraceError, open_trace

    try:
        count = export_mcap(open_trace(Path(args.trace)).iterations(), Path(args.mcap))
    except TraceError as error:
        raise OSError(f"{args.trace}: {error}") from error
    print(f"wrote {args.mcap}, {count} messages")
    return 0


def _read(path: str) -> "RunHistory":
    from vicode.traces.reader import TraceError, open_trace
    from vicode.traces.statistics import read_history

    try:
        return read_history(open_trace(Path(path)).iterations())
    except TraceError as error:
        raise OSError(f"{path}: {error}") from error


def _read_runs(paths: Sequence[str]) -> "list[RunHistory]":
    from vicode.traces.reader import TraceError, open_runs
    from vicode.traces.statistics import read_history

    try:
        return [read_history(run.iterations()) for run in open_runs(map(Path, paths))]
    except TraceError as error:
        raise OSError(f"{error}") from error


def _find_designs(path: str, components: Sequence[str]) -> "dict[str, MachineAnalysis]":
    from vicode.analysis.machines import MachineAnalysis
    from vicode.services.project_loader import load_projects

    found: dict[str, MachineAnalysis] = {}
    for opened in load_projects([path]):
        project = opened.open_project.project
        designs = (each for each in project.designs if each.component in components)
        found |= {each.component: MachineAnalysis(project, each) for each in designs}
    if not found:
        raise OSError(f"{path} has no design of {', '.join(components)}")
    return found


def describe_result(result: "PropertyResult", first_ns: int) -> str:
    """What a run says about a property, in a line; times are relative to the first iteration."""
    subject = f"{result.component}: {result.phrase}"
    if result.unknown and not result.broken_ns and not result.kept:
        return f"{'no values':>16}  {subject}; record with --values"
    if not result.broken_ns:
        return f"{'kept':>7} {result.kept:6} ×  {subject}" if result.kept else f"{'not tested':>16}  {subject}"
    at = (result.broken_ns[0] - first_ns) / 1e9
    return f"{'BROKEN':>7} {len(result.broken_ns):6} ×  {subject}; first at {at:.2f} s"


def _print(line: str) -> None:
    """Print a line with names of a trace, which may be from elsewhere."""
    print(escape_text(line))


def _print_component(
    component: str,
    states: "dict[str, StateStatistics]",
    transitions: dict[tuple[str, str, str], int],
    machine: "MachineAnalysis | None",
) -> None:
    whole_ns = sum(each.total_ns for each in states.values()) or 1
    ends: Counter[str] = Counter()
    for (source, target, _given), count in transitions.items():
        ends[f"{source} → {target}"] += count
    never = [each.name for each in machine.design.states if each.name not in states] if machine is not None else []
    width = max(len(name) for name in ("transition", *states, *ends, *never))
    print()
    _print(component)
    print(f"  {'state':{width}} {'entered':>8} {'total s':>10} {'share':>6} {'longest s':>10}")
    for name, each in sorted(states.items(), key=lambda item: -item[1].total_ns):
        share = f"{each.total_ns / whole_ns:.0%}"
        _print(
            f"  {name:{width}} {each.entries:8} {each.total_ns / 1e9:10.2f} {share:>6} {each.longest_ns / 1e9:10.2f}"
        )
    for name in never:
        _print(f"  {name:{width}} {'never':>8}{'' if machine and name in machine.reachable else _IMPOSSIBLE}")
    print(f"  {'transition':{width}} {'taken':>8}")
    for words, count in ends.most_common():
        _print(f"  {words:{width}} {count:8}")
    if machine is not None:
        from vicode.services.transition_counts import list_never_taken

        for words, is_possible in list_never_taken(machine, transitions):
            _print(f"  {words:{width}} {'never':>8}{'' if is_possible else _IMPOSSIBLE}")


def _draw(
    args: argparse.Namespace,
    component: str,
    states: "dict[str, dict[str, StateStatistics]]",
    transitions: Counter[tuple[str, str, str, str]],
    designs: "dict[str, MachineAnalysis]",
) -> None:
    from vicode.diagram.heat_map import StateHeat, render_heat_map
    from vicode.diagram.svg import write_svg
    from vicode.output import write_atomically
    from vicode.services.transition_counts import count_by_path

    machine = designs.get(component)
    if machine is None:
        raise OSError(f"{args.design} has no design of {component}; choose another with --component")
    design = machine.design
    heat = {
        name: StateHeat(entries=each.entries, total_s=each.total_ns / 1e9, longest_s=each.longest_ns / 1e9)
        for name, each in states[component].items()
    }
    own = {key[1:]: count for key, count in transitions.items() if key[0] == component}
    image = render_heat_map(design, heat, count_by_path(design, own))
    write_atomically(Path(args.svg), write_svg(image).encode())
    print(f"\nwrote {args.svg}")
