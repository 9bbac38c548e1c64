"""Compares two C++ files function by function, in the plain form of their statements.

`is_same_cpp_program` is the last check of edits that were read back: it knows nothing of designs and of how an edit
was read.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from vicode.cpp_tokens import COMMENT, CppToken
from vicode.generators.cpp.symbols import CppSymbols
from vicode.sync.interpret.cpp_plain_forms import PlainForm, PlainForms, comment_words, is_mark, with_actions
from vicode.sync.interpret.cpp_source import CppItem, group_by_function, split_items
from vicode.sync.interpret.cpp_state_blocks import StateBlocks, split_states
from vicode.sync.same_code import plain_token

Forms = tuple[PlainForm, ...]


@dataclass(frozen=True, slots=True)
class CppFile:
    """A file as its functions by name and the other items; bodies are split when they are needed."""

    text: str
    items: tuple[CppItem, ...]
    functions: Mapping[str, CppItem]
    _bodies: dict[str, StateBlocks] = field(default_factory=dict, compare=False)

    @classmethod
    def of(cls, text: str) -> "CppFile":
        """Split a file.

        Raises:
            SyntaxError: It is no C++ file.
        """
        items = split_items(text)
        return cls(text, items, group_by_function(items))

    def body(self, name: str) -> StateBlocks:
        """Return the body of a function.

        Raises:
            SyntaxError: Its switch over the state has another form.
        """
        if name not in self._bodies:
            self._bodies[name] = split_states([token for token in self.functions[name].body if not is_mark(token)])
        return self._bodies[name]

    def others(self) -> list[str]:
        """The tokens outside functions."""
        return [token.text for item in self.items if not item.name for token in item.tokens]


@dataclass(frozen=True, slots=True)
class CppComparison:
    """Compares functions of two files.

    Attributes:
        own: One file.
        other: The other.
        symbols: The names in both.
    """

    own: CppFile
    other: CppFile
    symbols: CppSymbols
    _same: dict[str, bool] = field(default_factory=dict, compare=False)

    def different(self) -> list[str]:
        """Return the functions that differ, in the order of the other file."""
        inlined = self.inlined()
        names = dict.fromkeys((*self.other.functions, *self.own.functions))
        return [name for name in names if name not in inlined and not self.is_same(name)]

    def is_same(self, name: str) -> bool:
        """Whether a function is the same in both files, with the same comments."""
        if name not in self._same:
            self._same[name] = self._is_same(name)
        return self._same[name]

    def _is_same(self, name: str) -> bool:
        own, other = self.own.functions.get(name), self.other.functions.get(name)
        if own is None or other is None:
            return False
        if _texts(own.tokens) == _texts(other.tokens):
            return not self.inlined() or not self._calls_inlined(own)
        if _head(own) != _head(other) or _outer_comments(own) != _outer_comments(other):
            return False
        try:
            return not self.different_states(name)
        except SyntaxError:
            return False

    def _calls_inlined(self, item: CppItem) -> bool:
        short = {self.own.functions[name].short_name for name in self.inlined()}
        return any(token.text in short for token in item.body)

    def different_states(self, name: str) -> list[str]:
        """Return the states in which a function differs; "" stands for all states.

        Raises:
            SyntaxError: The statements cannot be split.
        """
        own, other = self.own.body(name), self.other.body(name)
        if own.cases is None and other.cases is None:
            return [] if self._forms(own, "") == self._plain(other, "") else [""]
        is_outside_same = all(_texts(a) == _texts(b) for a, b in ((own.head, other.head), (own.tail, other.tail)))
        states = dict.fromkeys((*(own.cases or ()), *(other.cases or ()), *self.symbols.states))
        return [
            state
            for state in states
            if not (is_outside_same and _texts(own.case(state)) == _texts(other.case(state)) and not self.inlined())
            and self._forms(own, state) != self._plain(other, state)
        ]

    def _forms(self, body: StateBlocks, state: str) -> Forms:
        return with_actions(self._plain(body, state), self._action_forms())

    def _plain(self, body: StateBlocks, state: str) -> Forms:
        forms = PlainForms(self.symbols)
        parts = (body.head, body.case(state), body.tail)
        return tuple(form for tokens in parts for form in forms.block(tokens))

    def inlined(self) -> list[str]:
        """The functions with added hand-written code, which the other file has at the place of the call."""
        added = [name for name in self.own.functions if name not in self.other.functions]
        return [name for name in added if self.own.functions[name].short_name.startswith("do_")]

    def _action_forms(self) -> dict[str, Forms]:
        forms = PlainForms(self.symbols)
        found = {}
        for name in self.inlined():
            item = self.own.functions[name]
            found[item.short_name] = forms.block([token for token in item.body if not is_mark(token)])
        return found


def is_same_cpp_program(result: CppFile, written: CppFile, symbols: CppSymbols) -> bool:
    """Whether two files are the same program with the same comments.

    Args:
        result: The generated file with the patch of what was not understood.
        written: The file that the person wrote.
        symbols: The names in both.
    """
    return result.others() == written.others() and not CppComparison(result, written, symbols).different()


def _texts(tokens: Sequence[CppToken]) -> list[str]:
    return [token.text for token in tokens if not is_mark(token)]


def _head(item: CppItem) -> list[str]:
    """The tokens before the body: a constructor passes on numbers, but calculates nothing."""
    return [plain_token(token.text) for token in item.head]


def _outer_comments(item: CppItem) -> tuple[str, ...]:
    inner = len(item.head) + len(item.body) + 2
    start = next((at for at, token in enumerate(item.tokens) if token.kind != COMMENT), 0)
    return (*comment_words(item.tokens[:start]), "{", *comment_words(item.tokens[start + inner :]))
