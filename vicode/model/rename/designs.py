"""Renaming of references in a design: expressions, links, calls, types and code."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeVar

from vicode.model.design import (
    Action,
    Assign,
    Call,
    Code,
    Competence,
    CompetenceStep,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    Interrupt,
    InvariantProperty,
    Latch,
    Layer,
    Property,
    ReachProperty,
    RunCode,
    State,
)
from vicode.model.lowering import lower_design
from vicode.model.rename.cpp import declares_in_cpp, rename_in_cpp
from vicode.model.rename.expressions import rename_in_expression
from vicode.model.rename.python import declares_in_python, rename_in_python
from vicode.model.rename.references import ReferenceKind, ReferenceRename

_Record = TypeVar("_Record", Latch, Interrupt, CompetenceStep, Competence, Layer)
_Layer = TypeVar("_Layer", CompetenceStep, Layer)
_Pairs = tuple[tuple[str, str], ...]


def rename_in_design(design: Design, rename: ReferenceRename) -> Design:
    """Rename the references in a design, but not the declaration."""
    hidden = _shadowing_languages(design, rename)

    def in_code(code: Code, role: str) -> Code:
        texts = (
            (language, text if language in hidden else _rename_in_code(text, language, role, rename))
            for language, text in code.texts
        )
        return replace(code, texts=tuple(texts))

    renamed = replace(
        _rewrite(design, _ReferenceRewriter(rename, in_code)),
        parameters=rename_in_declarations(design.parameters, rename),
        outputs=rename_in_declarations(design.outputs, rename),
        variables=rename_in_declarations(design.variables, rename),
    )
    return lower_design(renamed)


def map_code(design: Design, change: Callable[[Code, str], Code]) -> Design:
    """Apply `change` to each block of hand-written code and its role."""
    return _rewrite(design, _ReferenceRewriter(_NO_RENAME, change))


_NO_RENAME = ReferenceRename(kind=ReferenceKind.PARAMETER, old="", new="")
"""Matches no reference."""


def _rename_in_code(text: str, language: str, role: str, rename: ReferenceRename) -> str:
    match language:
        case "python":
            return rename_in_python(text, role, rename)
        case "cpp":
            return rename_in_cpp(text, role, rename)
        case _:
            return text


def _rewrite(design: Design, rewriter: "_ReferenceRewriter") -> Design:
    """Apply a rewriter to everything but the declarations."""
    common = replace(
        design.common,
        actions=rewriter.actions(design.common.actions),
        transitions=rewriter.decisions(design.common.transitions),
    )
    return replace(
        design,
        module=rewriter.code(design.module, "module"),
        members=rewriter.code(design.members, "members"),
        common=common,
        states=tuple(rewriter.state(state) for state in design.states),
        latches=tuple(rewriter.expressions(each, "on", "off", "hold") for each in design.latches),
        interrupts=tuple(rewriter.expressions(each, "when", "until", "every") for each in design.interrupts),
        competence=rewriter.competence(design.competence) if design.competence else None,
        layers=tuple(rewriter.layer(each) for each in design.layers),
        properties=tuple(rewriter.promised(each) for each in design.properties),
    )


def rename_in_declarations(declarations: tuple[Declaration, ...], rename: ReferenceRename) -> tuple[Declaration, ...]:
    """Rename references in values, types and arguments of declarations."""
    return tuple(_rename_in_declaration(declaration, rename) for declaration in declarations)


def _rename_in_declaration(declaration: Declaration, rename: ReferenceRename) -> Declaration:
    is_type = rename.kind == ReferenceKind.ENUMERATION and declaration.type == rename.old
    arguments = declaration.arguments
    return replace(
        declaration,
        type=rename.new if is_type else declaration.type,
        initial=rename_in_expression(declaration.initial, rename),
        arguments=None if arguments is None else rename_in_declarations(arguments, rename),
    )


def _shadowing_languages(design: Design, rename: ReferenceRename) -> frozenset[str]:
    """Return the languages in which module code of the design redefines the name."""
    if rename.kind not in (ReferenceKind.CONSTANT, ReferenceKind.ENUMERATION, ReferenceKind.ELEMENT):
        return frozenset()
    name = rename.owner or rename.old
    own, cpp = (design.module.in_language(language) or "" for language in ("python", "cpp"))
    is_redefined = (("python", declares_in_python(own, "module", name)), ("cpp", declares_in_cpp(cpp, name)))
    return frozenset(language for language, is_hidden in is_redefined if is_hidden)


class _ReferenceRewriter:
    """Renames references in each part of a design."""

    def __init__(self, rename: ReferenceRename, code: Callable[[Code, str], Code]) -> None:
        self.rename, self.code = rename, code

    def alias(self, alias: str) -> str:
        return self.rename.new if self.rename.kind == ReferenceKind.ALIAS and alias == self.rename.old else alias

    def expression(self, text: str) -> str:
        return rename_in_expression(text, self.rename)

    def values(self, pairs: _Pairs) -> _Pairs:
        return tuple((self.expression(name), self.expression(text)) for name, text in pairs)

    def call(self, call: Call) -> Call:
        is_renamed = self.rename.kind == ReferenceKind.PARAMETER and call.alias == self.rename.owner
        pairs = (
            (self.rename.new if is_renamed and name == self.rename.old else name, self.expression(text))
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

    def expressions(self, record: _Record, *names: str) -> _Record:
        """Rewrite the fields of a record that hold expressions."""
        changes: dict[str, Any] = {name: self.expression(getattr(record, name)) for name in names}
        return replace(record, **changes)

    def layer(self, layer: _Layer) -> _Layer:
        names = ("when", "hold") if hasattr(layer, "hold") else ("when",)
        changes: dict[str, Any] = {
            "requires": tuple(self.alias(alias) for alias in layer.requires),
            "modulates": tuple(self.call(call) for call in layer.modulates),
        }
        return replace(self.expressions(layer, *names), **changes)

    def competence(self, competence: Competence) -> Competence:
        return replace(
            self.expressions(competence, "goal"),
            requires=tuple(self.alias(alias) for alias in competence.requires),
            steps=tuple(self.layer(step) for step in competence.steps),
        )

    def promised(self, promised: Property) -> Property:
        match promised:
            case ReachProperty(within=within) if within:
                return replace(promised, within=self.expression(within))
            case InvariantProperty(holds=holds):
                return replace(promised, holds=self.expression(holds))
            case _:
                return promised

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
