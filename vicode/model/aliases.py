"""Puts another alias in the place of one, everywhere a design speaks of it but in `uses`."""

import re
from dataclasses import replace

from vicode.model.design import Action, Assign, Call, Code, Decision, Design, Group, Guard, RunCode, State


def renamed_alias(design: Design, old: str, new: str) -> Design:
    """The design with `new` where links, calls, expressions and Python code said `old`."""
    renamer = _Renamer(old, new)
    common = replace(
        design.common,
        actions=renamer.actions(design.common.actions),
        transitions=renamer.decisions(design.common.transitions),
    )
    states = tuple(renamer.state(state) for state in design.states)
    return replace(design, common=common, states=states, members=renamer.code(design.members))


class _Renamer:
    """Knows the two spellings: `head.pan` and `done(head)` in expressions, `self.head` in code."""

    def __init__(self, old: str, new: str) -> None:
        self.old, self.new = old, new
        word = re.escape(old)
        self._in_expression = re.compile(rf"(?<![\w.]){word}(?=\s*\.)|(?<=done\()\s*{word}\s*(?=\))")
        self._in_code = re.compile(rf"(?<=\bself\.){word}\b")

    def alias(self, alias: str) -> str:
        return self.new if alias == self.old else alias

    def expression(self, text: str) -> str:
        return self._in_expression.sub(self.new, text)

    def code(self, code: Code) -> Code:
        texts = ((lang, self._in_code.sub(self.new, text) if lang == "python" else text) for lang, text in code.texts)
        return replace(code, texts=tuple(texts))

    def pairs(self, pairs: tuple[tuple[str, str], ...]) -> tuple[tuple[str, str], ...]:
        return tuple((name, self.expression(text)) for name, text in pairs)

    def call(self, call: Call) -> Call:
        return replace(call, alias=self.alias(call.alias), arguments=self.pairs(call.arguments))

    def actions(self, actions: tuple[Action, ...]) -> tuple[Action, ...]:
        return tuple(self._action(action) for action in actions)

    def _action(self, action: Action) -> Action:
        match action:
            case Assign():
                values = ((self.expression(name), text) for name, text in self.pairs(action.values))
                return replace(action, values=tuple(values))
            case Call():
                return self.call(action)
            case RunCode():
                return replace(action, code=self.code(action.code))

    def decisions(self, decisions: tuple[Decision, ...]) -> tuple[Decision, ...]:
        return tuple(self._decision(decision) for decision in decisions)

    def _decision(self, decision: Decision) -> Decision:
        guard = self._guard(decision.guard)
        if isinstance(decision, Group):
            then, otherwise = self.decisions(decision.then), self.decisions(decision.otherwise)
            return replace(decision, guard=guard, then=then, otherwise=otherwise)
        return replace(decision, guard=guard)

    def _guard(self, guard: Guard) -> Guard:
        code = self.code(guard.code) if guard.code else None
        return replace(guard, when=self.expression(guard.when), code=code)

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
