"""Rules for the properties of a design: what is promised and not kept."""

from collections.abc import Iterable, Iterator

from vicode.analysis.properties import Judgement, PropertyVerdict, judge_properties
from vicode.analysis.walk import WalkStep
from vicode.check import find_design_errors
from vicode.findings import Finding, FindingSubject, FoundRun, get_rule
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.model.words import describe_property

_MOST_CHANGES = 8


def find_broken_properties(project: Project, design: Design) -> Iterator[Finding]:
    """D441, D442: properties that a run breaks, or about which nothing certain is known."""
    if not design.properties:
        return
    errors = {each.subject.path[:2] for each in find_design_errors(project, design) if each.subject}
    for index, judged in enumerate(judge_properties(project, design)):
        if ("properties", index) in errors:
            continue
        subject = FindingSubject(component=design.component, path=("properties", index))
        phrase = describe_property(judged.promised)
        if judged.verdict is PropertyVerdict.FAILS:
            message = f"'{phrase}' does not hold: {describe_run(judged.steps)}"
            fix = "change the behavior or the property"
            run = describe_steps(design.component, judged.steps)
            yield Finding(rule=get_rule("D441"), message=message, fix=fix, subject=subject, run=run)
        elif judged.verdict is PropertyVerdict.UNDECIDED:
            message = f"'{phrase}' is not proved{_explain(judged)}"
            fix = "watch it in runs: vicode run, vicode trace check"
            yield Finding(rule=get_rule("D442"), message=message, fix=fix, subject=subject)


def describe_judgement(judged: Judgement) -> str:
    """What is known about a property, in words."""
    words = _describe_verdict(judged)
    return f"{words} ({', '.join(judged.basis.facts)})" if judged.basis.facts else words


def _describe_verdict(judged: Judgement) -> str:
    match judged.verdict:
        case PropertyVerdict.GUARANTEED if judged.at_most_ns:
            return f"guaranteed, after at most {judged.at_most_ns / 1e9:g} s"
        case PropertyVerdict.GUARANTEED:
            return "guaranteed"
        case PropertyVerdict.FAIR if not judged.lasso:
            return "the guards alone do not exclude a way"
        case PropertyVerdict.FAIR:
            return f"not if the robot remains forever in, for example: {' → '.join(judged.lasso)}"
        case PropertyVerdict.FOUND:
            return "a way was found from each state"
        case PropertyVerdict.FAILS:
            return f"does not hold: {describe_run(judged.steps)}"
        case PropertyVerdict.UNDECIDED:
            return "not proved; check --deep also looks for a run that breaks it"


def _explain(judged: Judgement) -> str:
    if judged.at_most_ns is not None:
        return f": it may take {judged.at_most_ns / 1e9:g} s"
    return f": {' → '.join(judged.lasso)} may be possible" if judged.lasso else ""


def describe_steps(component: str, steps: Iterable[WalkStep]) -> FoundRun:
    """The steps of a run as a finding has them."""
    return FoundRun(
        component=component,
        steps=tuple((step.time_ns, tuple((*key, value) for key, value in step.inputs.items())) for step in steps),
    )


def describe_run(steps: tuple[WalkStep, ...]) -> str:
    """The states of a run with the times at which they were entered, and the last inputs."""
    entered = [
        step for before, step in zip((None, *steps), steps, strict=False) if not before or before.state != step.state
    ]
    texts = [f"{step.state} at {step.time_ns / 1e9:g} s" for step in entered]
    texts = texts if len(texts) <= _MOST_CHANGES else [*texts[:2], "…", *texts[3 - _MOST_CHANGES :]]
    end = "" if not steps or steps[-1] is entered[-1] else f" until {steps[-1].time_ns / 1e9:g} s"
    return f"{', '.join(texts)}{end}"
