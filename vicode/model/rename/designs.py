"""Renames in everything a design says: expressions, links, calls, types and code."""

from collections.abc import Callable
from dataclasses import replace

from vicode.model.design import (
    Action,
    Assign,
    Call,
    Code,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    RunCode,
    State,
)
from vicode.model.rename.cpp import declares_in_cpp, rename_in_cpp
from vicode.model.rename.expressions import rename_in_expression
from vicode.model.rename.python import declares_in_python, rename_in_python
from vicode.model.rename.references import ReferenceKind, ReferenceRename

_Pairs = tuple[tuple[str, str], ...]


def rename_in_design(design: Design, rename: ReferenceRename) -> Design:
    """The design with the new name wherever it is said; where it is declared it stays."""
    hidden = _shadowing_languages(design, rename)

    def in_code(code: Code, role: str) -> Code:
        texts = (
            (language, text if language in hidden else _rename_in_code(text, language, role, rename))
            for language, text in code.texts
        )
        return replace(code, texts=tuple(texts))

    return replace(
        _rewrite(design, _ReferenceRewriter(rename, in_code)),
        parameters=rename_in_declarations(design.parameters, rename),
        outputs=rename_in_declarations(design.outputs, rename),
        variables=rename_in_declarations(design.variables, rename),
    )


def map_code(design: Design, change: Callable[[Code, str], Code]) -> Design:
    """The design with other hand-written code; `change` is given each piece and its role."""
    return _rewrite(design, _ReferenceRewriter(_NO_RENAME, change))


_NO_RENAME = ReferenceRename(kind=ReferenceKind.PARAMETER, old="", new="")
"""What no text says."""


def _rename_in_code(text: str, language: str, role: str, said: ReferenceRename) -> str:
    match language:
        case "python":
            return rename_in_python(text, role, said)
        case "cpp":
            return rename_in_cpp(text, role, said)
        case _:
            return text


def _rewrite(design: Design, speaker: "_ReferenceRewriter") -> Design:
    """The design as a speaker says it, but for what it declares."""
    common = replace(
        design.common,
        actions=speaker.actions(design.common.actions),
        transitions=speaker.decisions(design.common.transitions),
    )
    return replace(
        design,
        module=speaker.code(design.module, "module"),
        members=speaker.code(design.members, "members"),
        common=common,
        states=tuple(speaker.state(state) for state in design.states),
    )


def rename_in_declarations(declarations: tuple[Declaration, ...], rename: ReferenceRename) -> tuple[Declaration, ...]:
    """Declarations with the new name in their values, their types and their arguments."""
    return tuple(_rename_in_declaration(each, rename) for each in declarations)


def _rename_in_declaration(declaration: Declaration, said: ReferenceRename) -> Declaration:
    is_type = said.kind == ReferenceKind.ENUMERATION and declaration.type == said.old
    given = declaration.arguments
    return replace(
        declaration,
        type=said.new if is_type else declaration.type,
        initial=rename_in_expression(declaration.initial, said),
        arguments=None if given is None else rename_in_declarations(given, said),
    )


def _shadowing_languages(design: Design, said: ReferenceRename) -> frozenset[str]:
    """Those in which the module's own code gives a name of the project another meaning in all code of the design."""
    if said.kind not in (ReferenceKind.CONSTANT, ReferenceKind.ENUMERATION, ReferenceKind.ELEMENT):
        return frozenset()
    name = said.owner or said.old
    own, cpp = (design.module.in_language(language) or "" for language in ("python", "cpp"))
    found = (("python", declares_in_python(own, "module", name)), ("cpp", declares_in_cpp(cpp, name)))
    return frozenset(language for language, is_hidden in found if is_hidden)


class _ReferenceRewriter:
    """Says the new name in each part of a design."""

    def __init__(self, said: ReferenceRename, code: Callable[[Code, str], Code]) -> None:
        self.rename, self.code = said, code

    def alias(self, alias: str) -> str:
        return self.rename.new if self.rename.kind == ReferenceKind.ALIAS and alias == self.rename.old else alias

    def expression(self, text: str) -> str:
        return rename_in_expression(text, self.rename)

    def values(self, pairs: _Pairs) -> _Pairs:
        return tuple((self.expression(name), self.expression(text)) for name, text in pairs)

    def call(self, call: Call) -> Call:
        is_asked = self.rename.kind == ReferenceKind.PARAMETER and call.alias == self.rename.owner
        pairs = (
            (self.rename.new if is_asked and name == self.rename.old else name, self.expression(text))
            for name, text in call.arguments
        )
        return replace(call, alias=self.alias(call.alias), arguments=tuple(pairs))

    def actions(self, actions: tuple[Action, ...]) -> tuple[Action, ...]:
        return tuple(self._action(action) for action in actions)

    def _action(self, action: Action) -> Action:
        match action:
            case Assign():
                return replace(action, values=self.values(action.values))
            case Call():
                return self.call(action)
            case RunCode():
                return replace(action, code=self.code(action.code, "action"))

    def decisions(self, decisions: tuple[Decision, ...]) -> tuple[Decision, ...]:
        return tuple(self._decision(decision) for decision in decisions)

    def _decision(self, decision: Decision) -> Decision:
        guard = self._guard(decision.guard)
        if isinstance(decision, DecisionGroup):
            then, otherwise = self.decisions(decision.then), self.decisions(decision.otherwise)
            return replace(decision, guard=guard, then=then, otherwise=otherwise)
        return replace(decision, guard=guard)

    def _guard(self, guard: Guard) -> Guard:
        code = self.code(guard.code, "predicate") if guard.code else None
        return replace(guard, when=self.expression(guard.when), after=self.expression(guard.after), code=code)

    def state(self, state: State) -> State:
        return replace(
            state,
            requires=tuple(self.alias(alias) for alias in state.requires),
            modulates=tuple(self.call(call) for call in state.modulates),
            enter=self.actions(state.enter),
            actions=self.actions(state.actions),
            leave=self.actions(state.leave),
            transitions=self.decisions(state.transitions),
        )
