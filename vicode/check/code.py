"""Rules about hand-written code: it parses, it is there in every language. It is never run."""

import ast
import re
from collections.abc import Iterator
from functools import lru_cache

from vicode import regions
from vicode.check.context import RuleContext
from vicode.findings import Finding, Span, did_you_mean
from vicode.model.project import LANGUAGES
from vicode.model.python_parser import check_compiles, parse_module
from vicode.model.snippets import PythonSnippet


def find_unparsable_code(context: RuleContext) -> Iterator[Finding]:
    """D412: Python that does not parse, or that would not be a plain function."""
    for placed in context.code_blocks:
        text = placed.code.in_language("python")
        problem = validate_python(text, placed.role) if text else None
        if problem is not None:
            message, span = problem
            yield context.make_finding("D412", (*placed.path, "python"), message, span=span, languages=("python",))


def find_missing_languages(context: RuleContext) -> Iterator[Finding]:
    """D414: an action or predicate without its code in a language of the project."""
    for placed in context.code_blocks:
        written = [language for language, _text in placed.code.texts]
        missing = [
            language for language in context.project.languages if language in LANGUAGES and language not in written
        ]
        if missing and placed.role in ("action", "predicate"):
            names = " and ".join(missing)
            message, mend = f"this code is not written in {names}", f"add it in {names}"
            yield context.make_finding("D414", placed.path, message, mend, languages=tuple(missing))


def find_unknown_languages(context: RuleContext) -> Iterator[Finding]:
    """P204: code in a language that vicode does not generate."""
    for placed in context.code_blocks:
        for language, _text in placed.code.texts:
            if language not in LANGUAGES:
                mend = did_you_mean(language, LANGUAGES, f"known are {', '.join(LANGUAGES)}")
                path = (*placed.path, language)
                yield context.make_finding("P204", path, f"there is no language '{language}'", mend, is_key=True)


def find_empty_predicates(context: RuleContext) -> Iterator[Finding]:
    """D415: a predicate that returns nothing because it has no code."""
    for placed in context.code_blocks:
        if placed.role != "predicate":
            continue
        for language, text in placed.code.texts:
            if not _strip_comments(text, language).strip():
                path = (*placed.path, language)
                mend = "return a condition, or delete 'code' to leave the decision without one"
                message = "this predicate has no code, so it never holds"
                yield context.make_finding("D415", path, message, mend, languages=(language,))


@lru_cache(maxsize=20_000)
def validate_python(text: str, role: str) -> tuple[str, Span] | None:
    """Why a piece of Python cannot stand where its role puts it, with the guilty characters; None when it can."""
    stray = re.search(r"\r(?!\n)", text)
    if stray:
        return "this contains a carriage return", stray.span()
    marks = regions.find_regions(text) if "vicode" in text else regions.ParsedRegions()
    if marks.regions or marks.findings:
        return "this contains a mark of generated files", (0, len(text))
    copy = PythonSnippet.from_text(text, role)
    try:
        tree = parse_module(copy.source)
        check_compiles(tree)
    except SyntaxError as error:
        return _format_syntax_error(error.msg), copy.span_at(error.lineno or 1, (error.offset or 1) - 1)
    except (ValueError, RecursionError, MemoryError, OverflowError) as error:
        return f"this cannot be read as Python: {error}", (0, len(text))
    found = _find_yield(tree.body[0]) if role in ("action", "predicate") else None
    return ("with 'yield' this would never run", copy.span_at(found.lineno, found.col_offset)) if found else None


def _find_yield(function: ast.stmt) -> ast.Yield | ast.YieldFrom | None:
    """A `yield` that would make a generator of a function."""
    waiting: list[ast.AST] = [function]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Yield | ast.YieldFrom):
            return node
        is_inner = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda) and node is not function
        waiting += () if is_inner else ast.iter_child_nodes(node)
    return None


def _format_syntax_error(message: str) -> str:
    return f"this is not Python: {message[:1].lower()}{message[1:]}"


def _strip_comments(text: str, language: str) -> str:
    pattern = r"#.*" if language == "python" else r"//.*|/\*(?s:.*?)\*/"
    return re.sub(pattern, "", text)


RULES = (find_unparsable_code, find_missing_languages, find_unknown_languages, find_empty_predicates)
