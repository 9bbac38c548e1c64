"""The form of a transition, stay or group."""

from vicode.editor.session.forms.fields import field_node, known_field, other_nodes
from vicode.editor.session.forms.nodes import (
    Button,
    Choice,
    CodeText,
    DecisionRow,
    Decisions,
    Heading,
    Languages,
    Node,
    TextField,
    Title,
)
from vicode.editor.view import guard_label
from vicode.findings import DesignPath
from vicode.languages import LANGUAGES, language_title
from vicode.model.design import COMMON, Decision, DecisionGroup, Design, Stay, Transition
from vicode.model.project import Project

_NOUNS = {Transition: "Transition from", DecisionGroup: "Group of", Stay: "Stay in"}
CODE_HINTS = {
    "python": "Python statements, such as self.tries += 1",
    "cpp": "Translated from Python where possible; or statements in C++, such as tries += 1;",
}


def decision_form(project: Project, design: Design, source: str, decision: Decision) -> tuple[Node, ...]:
    """The form of a decision of a state, or of COMMON."""
    unit = "milliseconds" if design.time_unit == "ms" else "seconds"
    nodes: list[Node] = [decision_title(source, decision)]
    if isinstance(decision, Transition):
        nodes.append(Choice(path=("to",), label="To", value=decision.to, options="states"))
    guard = decision.guard
    hint = "" if guard.after or guard.code else "always"
    nodes += [
        CodeText(path=("guard", "when"), label="When", value=guard.when, language="expression", hint=hint),
        TextField(path=("guard", "after"), label=f"After ({unit} in this state)", value=guard.after, is_code=True),
    ]
    if guard.code is None:
        nodes.append(Button(label="Code predicate", icon="add", action="add-code"))
    else:
        nodes += [code_texts(project, decision, ("guard", "code")), Button(label="Remove code", action="remove-code")]
    nodes += [field_node(decision, "doc"), field_node(decision, "disabled"), *other_nodes(decision)]
    if isinstance(decision, DecisionGroup):
        for path, title, items in (("then", "Then", decision.then), ("else", "Else", decision.otherwise)):
            nodes += [Heading(text=title), decisions_list(design, (path,), items)]
    return (*nodes, Button(label="Remove", icon="delete", action="remove", is_danger=True))


def decision_title(source: str, decision: Decision) -> Title:
    noun = _NOUNS[type(decision)]
    if source == COMMON:
        return Title(text=noun, name="every state", opens=("common", COMMON))
    return Title(text=noun, name=source, opens=("states", source))


def decisions_list(design: Design, path: DesignPath, decisions: tuple[Decision, ...]) -> Decisions:
    return Decisions(path=path, rows=_rows(design, decisions))


def _rows(design: Design, decisions: tuple[Decision, ...]) -> tuple[DecisionRow, ...]:
    return tuple(
        DecisionRow(
            target=decision_target(each),
            guard=guard_label(each.guard, design.time_unit) or "always",
            is_disabled=each.disabled,
            is_derived=not isinstance(each, Stay) and bool(each.origin),
            then=_rows(design, each.then) if isinstance(each, DecisionGroup) else (),
            otherwise=_rows(design, each.otherwise) if isinstance(each, DecisionGroup) else (),
        )
        for each in decisions
    )


def decision_target(item: Decision) -> str:
    match item:
        case Transition(to=to):
            return f"→ {to}"
        case Stay():
            return "stay"
        case DecisionGroup():
            return "if"


def code_texts(project: Project, owner: object, path: DesignPath, owner_path: DesignPath = ()) -> Node:
    """The texts of a code: one field, or with several languages a tab for each.

    `path` leads to the code in its owner, `owner_path` to the owner in the form.
    """
    written = [language for language in LANGUAGES if known_field(owner, (*path, language)).read(owner)]
    wanted = [language for language in project.languages if language in LANGUAGES]
    languages = tuple(dict.fromkeys([*wanted, *written])) or ("python",)
    shown = [_code_text(owner, path, language, owner_path) for language in languages]
    name = shown[0].label if path[-1] != "code" else "the code"
    return shown[0] if len(shown) == 1 else Languages(label=f"Languages of {name}", texts=tuple(shown))


def _code_text(owner: object, path: DesignPath, language: str, owner_path: DesignPath) -> CodeText:
    field, title = known_field(owner, (*path, language)), language_title(language)
    label = field.label if language == "python" else f"{field.label} in {title}" if field.label else title
    return CodeText(
        path=(*owner_path, *path, language),
        label=label or title,
        value=field.read(owner),
        language=language,
        title=title,
        hint=CODE_HINTS.get(language, ""),
        can_open=True,
    )
