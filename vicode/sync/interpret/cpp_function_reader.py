"""Reads one changed function of a C++ source back as an edit of the design."""

import textwrap
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from vicode.cpp_tokens import NUMBER, STRING, CppToken, iter_tokens, number_value
from vicode.generators import list_regions
from vicode.generators.cpp import CppCode
from vicode.languages import LANGUAGES
from vicode.model.design import Design, RunCode, State
from vicode.model.disabled import disabled_states
from vicode.model.edits import update_state
from vicode.model.names import snake_case
from vicode.model.project import Project
from vicode.model.traversal import iter_actions, iter_decisions
from vicode.regions import find_regions
from vicode.sync.apply_regions import set_code
from vicode.sync.interpret.cpp_action_reader import CppActionReader, find_unknown_words
from vicode.sync.interpret.cpp_comparison import CppComparison, CppFile
from vicode.sync.interpret.cpp_decision_reader import CppDecisionReader
from vicode.sync.interpret.cpp_expression_reader import CppExpressionReader, UnreadableError
from vicode.sync.interpret.cpp_plain_forms import PlainForms, is_mark
from vicode.sync.interpret.cpp_source import split_statements
from vicode.sync.interpret.cpp_state_blocks import StateBlocks

_PREFIXES = {"decide": "if (decide_common()) { return; }", "act": "act_common();"}
"""Statements before those of the states."""
Tokens = tuple[CppToken, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CppFunctionReader:
    """Reads functions.

    Attributes:
        project: The project.
        design: The design with the edits understood so far.
        code: Its code.
        own: Its source.
        edited: The edited file.
        first: The code before all edits.
    """

    project: Project
    design: Design
    code: CppCode
    own: CppFile
    edited: CppFile
    first: CppCode

    def read(self, name: str, comparison: CppComparison) -> tuple[Design, int]:
        """Return the design as the function was changed, and the first line that differs.

        Raises:
            UnreadableError: The design cannot express it.
            SyntaxError: The function has another form.
        """
        if name not in self.edited.functions:
            raise UnreadableError(f"{name} was removed")
        kind = self.own.functions[name].short_name
        match kind:
            case "decide_common" | "act_common":
                return self._with_common(name, kind), self._line(name, "")
            case "decide" | "act" | "enter" | "leave" | "in_final_state":
                states = comparison.different_states(name)
                return self._with_states(name, kind, states), self._line(name, states[0] if states else "")
            case "step":
                texts = [token.text for token in self.edited.functions[name].body]
                return replace(self.design, resume="true" in texts), self._line(name, "")
            case self.code.symbols.class_name:
                return replace(self.design, frequency_hz=self._frequency(name)), self._line(name, "")
            case _ if kind.startswith(("do_", "when_")):
                return self._with_code(name), self._line(name, "")
            case _:
                raise UnreadableError(f"no part of the design corresponds to {name}")

    def _line(self, name: str, state: str) -> int:
        """The first line in which a function, or its case for a state, differs."""
        bodies = [(file.functions[name].tokens, file) for file in (self.own, self.edited)]
        if state:
            parts = [(file.body(name).case(state), file) for file in (self.own, self.edited)]
            bodies = parts if parts[1][0] else bodies
        (old, _own), (new, _edited) = bodies
        at = next((at for at, (a, b) in enumerate(zip(old, new, strict=False)) if a.text != b.text), len(new) - 1)
        return self.edited.text.count("\n", 0, new[at].start) + 1

    # States

    def _with_states(self, name: str, kind: str, elements: Sequence[str]) -> Design:
        own, edited = self._blocks(kind, self.own.body(name)), self._blocks(kind, self.edited.body(name))
        design = self.design
        names = self.code.symbols.states
        for element in names if "" in elements else elements:
            state = design.state(names.get(element, ""))
            if state is None:
                raise UnreadableError(f"State::{element}")
            changed = self._read_state(kind, state, own.get(element, ()), edited.get(element, ()))
            design = update_state(design, state.name, lambda _old, new=changed: new)  # type: ignore[misc]
        return design

    def _read_state(self, kind: str, state: State, own: Tokens, edited: Tokens) -> State:
        before, after = split_statements(own), split_statements(edited)
        if kind == "in_final_state":
            return replace(state, final=[token.text for token in edited] == ["return", "true", ";"])
        if kind == "decide":
            return replace(state, transitions=self._decisions.read(state.transitions, before, after))
        if kind == "act":
            read = self._actions(state.name, "actions").read(state.actions, state.modulates, before, after)
            return replace(state, actions=read.actions, modulates=read.modulates)
        old = state.enter if kind == "enter" else state.leave
        read = self._actions(state.name, kind).read(old, (), before, after)
        actions = (*read.actions, *read.modulates)
        return replace(state, enter=actions) if kind == "enter" else replace(state, leave=actions)

    def _blocks(self, kind: str, body: StateBlocks) -> Mapping[str, Tokens]:
        """Return the statements of each state, without those before them."""
        head = self._without_prefix(kind, body.head)
        if body.cases is None:
            return dict.fromkeys(self.code.symbols.states, head)
        tail = [token.text for token in body.tail]
        if head or tail not in ([], ["return", "false", ";"]):
            raise UnreadableError("statements outside the cases of the states")
        unknown = body.cases.keys() - self.code.symbols.states.keys()
        if unknown:
            raise UnreadableError(f"State::{min(unknown)}")
        return body.cases

    def _without_prefix(self, kind: str, head: Tokens) -> Tokens:
        prefix = [token.text for token in iter_tokens(_PREFIXES.get(kind, ""))]
        called = next((word for word in prefix if word.endswith("_common")), "")
        if not any(item.short_name == called for item in self.own.functions.values()):
            return head
        if [token.text for token in head[: len(prefix)]] != prefix:
            raise UnreadableError(f"the call of {called}() was changed")
        return head[len(prefix) :]

    def _with_common(self, name: str, kind: str) -> Design:
        common = self.design.common
        before, after = (
            split_statements([token for token in file.functions[name].body if not is_mark(token)])
            for file in (self.own, self.edited)
        )
        if kind == "decide_common":
            transitions = self._decisions.read(common.transitions, before, after)
            return replace(self.design, common=replace(common, transitions=transitions))
        read = self._actions("common", "actions").read(common.actions, (), before, after)
        return replace(self.design, common=replace(common, actions=(*read.actions, *read.modulates)))

    # Readers of statements

    @property
    def _forms(self) -> PlainForms:
        return PlainForms(self.code.symbols)

    @property
    def _expressions(self) -> CppExpressionReader:
        return CppExpressionReader(self.code.symbols, self.design.time_unit)

    @property
    def _decisions(self) -> CppDecisionReader:
        return CppDecisionReader(self._forms, self._expressions, disabled_states(self.design))

    def _actions(self, state: str, phase: str) -> CppActionReader:
        names = [item.short_name for item in self.edited.functions.values()]
        added = self.edited.functions.keys() - self.own.functions.keys()
        if added:
            # The code may be in a function with another name.
            names += [item.short_name for item in self.own.functions.values()]
        ids = [located.decision.id for located in iter_decisions(self.design)]
        ids += [each.action.id for each in iter_actions(self.design) if isinstance(each.action, RunCode)]
        stems = [name.partition("_")[2] for name in names]
        return CppActionReader(
            forms=self._forms,
            expressions=self._expressions,
            text=self.edited.text,
            known=self._known_words(),
            kept=names,
            may_add_code=self._may_add_code,
            taken_ids=[*ids, *stems],
            prefix="_".join([snake_case(state), *([] if phase == "actions" else [phase])]),
        )

    # Hand-written code

    @property
    def _may_add_code(self) -> bool:
        """Whether nothing outside functions was changed that code may need."""
        return self.own.others() == self.edited.others()

    def _known_words(self) -> Collection[str]:
        words = {token.text for text in (self.first.header, self.first.source) for token in iter_tokens(text)}
        return words | LANGUAGES["cpp"].keywords | {"std", "bica"}

    def _with_code(self, name: str) -> Design:
        """Take the whole body of a function with a region as its code."""
        own, edited = self.own.functions[name], self.edited.functions[name]
        inside = self.own.text[own.start : own.end]
        regions = find_regions(inside, "//").regions
        unknown = find_unknown_words(edited.body, self._known_words())
        if len(regions) != 1 or not self._may_add_code or unknown:
            raise UnreadableError(f"{min(unknown)} in {name}" if unknown else name)
        if any(token.kind == STRING and "\n" in token.text for token in edited.body):
            raise UnreadableError("a string of several lines")
        project = replace(self.project, designs=tuple(self._with_design(self.project.designs)))
        paths = list_regions(project, self.design.component, "cpp")
        return set_code(self.design, paths[regions[0].id], "cpp", self._body_text(name))

    def _with_design(self, designs: Sequence[Design]) -> Iterator[Design]:
        for each in designs:
            yield self.design if each.component == self.design.component else each

    def _body_text(self, name: str) -> str:
        item = self.edited.functions[name]
        if not item.body:
            return ";"
        start = self.edited.text.rfind("\n", 0, item.body[0].start) + 1
        lines = self.edited.text[start : item.body[-1].end].expandtabs(4).split("\n")
        kept = [line for line in lines if not any(is_mark(token) for token in iter_tokens(line.strip()))]
        return textwrap.dedent("\n".join(kept)).strip("\n")

    # Settings

    def _frequency(self, name: str) -> float | None:
        """The number behind the name of the component in the constructor."""
        head = self.edited.functions[name].head
        at = next((at for at, token in enumerate(head) if token.kind == STRING), -1)
        following = head[at + 2 : at + 3] if at >= 0 else ()
        value = number_value(following[0].text) if following and following[0].kind == NUMBER else None
        return None if value is None else float(value)
