"""The scene of a design: the items that the canvas draws, as JSON values with formatted texts."""

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable

from vicode.diagram.drawn_transitions import DrawnTransition, draw_transitions, has_work, has_written, shows_common
from vicode.diagram.frames import drawn_frames, frame_padding
from vicode.diagram.layered_layout import complete_layout, note_position
from vicode.diagram.node_geometry import note_lines, note_size
from vicode.editor.view.scene_types import (
    Scene,
    SceneCommon,
    SceneComponent,
    SceneDesignState,
    SceneFrame,
    SceneLink,
    SceneMarks,
    SceneNote,
    ScenePlace,
    SceneTransition,
)
from vicode.editor.view.selection import ItemRef, item_at_path
from vicode.findings import DesignPath, Finding, Severity, worst_severity
from vicode.model.design import COMMON, Call, DecisionGroup, Design, DiagramNote, Guard, Point, State, Transition, Use
from vicode.model.guard_text import write_guard
from vicode.model.project import Project
from vicode.model.traversal import find_decision

_DEAD = frozenset({"D421", "D423", "D433"})
_Findings = dict[ItemRef, list[Finding]]


def make_scene(
    project: Project,
    design: Design,
    findings: Iterable[Finding],
    rev: int,
    *,
    changed_outside: Collection[str] = (),
    unfinished: Collection[str] = (),
) -> Scene:
    """The scene of a design; `changed_outside` and `unfinished` are states that are marked so."""
    by_item: _Findings = defaultdict(list)
    findings = tuple(findings)
    for finding in findings:
        if finding.subject is not None and finding.subject.component == design.component:
            by_item[item_at_path(finding.subject.path)].append(finding)
    layout = complete_layout(design)
    transitions = draw_transitions(design)
    dead = _find_dead_paths(design, findings)
    return {
        "rev": rev,
        "component": design.component,
        "doc": design.doc,
        "states": [
            {
                **_state(design, state, by_item),
                **_at(layout.states[state.name]),
                "outside": state.name in changed_outside,
                "unfinished": state.name in unfinished,
                "dead": ("states", state.name) in dead and state.name not in unfinished,
            }
            for state in design.states
        ],
        "transitions": list(_transitions(design, transitions, by_item, dead)),
        "components": [_component(project, use, by_item, layout.uses[use.alias]) for use in design.uses],
        "links": list(_links(design)),
        "frames": list(_frames(design, by_item)),
        "notes": [_note(note, index) for index, note in enumerate(design.notes)],
        "common": _common(design, transitions, by_item, layout.common),
    }


def _component(project: Project, use: Use, by_item: _Findings, at: Point) -> SceneComponent:
    interface = project.interface(use.component)
    return {
        "id": use.alias,
        "name": use.component,
        "design": project.design(use.component) is not None,
        "parameters": len(interface.parameters) if interface else None,
        **_marks(by_item, ItemRef(kind="components", id=use.alias)),
        **_at(at),
    }


def _frames(design: Design, by_item: _Findings) -> Iterable[SceneFrame]:
    """The frames; the canvas computes their rectangles, as states are dragged."""
    for frame, states, level in drawn_frames(design):
        padding = frame_padding(level)
        yield {
            "id": frame.name,
            "name": frame.name,
            "color": frame.color,
            "states": list(states),
            "level": level,
            "side": padding.side,
            "top": padding.top,
            **_marks(by_item, ItemRef(kind="frames", id=frame.name)),
        }


def _note(note: DiagramNote, index: int) -> SceneNote:
    size, lines = note_size(note.text), note_lines(note.text)
    at = _at(note_position(note, index))
    return {"id": note.name, "name": note.text, "lines": lines, "w": size.width, "h": size.height, **at}


def _at(point: Point) -> ScenePlace:
    return {"x": point[0], "y": point[1]}


def finding_messages(findings: Iterable[Finding]) -> list[str]:
    """The messages, each with its own severity."""
    return [f"{finding.severity}: {finding.message}" for finding in findings]


