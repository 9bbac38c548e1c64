"""Describes the first difference of two traces, with both side by side."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import zip_longest
from typing import Any

from vicode.conformance.inputs import ConformanceRun, InputKey
from vicode.conformance.result import LANGUAGE_TITLES, IterationInput, LanguageDifference, TraceCell
from vicode.conformance.traces import TraceDifference, TraceIteration, TraceStep

_CONTEXT = 2
_NOTHING = TraceCell(text="")


def explain(
    found: TraceDifference,
    traces: Mapping[str, Sequence[TraceIteration]],
    run: ConformanceRun | None = None,
    number: int = 0,
) -> LanguageDifference:
    """Collect what shows a difference of the traces of two languages, with the iterations before it.

    Args:
        found: The difference.
        traces: The traces by language.
        run: The run, whose inputs are listed.
        number: The number of the run.
    """
    left, right = traces
    iteration = next((each[found.index] for each in traces.values() if found.index < len(each)), None)
    one, other = (list(_cells(trace, found.index)) for trace in traces.values())
    return LanguageDifference(
        languages=(left, right),
        run=number,
        iteration=iteration.number if iteration else 0,
        time_ns=iteration.time_ns if iteration else 0,
        component=found.component,
        field=found.field,
        values=found.values,
        inputs=tuple(_inputs(run, iteration.number - 1, iteration.robot)) if run and iteration else (),
        rows=tuple(zip_longest(one, other, fillvalue=_NOTHING)),
    )


def describe(difference: LanguageDifference) -> str:
    """Describe a difference in lines of text."""
    titles = [LANGUAGE_TITLES[language] for language in difference.languages]
    place = f"iteration {difference.iteration}, {difference.time_ns / 1e9:.3f} s" if difference.iteration else "the end"
    subject = f"{difference.component}: " if difference.component else ""
    values = [f"{title} {value or '–'}" for title, value in zip(titles, difference.values, strict=True)]
    lines = [f"{' and '.join(titles)} differ in {place}", f"  {subject}{difference.field}: {', '.join(values)}"]
    width = max(len(text) for text in (titles[0], *(left.text for left, _right in difference.rows)))
    lines.append(f"  {titles[0]:<{width}}   {titles[1]}")
    for left, right in difference.rows:
        mark = "≠" if left.text != right.text else " "
        lines.append(f"  {left.text:<{width}} {mark} {right.text}".rstrip())
    return "\n".join(lines)


def _inputs(run: ConformanceRun, index: int, robot: int) -> Iterator[IterationInput]:
    values: dict[InputKey, Any] = {each.key: each.initial for each in run.inputs}
    for step in run.steps[: index + 1]:
        values.update(step.inputs[robot])
    changed = run.steps[index].inputs[robot]
    for (component, name), value in values.items():
        text = str(value).lower() if isinstance(value, bool) else str(value)
        title = f"{component}.{name}" if component else name
        yield IterationInput(name=title, value=text, is_changed=(component, name) in changed)


def _cells(trace: Sequence[TraceIteration], index: int) -> Iterator[TraceCell]:
    for iteration in trace[max(0, index - _CONTEXT) : index + 1]:
        robot = f", robot {iteration.robot}" if iteration.robot else ""
        yield TraceCell(text=f"iteration {iteration.number}, {iteration.time_ns / 1e9:.3f} s{robot}")
        for name, value in sorted(iteration.shared.items()):
            yield TraceCell(text=f"  {name}={value}")
        for component in iteration.errors:
            yield TraceCell(text=f"  error in {component}")
        for step in iteration.steps:
            yield from _step_cells(step)


def _step_cells(step: TraceStep) -> Iterator[TraceCell]:
    parts = {name: value for name, value in step.fields.items() if name not in ("by", "link")}
    state = parts.pop("state", "")
    yield TraceCell(text=f"  {step.component} {state}".rstrip(), component=step.component, state=state)
    defaults = {"worked": "true", "changed_from": "", "transition": "", "done": "false"}
    values = [
        f"{name.partition('.')[2] or name}={value}" for name, value in parts.items() if defaults.get(name) != value
    ]
    for start in range(0, len(values), 4):
        yield TraceCell(text=f"    {', '.join(values[start : start + 4])}")
