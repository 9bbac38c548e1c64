"""Labels of items and their parts for lists and dialogs."""

from vicode.editor.view.selection import decision_path
from vicode.findings import DesignPath
from vicode.model.design import DecisionGroup, Design, Transition
from vicode.model.traversal import find_decision

_PARTS = {
    "when": "guard",
    "after": "time",
    "doc": "description",
    "enter": "enter",
    "leave": "leave",
    "actions": "actions",
    "requires": "requires",
    "modulates": "modulates",
    "default": "default",
    "initial": "initial value",
    **{key: key for key in ("on", "off", "hold", "until", "every", "goal", "for")},
}
_SECTIONS = {"parameters": "parameter", "outputs": "output", "variables": "variable", "uses": "component"}
_SECTIONS |= {"latches": "latch", "layers": "layer"}
_WHOLE = {"module": "module code", "members": "member code", "interrupts": "an interrupt", "competence": "competence"}


def item_label(design: Design, path: DesignPath) -> str:
    """The label of the item at a path, such as "Kick → Wait", "state Kick" or "variable tries"."""
    match path:
        case ("states", _, "transitions", int(), *_) | ("common", "transitions", int(), *_):
            return _decision_label(design, decision_path(path))
        case ("states", str(name), *_):
            return f"state {name}"
        case ("common", *_):
            return "every state"
        case (str(section), str(name), *_) if section in _SECTIONS:
            return f"{_SECTIONS[section]} {name}"
        case (str(section), *_):
            return _WHOLE.get(section, "design")
        case _:
            return "design"


def part_label(path: DesignPath) -> str:
    """The label of the text within the item, such as "guard", "enter" or "code"; empty if the item is one text."""
    named = [_PARTS[str(part)] for part in path if isinstance(part, str) and part in _PARTS]
    is_code = "code" in path[1:]
    return " ".join([*named[-1:], *(["code"] if is_code else [])])


def _decision_label(design: Design, path: DesignPath) -> str:
    located = find_decision(design, path)
    if located is None:
        return "a transition"
    source = "every state" if located.source.startswith("@") else located.source
    match located.decision:
        case Transition(to=to):
            return f"{source} → {to}"
        case DecisionGroup():
            return f"group in {source}"
        case _:
            return f"stay in {source}"
