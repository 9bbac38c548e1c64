"""Decisions as text: the table of transitions and the pseudocode of a state."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import replace

from vicode.docsite.doc_text import render_facts, summarize
from vicode.docsite.name_linker import NameLinker
from vicode.docsite.syntax_highlighting import highlight_block
from vicode.docsite.urls import SiteUrls, path_anchor
from vicode.docsite.views import CodeBlock, PseudocodeLine, RichText, TextSpan, TransitionRow
from vicode.findings import DesignPath
from vicode.languages import language_title
from vicode.model.design import COMMON, Code, Decision, DecisionGroup, Design, Guard, Transition
from vicode.model.disabled import disabled_states, is_enabled
from vicode.model.traversal import LocatedDecision, is_exhaustive, iter_decisions
from vicode.model.words import describe_fields

CodeLinks = Mapping[DesignPath, tuple[TextSpan, ...]]
"""Links into the code pages of a component, by the path of the node."""

_AND, _XABSL_AND = TextSpan(text=" and ", css_class="k"), TextSpan(text=" && ", css_class="k")


def code_blocks(code: Code) -> tuple[CodeBlock, ...]:
    """One block of code per language."""
    return tuple(
        CodeBlock(language=language_title(language), html=highlight_block(text, language))
        for language, text in code.texts
    )


def guard_text(guard: Guard, linker: NameLinker) -> RichText:
    """A guard as text; empty if it always holds."""
    parts: list[TextSpan] = []
    joint = _XABSL_AND if linker.is_xabsl else _AND
    if guard.when:
        parts += linker.expression(guard.when)
    if guard.after:
        parts += [joint] if parts else []
        parts += linker.timer(guard.after)
    if guard.code is not None:
        parts += [joint] if parts else []
        parts.append(TextSpan(text="custom code", css_class="code-guard", title="Condition in code"))
    return tuple(parts)


def numbered_decisions(design: Design) -> Iterator[tuple[int, LocatedDecision]]:
    """All transitions and stay decisions with their order in their source."""
    orders: Counter[str] = Counter()
    for located in iter_decisions(design):
        if not isinstance(located.decision, DecisionGroup):
            orders[located.source] += 1
            yield orders[located.source], located


def transition_rows(design: Design, linker: NameLinker, addresses: SiteUrls) -> Iterator[TransitionRow]:
    """All transitions and stay decisions, in the order in which they are tested."""
    off = disabled_states(design)
    for order, located in numbered_decisions(design):
        is_common = located.source == COMMON
        common = TextSpan(text="every state", href=addresses.design_path(design.component, ("common",)))
        source = common if is_common else linker.state(located.source)
        guard = located.decision.guard
        timer = linker.duration(guard.after) if guard.after else ()
        yield TransitionRow(
            order=TextSpan(text=str(order), href=f"#{path_anchor(located.path)}"),
            source=source,
            guards=_guard_texts(located, linker),
            timer=timer,
            target=_target(located.decision, linker),
            doc_html=render_facts(located.decision.doc, _facts(located.decision)),
            is_disabled=not is_enabled(located, off),
        )


def pseudocode_lines(
    items: tuple[Decision, ...], linker: NameLinker, path: DesignPath, places: CodeLinks
) -> tuple[PseudocodeLine, ...]:
    """The decisions at `path` as pseudocode; empty if there are none."""
    lines = tuple(
        replace(line, anchor=path_anchor(of), code_links=places.get(of, ())) if of else line
        for of, line in _pseudocode(items, linker, path, 0)
    )
    if not items or any(is_exhaustive(item) for item in items):
        return lines
    is_common = path[0] == "common"
    last = "transitions of the state" if is_common else "stay"
    before = "else " if _ends_evaluation(items[-1]) else ""
    return (*lines, PseudocodeLine(depth=0, parts=(TextSpan(text=before + last, css_class="k"),)))


def _guard_texts(located: LocatedDecision, linker: NameLinker) -> tuple[RichText, ...]:
    """The guards that must hold, those of enclosing groups first."""
    lines: list[RichText] = []
    for group, is_then in located.groups:
        line = guard_text(group.guard, linker)
        if line and is_then:
            lines.append(line)
        elif line:
            negation = "!" if linker.is_xabsl else "not "
            lines.append((TextSpan(text=negation, css_class="k"), TextSpan(text="("), *line, TextSpan(text=")")))
    own = located.decision.guard
    rest = Guard(when=own.when, code=own.code)
    if not rest.is_empty:
        lines.append(guard_text(rest, linker))
    return tuple(_operand(line, linker) for line in lines) if len(lines) > 1 else tuple(lines)


def _operand(line: RichText, linker: NameLinker) -> RichText:
    """An operand of &&, in parentheses if an operator in it has a lower precedence."""
    depth = 0
    for span in line if linker.is_xabsl else ():
        if depth == 0 and span.css_class == "k" and any(sign in span.text for sign in ("||", "?")):
            return (TextSpan(text="("), *line, TextSpan(text=")"))
        depth += span.text.count("(") - span.text.count(")")
    return line


def _target(decision: Decision, linker: NameLinker) -> TextSpan:
    return linker.state(decision.to) if isinstance(decision, Transition) else TextSpan(text="stays", css_class="muted")


def _pseudocode(
    items: tuple[Decision, ...], linker: NameLinker, path: DesignPath, depth: int
) -> Iterator[tuple[DesignPath, PseudocodeLine]]:
    """Lines with the path of the decision that starts there, or ()."""
    for index, item in enumerate(items):
        here = (*path, index)
        guard = guard_text(item.guard, linker)
        blocks = code_blocks(item.guard.code) if item.guard.code else ()
        is_group = isinstance(item, DecisionGroup)
        text = " ".join(item.doc.split())
        text = text if guard or is_group else summarize(text)
        doc = "; ".join(part for part in (text, *_facts(item)) if part)
        deeper = depth + (bool(guard) or is_group)
        before = "else " if index and _ends_evaluation(items[index - 1]) else ""
        if guard or is_group:
            test = (TextSpan(text=f"{before}if ", css_class="k"), *guard)
            parts = test if guard else (TextSpan(text="always", css_class="k"),)
            yield here, PseudocodeLine(depth=depth, parts=parts, doc=doc, is_disabled=item.disabled, blocks=blocks)
        if isinstance(item, DecisionGroup):
            yield from _pseudocode(item.then, linker, (*here, "then"), deeper)
            if item.otherwise and guard:
                parts = (TextSpan(text="else", css_class="k"),)
                yield (), PseudocodeLine(depth=depth, parts=parts, is_disabled=item.disabled)
                yield from _pseudocode(item.otherwise, linker, (*here, "else"), deeper)
        else:
            parts, doc = _outcome(item, linker, "" if guard else before), "" if guard else doc
            yield () if guard else here, PseudocodeLine(depth=deeper, parts=parts, doc=doc, is_disabled=item.disabled)


def _facts(decision: Decision) -> tuple[str, ...]:
    """What is said of a decision besides its guard, target and description."""
    fields = describe_fields(decision, ("to", "doc", "disabled"))
    return (*describe_fields(decision.guard, ("when", "after")), *fields)


def _ends_evaluation(item: Decision) -> bool:
    """Whether no later decision is tested if the guard of this one holds."""
    if item.disabled:
        return False
    if isinstance(item, DecisionGroup):
        return not item.otherwise and any(is_exhaustive(each) for each in item.then)
    return True


def _outcome(decision: Decision, linker: NameLinker, before: str) -> RichText:
    if isinstance(decision, Transition):
        return (
            TextSpan(text=f"{before}{'goto' if linker.is_xabsl else 'go to'} ", css_class="k"),
            linker.state(decision.to),
        )
    return (TextSpan(text=f"{before}stay", css_class="k"),)
