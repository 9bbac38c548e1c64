"""The differences of two versions of a design, as one diagram with marked elements."""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from vicode.diagram.diagram_model import build_diagram
from vicode.diagram.drawn_transitions import draw_transitions
from vicode.diagram.marks import SIGN_RADIUS, Mark
from vicode.diagram.palettes import DARK, LIGHT, ColorPalette, css_variable_palette, palette_variables
from vicode.diagram.primitives import ShapeGroup, TextShape, VectorImage
from vicode.diagram.render import render_diagram
from vicode.diagram.text_metrics import LABEL_FONT, text_width
from vicode.findings import DesignPath
from vicode.model.design import Decision, Design, Point, State, Transition
from vicode.model.diff import Change, ChangeKind, describe_changes, diff_designs, rename_like
from vicode.model.traversal import find_decision, iter_transitions

_SIGNS = {
    ChangeKind.ADDED: "+",
    ChangeKind.REMOVED: "−",
    ChangeKind.CHANGED: "~",
    ChangeKind.MOVED: ">",
    ChangeKind.RENAMED: "=",
}
# The kind that an element with several changes shows, the first of these.
_RANKS = (ChangeKind.ADDED, ChangeKind.REMOVED, ChangeKind.RENAMED, ChangeKind.CHANGED, ChangeKind.MOVED)
_LEGEND_HEIGHT, _LEGEND_GAP = 32.0, 22.0
_MARGIN = 24.0


@dataclass(frozen=True, slots=True, kw_only=True)
class DiffColors:
    """The colors of a diagram of differences: of the diagram, and of each kind of change."""

    palette: ColorPalette
    kinds: Mapping[ChangeKind, str]


LIGHT_DIFF = DiffColors(
    palette=LIGHT,
    kinds={
        ChangeKind.ADDED: "#15803d",
        ChangeKind.REMOVED: "#b91c1c",
        ChangeKind.CHANGED: "#b45309",
        ChangeKind.MOVED: "#1d4ed8",
        ChangeKind.RENAMED: "#1d4ed8",
    },
)
DARK_DIFF = DiffColors(
    palette=DARK,
    kinds={
        ChangeKind.ADDED: "#4ade80",
        ChangeKind.REMOVED: "#f87171",
        ChangeKind.CHANGED: "#fbbf24",
        ChangeKind.MOVED: "#93c5fd",
        ChangeKind.RENAMED: "#93c5fd",
    },
)


def css_variable_diff() -> DiffColors:
    """Colors that the style sheet of the page defines: those of the diagram, and `--diff-added` and so on."""
    return DiffColors(palette=css_variable_palette(), kinds={kind: f"var(--diff-{kind})" for kind in ChangeKind})


def diff_variables(colors: DiffColors) -> dict[str, str]:
    """The values of the variables of `css_variable_diff`, without the leading dashes."""
    return palette_variables(colors.palette) | {f"diff-{kind}": color for kind, color in colors.kinds.items()}


def render_diff(old: Design, new: Design, colors: DiffColors = LIGHT_DIFF) -> VectorImage:
    """Render the new version with what was removed; each changed element has a color, a sign and a tooltip."""
    changes = diff_designs(old, new)
    old = rename_like(old, new)
    united, removed = _unite(old, new, changes)
    marks = _marks(changes, removed, old, colors, _keys_of_constructs(united))
    marks |= _inherited_marks(united, changes, marks)
    image = render_diagram(
        build_diagram(united), title=f"{new.component}: differences", palette=colors.palette, marks=marks
    )
    kinds = {change.kind for change in changes}
    return _with_legend(image, [kind for kind in ChangeKind if kind in kinds], colors)


