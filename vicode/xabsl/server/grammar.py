"""A TextMate grammar for VS Code and other editors, generated from the keywords of the language."""

import json
from typing import Any

from vicode.xabsl.tokens import KEYWORDS, OPERATORS

_CONTROL = ("if", "else", "goto", "stay")
_VALUES = ("true", "false", "state_time", "option_time", "action_done", "conflict")
_TYPES = ("float", "bool", "enum", "const", "input", "output", "internal")


def _word_pattern(keywords: tuple[str, ...]) -> str:
    return rf"\b(?:{'|'.join(sorted(keywords))})\b"


def grammar() -> dict[str, Any]:
    other_keywords = tuple(KEYWORDS - {*_CONTROL, *_VALUES, *_TYPES})
    patterns = [
        {"name": "comment.block.documentation.xabsl", "begin": r"/\*\*(?![*/])", "end": r"\*/"},
        {"name": "comment.block.xabsl", "begin": r"/\*", "end": r"\*/"},
        {"name": "comment.line.double-slash.xabsl", "match": r"//.*$"},
        {"name": "string.quoted.double.xabsl", "begin": '"', "end": '"'},
        {"name": "constant.other.range.xabsl", "match": r"\[[^\]]*\]"},
        {"name": "constant.numeric.xabsl", "match": r"\b[0-9]+(?:\.[0-9]*)?"},
        {"name": "keyword.control.xabsl", "match": _word_pattern(_CONTROL)},
        {"name": "constant.language.xabsl", "match": _word_pattern(_VALUES)},
        {"name": "storage.type.xabsl", "match": _word_pattern(_TYPES)},
        {"name": "keyword.other.xabsl", "match": _word_pattern(other_keywords)},
        {"name": "variable.parameter.xabsl", "match": r"@[A-Za-z_][A-Za-z0-9_.]*"},
        {"name": "entity.name.function.xabsl", "match": r"[A-Za-z_][A-Za-z0-9_.]*(?=\s*\()"},
        {"name": "keyword.operator.xabsl", "match": "|".join((*OPERATORS, "[<>!+*/%=?:-]")).replace("||", r"\|\|")},
    ]
    return {
        "name": "XABSL",
        "scopeName": "source.xabsl",
        "fileTypes": ["xabsl"],
        "patterns": patterns,
    }


def grammar_text() -> str:
    return json.dumps(grammar(), indent=2) + "\n"
