"""Random edits of random designs: what is read back from their generated code is neither lost nor invented."""

import tempfile
from dataclasses import replace
from pathlib import Path

from hypothesis import Phase, assume, given, settings
from hypothesis import strategies as st

from tests.generators.sound_designs import actions, docs, guards, numbers, passages, project_of, sound_designs
from tests.sync.patches import apply_patch
from vicode.check import check_project
from vicode.findings import Severity
from vicode.generators import component_generator
from vicode.model.design import Design, State, Transition
from vicode.model.edits import rename_state, replace_decision, update_decisions, update_state
from vicode.model.project import Project
from vicode.model.traversal import iter_decisions
from vicode.sync.interpret import interpret_edits
from vicode.sync.interpret.leftover import with_bodies
from vicode.sync.interpret.verification import is_same_program
from vicode.sync.same_code import is_same_code

KINDS = (
    "guard",
    "target",
    "decision doc",
    "added transition",
    "removed decision",
    "state doc",
    "component doc",
    "requirements",
    "final",
    "enter",
    "actions",
    "leave",
    "frequency",
    "resume",
    "initial value",
    "rename",
)


@st.composite
def edited_designs(draw: st.DrawFn, kinds: tuple[str, ...] = KINDS) -> tuple[str, Design, Design]:
    """Draw a design and one edit of it, with the kind of the edit."""
    design, kind = draw(sound_designs()), draw(st.sampled_from(kinds))
    located = list(iter_decisions(design))
    state = draw(st.sampled_from(design.states))
    if kind in ("guard", "target", "decision doc", "removed decision"):
        assume(located)
        return kind, design, _with_edited_decision(draw, design, kind)
    return kind, design, _with_edited_state(draw, design, state, kind)


def _with_edited_decision(draw: st.DrawFn, design: Design, kind: str) -> Design:
    located = draw(st.sampled_from(list(iter_decisions(design))))
    decision = located.decision
    match kind:
        case "guard":
            guard = replace(draw(guards), code=decision.guard.code)
            return replace_decision(design, located.path, replace(decision, guard=guard))
        case "target":
            assume(isinstance(decision, Transition))
            assert isinstance(decision, Transition)
            to = draw(st.sampled_from([state.name for state in design.states]))
            return replace_decision(design, located.path, replace(decision, to=to))
        case "decision doc":
            return replace_decision(design, located.path, replace(decision, doc=draw(docs)))
        case _:
            return update_decisions(
                design, located.path[:-1], lambda items: tuple(item for item in items if item is not decision)
            )


def _with_edited_state(draw: st.DrawFn, design: Design, state: State, kind: str) -> Design:
    name = state.name
    match kind:
        case "added transition":
            new = Transition(to=draw(st.sampled_from(design.states)).name, guard=replace(draw(guards), code=None))
            at = draw(st.integers(0, len(state.transitions)))
            return update_state(
                design,
                name,
                lambda old: replace(old, transitions=(*old.transitions[:at], new, *old.transitions[at:])),
            )
        case "state doc":
            changes: dict[str, object] = {"doc": draw(docs)}
        case "requirements":
            changes = {"requires": draw(st.sampled_from([(), ("eyes",), ("legs", "eyes")]))}
        case "final":
            changes = {"final": not state.final}
        case "enter" | "leave":
            changes = {kind: draw(passages)}
        case "actions":
            changes = {"actions": draw(actions)}
        case "rename":
            return rename_state(design, name, draw(st.sampled_from(["Other", "look_2", "B_2"])))
        case _:
            return _with_edited_component(draw, design, kind)
    return update_state(design, name, lambda old: replace(old, **changes))  # type: ignore[arg-type]


def _with_edited_component(draw: st.DrawFn, design: Design, kind: str) -> Design:
    match kind:
        case "initial value":
            first, *others = design.variables
            return replace(design, variables=(replace(first, initial=draw(numbers)), *others))
        case "component doc":
            return replace(design, doc=draw(docs))
        case "frequency":
            return replace(design, frequency_hz=draw(st.sampled_from([None, 5.0, 0.5])))
        case _:
            return replace(design, resume=not design.resume)


def is_sound(project: Project) -> bool:
    return not any(finding.severity is Severity.ERROR for finding in check_project(project))


def text_of(project: Project, design: Design) -> str | None:
    code = component_generator(project, "python", {})(design)
    return code.file.text if code else None


def interpret_back(kind: str, design: Design, edited: Design) -> bool:
    """Check that code and patch give the edited code; return whether all of it was understood."""
    project, other = project_of(design), project_of(edited)
    assume(is_sound(project) and is_sound(other))
    before, after = text_of(project, design), text_of(other, edited)
    assume(before is not None and after is not None and before != after)
    assert before is not None
    assert after is not None
    result = interpret_edits(project, design.component, generated=before, edited=after)
    result_text = text_of(project_of(result.design), result.design)
    assert result_text is not None
    assert is_sound(project_of(result.design))
    if not result.leftover:
        assert is_equivalent(result_text, after, before), kind
        return True
    with tempfile.TemporaryDirectory() as folder:
        patched = apply_patch(result_text, result.leftover, Path(folder))
    assert is_equivalent(patched, after, before), kind
    return False


def is_equivalent(result: str, after: str, before: str) -> bool:
    """Whether two texts are the same code; actions that were added may be methods of their own.

    A region of `before` with another body in `after` counts as an edit of the region, which others apply.
    """
    return is_same_code(result, after) or is_same_program(result, with_bodies(after, before))


# Shrinking would generate thousands of times.
few = settings(
    max_examples=max(10, settings.default.max_examples // 10), phases=[Phase.explicit, Phase.reuse, Phase.generate]
)


@few
@given(edited_designs())
def test_no_edit_is_lost_or_invented(case: tuple[str, Design, Design]) -> None:
    interpret_back(*case)


@few
@given(edited_designs(("requirements", "final", "frequency", "resume")))
def test_simple_edits_are_understood(case: tuple[str, Design, Design]) -> None:
    assert interpret_back(*case)
