"""Reads a program from intermediate code. The input is untrusted and fully validated."""

from collections.abc import Iterator

from .program import CompiledOption, CompiledState, Program, Term, TypedSlot
from .recursion import depth_limit

_MAX_DEPTH, _FRAMES_PER_LEVEL = 2500, 4
_BINARY = {"d": frozenset("+-*d%"), "b": frozenset("=n<l>g")}
_KINDS = ("d", "b", "e")


class CodeError(ValueError):
    """A text is not intermediate code. The message contains the number of the word."""


class _WordReader:
    """Reads the words of a text in order."""

    def __init__(self, text: str) -> None:
        lines = (line for line in text.splitlines() if not line.lstrip().startswith("//"))
        self.words: Iterator[str] = iter(" ".join(lines).split())
        self.number = 0
        self.max_depth = depth_limit(_MAX_DEPTH, _FRAMES_PER_LEVEL)

    def next(self) -> str:
        self.number += 1
        word = next(self.words, None)
        if word is None:
            raise self.error("unexpected end of the code")
        return word

    def count(self) -> int:
        word = self.next()
        if not word.isdecimal():
            raise self.error(f"expected a number, found {word[:40]}")
        return int(word)

    def kind(self) -> str:
        word = self.next()
        if word not in _KINDS:
            raise self.error(f"expected d, b or e, found {word[:40]}")
        return word

    def error(self, message: str) -> CodeError:
        return CodeError(f"word {self.number}: {message}")


def read_code(text: str) -> Program:
    """Read a program from the text of its intermediate code.

    Raises:
        CodeError: The text is not valid intermediate code.
    """
    words = _WordReader(text)
    enums = tuple((words.next(), _names(words)) for _ in range(words.count()))
    symbols = tuple(_slot(words) for _ in range(words.count()))
    heads = [(words.next(), tuple(_slot(words) for _ in range(words.count()))) for _ in range(words.count())]
    options = tuple(_option(words, name, slots) for name, slots in heads)
    agents = tuple((words.next(), words.next()) for _ in range(words.count()))
    return Program(options, agents, enums, symbols, _title(text))


def _title(text: str) -> str:
    first = text.split("\n", 1)[0]
    return first.partition("for the agents of ")[2].strip() if first.startswith("//") else ""


def _names(words: _WordReader) -> tuple[str, ...]:
    return tuple(words.next() for _ in range(words.count()))


def _slot(words: _WordReader) -> TypedSlot:
    kind = words.kind()
    enum = words.next() if kind == "e" else ""
    return TypedSlot(kind, words.next(), enum)


def _option(words: _WordReader, name: str, parameters: tuple[TypedSlot, ...]) -> CompiledOption:
    heads = []
    for _ in range(words.count()):
        state, mode = words.next(), words.next()
        if mode not in ("n", "c", "s"):
            raise words.error(f"expected n, c or s, found {mode[:40]}")
        heads.append((state, mode, words.count() if mode != "n" else 0))
    initial = words.next()
    states = []
    for state, mode, robots in heads:
        is_target = words.count() == 1
        actions = tuple(_action(words) for _ in range(words.count()))
        states.append(CompiledState(state, _tree(words, 0), actions, is_target, mode, robots))
    return CompiledOption(name, initial, tuple(states), parameters)


def _action(words: _WordReader) -> Term:
    letter, name = words.next(), words.next()
    if letter in ("o", "a"):
        return (letter, name, _arguments(words, 0))
    if letter not in _KINDS:
        raise words.error(f"expected an action, found {letter[:40]}")
    return (letter, name, _value(words, letter, 0))


def _arguments(words: _WordReader, depth: int) -> tuple[Term, ...]:
    arguments: list[Term] = []
    for _ in range(words.count()):
        kind = words.kind()
        head = (kind, words.next(), words.next()) if kind == "e" else (kind, words.next())
        arguments.append((*head, _value(words, kind, depth)))
    return tuple(arguments)


def _tree(words: _WordReader, depth: int) -> Term:
    letter = words.next()
    if letter == "t":
        return ("t", words.next())
    if letter != "i" or depth > words.max_depth:
        raise words.error(f"expected a decision, found {letter[:40]}" if letter != "i" else "nested too deeply")
    return ("i", _value(words, "b", depth), _tree(words, depth + 1), _tree(words, depth + 1))


def _value(words: _WordReader, kind: str, depth: int) -> Term:
    letter = words.next()
    if depth > words.max_depth:
        raise words.error("nested too deeply")
    depth += 1
    if letter in "op" and len(letter) == 1:
        return (letter, words.next())
    if letter == "i":
        return ("i", words.next(), _arguments(words, depth))
    if letter == "v":
        return ("v", _literal(words, kind))
    if letter == "q":
        return ("q", _value(words, "b", depth), _value(words, kind, depth), _value(words, kind, depth))
    if kind == "d":
        return _decimal(words, letter, depth)
    if kind == "b":
        return _boolean(words, letter, depth)
    raise words.error(f"expected an enum, found {letter[:40]}")


def _literal(words: _WordReader, kind: str) -> float | bool | str:
    word = words.next()
    if kind == "e":
        return word
    if kind == "b":
        if word not in ("true", "false"):
            raise words.error(f"expected true or false, found {word[:40]}")
        return word == "true"
    try:
        return float(word)
    except ValueError:
        raise words.error(f"expected a number, found {word[:40]}") from None


def _decimal(words: _WordReader, letter: str, depth: int) -> Term:
    if letter == "c":
        word = words.next()
        try:
            float(word)
        except ValueError:
            raise words.error(f"expected a number, found {word[:40]}") from None
        return ("c", word)
    if letter in ("s", "t"):
        return (letter,)
    if letter not in _BINARY["d"]:
        raise words.error(f"expected a decimal, found {letter[:40]}")
    return (letter, _value(words, "d", depth), _value(words, "d", depth))


def _boolean(words: _WordReader, letter: str, depth: int) -> Term:
    if letter in ("t", "x"):
        return (letter,)
    if letter == "!":
        return ("!", _value(words, "b", depth))
    if letter == "c":
        return ("c", _value(words, "e", depth), _value(words, "e", depth))
    if letter in ("&", "|"):
        return (letter, *(_value(words, "b", depth) for _ in range(words.count())))
    if letter not in _BINARY["b"]:
        raise words.error(f"expected a bool, found {letter[:40]}")
    return (letter, _value(words, "d", depth), _value(words, "d", depth))