def _unite(old: Design, new: Design, changes: Iterable[Change]) -> tuple[Design, dict[str, DesignPath]]:
    """The new design with the removed elements of the old one; the keys of these with their paths there."""
    removed: dict[str, DesignPath] = {}
    lost = {change.path for change in changes if change.kind is ChangeKind.REMOVED}

    def unite_decisions(start: DesignPath, decisions: tuple[Decision, ...]) -> tuple[Decision, ...]:
        """Append what was removed, also from groups, so that the paths of the others stay."""
        paths = [path for path in lost if path[: len(start)] == start and isinstance(path[-1], int)]
        found = [(path, located.decision) for path in sorted(paths) if (located := find_decision(old, path))]
        for index, (path, _decision) in enumerate(found, start=len(decisions)):
            removed[_decision_key((*start, index))] = path
        return (*decisions, *(decision for _path, decision in found))

    def unite_state(state: State) -> State:
        before, start = old.state(state.name), ("states", state.name)
        aliases = [alias for alias in before.requires if (*start, "requires", alias) in lost] if before else []
        removed.update({f"requires/{state.name}/{alias}": (*start, "requires", alias) for alias in aliases})
        transitions = unite_decisions((*start, "transitions"), state.transitions)
        return replace(state, transitions=transitions, requires=(*state.requires, *aliases))

    states = [unite_state(state) for state in new.states]
    gone = [state for state in old.states if ("states", state.name) in lost]
    removed |= {f"s:{state.name}": ("states", state.name) for state in gone}
    removed |= {key: () for state in gone for key in _transition_keys(state)}
    uses = [use for use in old.uses if ("uses", use.alias) in lost]
    removed |= {f"c:{use.alias}": ("uses", use.alias) for use in uses}
    notes = [note for note in old.notes if ("notes", note.name) in lost]
    removed |= {f"n:{note.name}": ("notes", note.name) for note in notes}
    common = replace(new.common, transitions=unite_decisions(("common", "transitions"), new.common.transitions))
    united = replace(new, states=(*states, *gone), uses=(*new.uses, *uses), notes=(*new.notes, *notes), common=common)
    return united, removed


def _transition_keys(state: State) -> list[str]:
    return [_decision_key(("states", state.name, "transitions", index)) for index in range(len(state.transitions))]


def _decision_key(path: DesignPath) -> str:
    return "t:" + "/".join(map(str, path))


def _keys_of_constructs(design: Design) -> dict[DesignPath, list[str]]:
    """The elements that show a construct: the state of a step or layer, and the edge of a rule."""
    found: dict[DesignPath, list[str]] = defaultdict(list)
    for state in design.states:
        if len(state.origin) > 1:
            found[state.origin].append(f"s:{state.name}")
    for drawn in draw_transitions(design):
        if isinstance(drawn.located.decision, Transition) and drawn.derived:
            found[drawn.located.decision.origin].append(_decision_key(drawn.paths[0]))
    return found | {("positions", name): [f"s:{name}"] for name in (each.name for each in design.states if each.origin)}


def _marks(
    changes: Iterable[Change],
    removed: Mapping[str, DesignPath],
    old: Design,
    colors: DiffColors,
    constructs: Mapping[DesignPath, list[str]],
) -> dict[str, Mark]:
    """The mark of each element, with all its changes."""
    by_key: dict[str, list[Change]] = {key: [] for key in removed}
    by_path = {path: key for key, path in removed.items() if path}
    for change in changes:
        if change.kind is ChangeKind.REMOVED and change.path in by_path:
            by_key[by_path[change.path]].append(change)
        else:
            for key in _keys_of(change, constructs):
                by_key.setdefault(key, []).append(change)
    own = {key: path for path, keys in constructs.items() for key in keys}
    return {
        key: _mark(key, group, old, colors, is_removed=key in removed, construct=own.get(key))
        for key, group in by_key.items()
    }


