"""Describes the first difference of two traces, with both side by side."""

from collections.abc import Mapping, Sequence

from vicode.conformance.traces import TraceDifference, TraceIteration, TraceStep

TITLES = {"python": "Python", "cpp": "C++", "xabsl": "XABSL", "simulator": "simulator"}
_CONTEXT = 2


def describe(found: TraceDifference, traces: Mapping[str, Sequence[TraceIteration]]) -> str:
    """Describe a difference of the traces of two languages; the iterations before it are also listed."""
    left, right = traces
    iteration = next((each[found.index] for each in traces.values() if found.index < len(each)), None)
    place = f"iteration {iteration.number}, {iteration.time_ns / 1e9:.3f} s" if iteration else "the end"
    robot = f", robot {iteration.robot}" if iteration and iteration.robot else ""
    subject = f"{found.component}: " if found.component else ""
    values = [f"{TITLES[language]} {value or '–'}" for language, value in zip(traces, found.values, strict=True)]
    lines = [
        f"{TITLES[left]} and {TITLES[right]} differ in {place}{robot}",
        f"  {subject}{found.field}: {', '.join(values)}",
    ]
    columns = [[f"{TITLES[language]}", *_lines(trace, found.index)] for language, trace in traces.items()]
    height = max(map(len, columns))
    padded = [column + [""] * (height - len(column)) for column in columns]
    width = max(map(len, padded[0]))
    for one, other in zip(*padded, strict=True):
        mark = "≠" if one != other and one not in TITLES.values() else " "
        lines.append(f"  {one:<{width}} {mark} {other}".rstrip())
    return "\n".join(lines)


def _lines(trace: Sequence[TraceIteration], index: int) -> list[str]:
    lines = []
    for iteration in trace[max(0, index - _CONTEXT) : index + 1]:
        lines.append(f"iteration {iteration.number}, {iteration.time_ns / 1e9:.3f} s")
        lines += [f"  {name}={value}" for name, value in sorted(iteration.shared.items())]
        lines += [f"  error in {component}" for component in iteration.errors]
        for step in iteration.steps:
            lines += _step_lines(step)
    return lines


def _step_lines(step: TraceStep) -> list[str]:
    parts = {name: value for name, value in step.fields.items() if name not in ("by", "link")}
    state = parts.pop("state", "")
    lines = [f"  {step.component} {state}".rstrip()]
    defaults = {"worked": "true", "changed_from": "", "transition": "", "done": "false"}
    values = [
        f"{name.partition('.')[2] or name}={value}" for name, value in parts.items() if defaults.get(name) != value
    ]
    return lines + [f"    {', '.join(values[start : start + 4])}" for start in range(0, len(values), 4)]
