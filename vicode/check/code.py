"""Rules for hand-written code. The code is parsed, but never run."""

import ast
import re
from collections.abc import Iterator
from functools import lru_cache

from vicode import regions
from vicode.check.context import RuleContext
from vicode.findings import Finding, Span, did_you_mean
from vicode.languages import GENERATED_LANGUAGES, LANGUAGES, language_title
from vicode.model.design import COMMON, Design, RunCode
from vicode.model.names import identifier_stem
from vicode.model.portable_code import NotPortable, Role, parse_portable
from vicode.model.python_parser import check_compiles, parse_module
from vicode.model.snippets import PythonSnippet
from vicode.model.traversal import LocatedCode

_RENAME = "rename the method, or move its code to the design element that it stands for"


def find_unparsable_code(context: RuleContext) -> Iterator[Finding]:
    """D412: invalid Python, or Python that cannot be the body of a plain function."""
    for placed in context.code_blocks:
        text = placed.code.in_language("python")
        problem = validate_python(text, placed.role) if text else None
        if problem is not None:
            message, span = problem
            yield context.make_finding("D412", (*placed.path, "python"), message, span=span, languages=("python",))


def find_missing_languages(context: RuleContext) -> Iterator[Finding]:
    """D414: an action or predicate without code in a target language into which it cannot be translated.

    Designs with code are not generated as JavaScript (L705).
    """
    wanted = [
        language
        for language in context.project.languages
        if language in GENERATED_LANGUAGES and language != "javascript"
    ]
    for placed in context.code_blocks:
        if placed.role not in ("action", "predicate"):
            continue
        written = [language for language, _text in placed.code.texts]
        missing = [language for language in wanted if language not in written]
        problem = _find_unportable(context, placed) if "cpp" in missing and "python" in written else None
        if "python" in written and problem is None:
            missing = [language for language in missing if language != "cpp"]
        if not missing:
            continue
        names = " and ".join(language_title(language) for language in missing)
        message, fix = f"this code is missing in {names}", f"add the code in {names}"
        if problem is not None:
            where = f"state '{placed.state}', " if placed.state and placed.state != COMMON else ""
            message += f"; it cannot be translated from Python ({where}line {problem.line}: {problem.reason})"
        yield context.make_finding("D414", placed.path, message, fix, languages=tuple(missing))


def _find_unportable(context: RuleContext, placed: LocatedCode) -> NotPortable | None:
    role: Role = "predicate" if placed.role == "predicate" else "action"
    portable = parse_portable(placed.code.in_language("python") or "", role, context.scope)
    return portable if isinstance(portable, NotPortable) else None


def find_unknown_languages(context: RuleContext) -> Iterator[Finding]:
    """P204: code in an unknown language."""
    for placed in context.code_blocks:
        for language, _text in placed.code.texts:
            if language not in LANGUAGES:
                fix = did_you_mean(language, LANGUAGES, f"use one of {', '.join(LANGUAGES)}")
                path = (*placed.path, language)
                yield context.make_finding("P204", path, f"unknown language '{language}'", fix, is_key=True)


def find_empty_predicates(context: RuleContext) -> Iterator[Finding]:
    """D415: a predicate without code."""
    for placed in context.code_blocks:
        if placed.role != "predicate":
            continue
        for language, text in placed.code.texts:
            if not _strip_comments(text, language).strip():
                path = (*placed.path, language)
                fix = "return a condition, or delete 'code' if the transition has no guard"
                message = "this predicate has no code, so it never holds"
                yield context.make_finding("D415", path, message, fix, languages=(language,))


@lru_cache(maxsize=20_000)
def validate_python(text: str, role: str) -> tuple[str, Span] | None:
    """Return the problem with Python code in its role and the affected span, None if the code is valid."""
    stray = re.search(r"\r(?!\n)", text)
    if stray:
        return "this contains a carriage return", stray.span()
    marks = regions.find_regions(text) if "vicode" in text else regions.ParsedRegions()
    if marks.regions or marks.findings:
        return "this contains a region mark of generated files", (0, len(text))
    snippet = PythonSnippet.from_text(text, role)
    try:
        tree = parse_module(snippet.source)
        check_compiles(tree)
    except SyntaxError as error:
        return _format_syntax_error(error.msg), snippet.span_at(error.lineno or 1, (error.offset or 1) - 1)
    except (ValueError, RecursionError, MemoryError, OverflowError) as error:
        return f"this cannot be parsed as Python: {error}", (0, len(text))
    node = _find_yield(tree.body[0]) if role in ("action", "predicate") else None
    if node is None:
        return None
    return "'yield' is not allowed: the code would become a generator", snippet.span_at(node.lineno, node.col_offset)


def _find_yield(function: ast.stmt) -> ast.Yield | ast.YieldFrom | None:
    pending: list[ast.AST] = [function]
    while pending:
        node = pending.pop()
        if isinstance(node, ast.Yield | ast.YieldFrom):
            return node
        is_inner = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda) and node is not function
        pending += () if is_inner else ast.iter_child_nodes(node)
    return None


def _format_syntax_error(message: str) -> str:
    return f"invalid Python: {message[:1].lower()}{message[1:]}"


def _strip_comments(text: str, language: str) -> str:
    return re.sub(LANGUAGES.get(language, LANGUAGES["cpp"]).comment, "", text)


def find_hidden_methods(context: RuleContext) -> Iterator[Finding]:
    """D432: a method in class code with the name of a generated one, which Python never calls then."""
    text = context.design.members.in_language("python") or ""
    if "def " not in text or validate_python(text, "members") is not None:
        return
    generated = _generated_methods(context.design)
    snippet = PythonSnippet.from_text(text, "members")
    for node in ast.walk(parse_module(snippet.source)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name in generated:
            message = f"the method '{node.name}' hides the generated one, so {generated[node.name]} has no effect"
            span = snippet.span_at(node.lineno, node.col_offset)
            yield context.make_finding(
                "D432", ("members", "python"), message, _RENAME, span=span, languages=("python",)
            )


def _generated_methods(design: Design) -> dict[str, str]:
    """Return what the generated methods stand for, by name."""
    common = design.common
    methods = {"_decide_common": "each common transition"} if common.transitions else {}
    methods |= {"_act_common": "each common action"} if common.actions else {}
    methods |= {"modulate": "each parameter"} if design.parameters else {}
    for state in design.states:
        stem = identifier_stem(state.name)
        methods[f"_in_{stem}"] = f"state {state.name}"
        for phase, actions in (("enter", state.enter), ("leave", state.leave)):
            methods |= {f"_{phase}_{stem}": f"the {phase} action of state {state.name}"} if actions else {}
        if any(isinstance(action, RunCode) for action in state.actions):
            methods[f"_do_{stem}"] = f"the action of state {state.name}"
    return methods


RULES = (
    find_unparsable_code,
    find_missing_languages,
    find_unknown_languages,
    find_empty_predicates,
)
WARNINGS = (find_hidden_methods,)