def _marks(by_item: _Findings, *items: ItemRef) -> SceneMarks:
    findings = [finding for item in items for finding in by_item.get(item, ())]
    if not findings:
        return {"severity": None, "count": 0, "messages": []}
    severity: Severity | None = worst_severity(findings)
    count = sum(finding.severity is severity for finding in findings)
    return {"severity": str(severity) if severity else None, "count": count, "messages": finding_messages(findings)}


def _state(design: Design, state: State, by_item: _Findings) -> SceneDesignState:
    called = {action.alias for action in state.all_actions if isinstance(action, Call)}
    return {
        "id": state.name,
        "name": state.name,
        "initial": state.name == design.initial,
        "final": state.final,
        "color": state.color,
        "disabled": state.disabled,
        "enter": bool(state.enter),
        "actions": has_work(state.actions),
        "leave": bool(state.leave),
        "requires": len(state.requires),
        "modulates": len(called),
        "doc": state.doc,
        **_marks(by_item, ItemRef(kind="states", id=state.name)),
    }


def _find_dead_paths(design: Design, findings: Iterable[Finding]) -> frozenset[DesignPath]:
    """The states that can never be active, and the decisions, groups and branches that can never be taken."""
    paths = (
        finding.subject.path
        for finding in findings
        if finding.rule.code in _DEAD and finding.subject is not None and finding.subject.component == design.component
    )
    return frozenset(_dead_branch(design, path[:-1]) if path[-1] in ("when", "after") else path for path in paths)


def _dead_branch(design: Design, path: DesignPath) -> DesignPath:
    """What is dead if the guard of a decision never holds: the `else` of a group can still be taken."""
    located = find_decision(design, path)
    return (*path, "then") if located is not None and isinstance(located.decision, DecisionGroup) else path


def _transitions(
    design: Design, transitions: tuple[DrawnTransition, ...], by_item: _Findings, dead: frozenset[DesignPath]
) -> Iterable[SceneTransition]:
    counts = Counter(drawn.source for drawn in transitions)
    orders: Counter[str] = Counter()
    for drawn in transitions:
        transition = drawn.located.decision
        assert isinstance(transition, Transition)
        orders[drawn.source] += 1
        yield {
            "id": drawn.keys[0],
            "also": list(drawn.keys[1:]),
            "source": "@common" if drawn.source == COMMON else drawn.source,
            "target": drawn.target,
            "label": drawn.label,
            "guard": None if drawn.derived else _guard_text(transition.guard, design.time_unit),
            "order": orders[drawn.source],
            "of": counts[drawn.source],
            "disabled": drawn.disabled,
            "dead": all(_is_dead(path, dead) for path in drawn.paths),
            "derived": drawn.derived,
            "leads_back": drawn.leads_back,
            "label_at": list(transition.label_at) if transition.label_at else None,
            "kind": str(drawn.guard_kind),
            "doc": drawn.text,
            **_marks(by_item, *(ItemRef(kind="transitions", id=key) for key in drawn.keys)),
        }


def _is_dead(path: DesignPath, dead: frozenset[DesignPath]) -> bool:
    return any(path[:length] in dead for length in range(2, len(path) + 1))


def _guard_text(guard: Guard, unit: str) -> str | None:
    """The guard as it is edited on the label; None if it is edited in the form, as code."""
    return None if guard.code is not None and not guard.when and not guard.after else write_guard(guard, unit)


def _links(design: Design) -> Iterable[SceneLink]:
    aliases = {use.alias for use in design.uses}
    for state in design.states:
        calls = [action.alias for action in state.all_actions if isinstance(action, Call)]
        for kind, used in (("requires", state.requires), ("modulates", tuple(dict.fromkeys(calls)))):
            for alias in dict.fromkeys(used):
                if alias in aliases:
                    yield {"id": f"{kind}/{state.name}/{alias}", "kind": kind, "state": state.name, "component": alias}


def _common(
    design: Design, transitions: tuple[DrawnTransition, ...], by_item: _Findings, at: Point
) -> SceneCommon | None:
    if not shows_common(design):
        return None
    count = sum(1 for drawn in transitions if drawn.source == COMMON)
    marks = _marks(by_item, ItemRef(kind="common", id="@common"))
    return {**_at(at), "transitions": count, "actions": has_written(design.common.actions), **marks}