def _inherited_marks(united: Design, changes: Iterable[Change], marks: Mapping[str, Mark]) -> dict[str, Mark]:
    """The marks of transitions in marked groups and of new states."""
    added = {f"s:{change.path[1]}" for change in changes if change.kind is ChangeKind.ADDED and _is_state(change)}
    inherited: dict[str, Mark] = {}
    for located in iter_transitions(united):
        keys = [_decision_key(located.path[:length]) for length in range(len(located.path), 2, -1)]
        found = next((marks[key] for key in keys if key in marks), None)
        if found is None and f"s:{located.source}" in added:
            found = marks[f"s:{located.source}"]
        if found is not None and keys[0] not in marks:
            inherited[keys[0]] = found
    return inherited


def _is_state(change: Change) -> bool:
    return len(change.path) == 2 and change.path[0] == "states"


def _mark(
    key: str, changes: list[Change], old: Design, colors: DiffColors, *, is_removed: bool, construct: DesignPath | None
) -> Mark:
    kinds = {change.kind if change.path == construct else _kind_at(key, change) for change in changes}
    kind = ChangeKind.REMOVED if is_removed else next(each for each in _RANKS if each in kinds)
    is_moved = not is_removed and any(change.kind is ChangeKind.MOVED and not change.attribute for change in changes)
    return Mark(
        color=colors.kinds[kind],
        sign=_SIGNS[kind],
        title="\n".join(describe_changes(changes)) or "removed",
        is_removed=is_removed,
        moved_from=_old_center(key, old) if is_moved else None,
    )


def _kind_at(key: str, change: Change) -> ChangeKind:
    """The kind of change of the element itself: what was added to or removed from an element changes it."""
    is_own = _own_key(change.path) == key
    return change.kind if is_own or change.kind is ChangeKind.CHANGED else ChangeKind.CHANGED


def _old_center(key: str, old: Design) -> Point | None:
    if key == "common":
        return old.common.at
    centers = {
        **{f"s:{state.name}": state.at for state in old.states},
        **{f"c:{use.alias}": use.at for use in old.uses},
        **{f"n:{note.name}": note.at for note in old.notes},
    }
    return centers.get(key)


def _own_key(path: DesignPath) -> str:
    """The key of the element that a path names exactly; empty if there is none."""
    match path:
        case ("states", str(name)):
            return f"s:{name}"
        case ("uses", str(name)):
            return f"c:{name}"
        case ("notes", str(name)):
            return f"n:{name}"
        case ("common",):
            return "common"
        case ("states", str(name), "requires" | "modulates" as kind, str(alias)):
            return f"{kind}/{name}/{alias}"
        case _ if "transitions" in path and isinstance(path[-1], int):
            return _decision_key(path)
        case _:
            return ""


def _keys_of(change: Change, constructs: Mapping[DesignPath, list[str]]) -> list[str]:
    """The keys of the element that a change marks: the innermost one that the diagram shows."""
    path = change.path
    is_gone = change.kind is ChangeKind.REMOVED
    while path:
        if path in constructs:
            return [] if is_gone and path == change.path else constructs[path]
        key = _own_key(path)
        if key:
            return [key]
        path = path[:-1]
    return []


def _with_legend(image: VectorImage, kinds: list[ChangeKind], colors: DiffColors) -> VectorImage:
    """Explain the signs below the diagram."""
    x, y = image.left + _MARGIN + SIGN_RADIUS, image.top + image.height - _MARGIN / 2 + _LEGEND_HEIGHT / 2
    groups: list[ShapeGroup] = []
    for kind in kinds:
        mark = Mark(color=colors.kinds[kind], sign=_SIGNS[kind], title="")
        text = TextShape(x=x + SIGN_RADIUS + 5, y=y, text=str(kind), fill=colors.palette.text)
        sign = mark.sign_group((x, y), colors.palette)
        groups.append(replace(sign, shapes=(*sign.shapes, text)))
        x += 2 * SIGN_RADIUS + 5 + text_width(str(kind), LABEL_FONT) + _LEGEND_GAP
    return replace(
        image,
        height=image.height + _LEGEND_HEIGHT,
        width=max(image.width, x - image.left),
        groups=(*image.groups, *groups),
    )
