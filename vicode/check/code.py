"""Rules about hand-written code: it parses, it is there in every language. It is never run."""

import ast
import re
import textwrap
import warnings
from collections.abc import Iterator
from functools import lru_cache

from vicode.check.context import Context
from vicode.findings import Finding, Span, did_you_mean
from vicode.model.project import LANGUAGES

# What stands before each line of a code, by its role, so that it parses where it will stand.
_AROUND = {
    "module": "",
    "members": "class _:\n pass\n",
    "action": "def _(self):\n pass\n",
    "predicate": "def _(self):\n pass\n",
}


def find_unparsable_code(context: Context) -> Iterator[Finding]:
    """D412: Python that does not parse, or that would not be a plain function."""
    for placed in context.codes:
        text = placed.code.in_language("python")
        problem = python_problem(text, placed.role) if text else None
        if problem is not None:
            message, span = problem
            yield context.find("D412", _path_of(placed.path, len(placed.code.texts), "python"), message, span=span)


def find_missing_languages(context: Context) -> Iterator[Finding]:
    """D414: an action or predicate without its code in a language of the project."""
    for placed in context.codes:
        written = [language for language, _text in placed.code.texts]
        missing = [language for language in context.project.languages if language not in written]
        if missing and placed.role in ("action", "predicate"):
            names = " and ".join(missing)
            yield context.find("D414", placed.path, f"this code is not written in {names}", f"add it in {names}")


def find_unknown_languages(context: Context) -> Iterator[Finding]:
    """P204: code in a language that vicode does not generate."""
    for placed in context.codes:
        for language, _text in placed.code.texts:
            if language not in LANGUAGES:
                mend = did_you_mean(language, LANGUAGES, f"known are {', '.join(LANGUAGES)}")
                path = _path_of(placed.path, len(placed.code.texts), language)
                yield context.find("P204", path, f"there is no language '{language}'", mend, of_key=True)


def find_empty_predicates(context: Context) -> Iterator[Finding]:
    """D415: a predicate that returns nothing because it has no code."""
    for placed in context.codes:
        if placed.role != "predicate":
            continue
        for language, text in placed.code.texts:
            if not _without_remarks(text, language).strip():
                path = _path_of(placed.path, len(placed.code.texts), language)
                mend = "return a condition, or delete 'code' to leave the decision without one"
                yield context.find("D415", path, "this predicate has no code, so it never holds", mend)


@lru_cache(maxsize=20_000)
def python_problem(text: str, role: str) -> tuple[str, Span] | None:
    """Why a piece of Python cannot stand where its role puts it, with the guilty characters; None when it can."""
    before = _AROUND.get(role, "")
    lines = _lines_of(text)
    straight = textwrap.dedent("\n".join(lines)).split("\n")
    source = before + "\n".join((" " if before and line else "") + line for line in straight) + "\n"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(source)
            compile(tree, "<code>", "exec", dont_inherit=True)
    except SyntaxError as error:
        line, column = (error.lineno or 1) - 1 - before.count("\n"), (error.offset or 1) - 1 - bool(before)
        return _reworded(error.msg), _span(lines, straight, line, column)
    except (ValueError, RecursionError, MemoryError, OverflowError) as error:
        return f"this cannot be read as Python: {error}", (0, len(text))
    if before and len(tree.body) > 1:
        return "this ends the function it stands in", (0, len(text))
    return _generator_problem(tree, lines, straight, before)


def _generator_problem(tree: ast.Module, lines: list[str], straight: list[str], before: str) -> tuple[str, Span] | None:
    """A `yield` makes a generator of the function, which then never runs."""
    waiting: list[ast.AST] = list(tree.body[:1]) if before.startswith("def") else []
    body: list[ast.AST] = [child for node in waiting for child in ast.iter_child_nodes(node)]
    while body:
        node = body.pop()
        if isinstance(node, ast.Yield | ast.YieldFrom):
            line, column = node.lineno - 1 - before.count("\n"), node.col_offset - 1
            return "with 'yield' this would never run", _span(lines, straight, line, column)
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda | ast.ClassDef):
            body += ast.iter_child_nodes(node)
    return None


def _lines_of(text: str) -> list[str]:
    """Lines as Python counts them, every character kept at its place."""
    return text.replace("\r\n", " \n").replace("\r", "\n").split("\n")


def _span(lines: list[str], straight: list[str], line: int, column: int) -> Span:
    """One character of a text, from the line and column Python names in the copy without its margin."""
    line = max(0, min(line, len(lines) - 1))
    margin = max(0, len(lines[line]) - len(straight[line])) if line < len(straight) else 0
    column = max(0, min(column + margin, len(lines[line]) - 1))
    start = sum(len(each) + 1 for each in lines[:line]) + column
    return (start, start + 1)


def _reworded(message: str) -> str:
    return f"this is not Python: {message[:1].lower()}{message[1:]}"


def _without_remarks(text: str, language: str) -> str:
    pattern = r"#.*" if language == "python" else r"//.*|/\*(?s:.*?)\*/"
    return re.sub(pattern, "", text)


def _path_of(path: tuple[str | int, ...], texts: int, language: str) -> tuple[str | int, ...]:
    """A lone text stands at `code` itself, one of several under its language."""
    return path if texts == 1 and language == "python" else (*path, language)


RULES = (find_unparsable_code, find_missing_languages, find_unknown_languages, find_empty_predicates)
