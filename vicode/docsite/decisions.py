"""Decisions to read: the table of transitions, and the pseudo code of a state."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import replace

from vicode.docsite.addresses import Addresses, anchor_of
from vicode.docsite.docs import line_html_of, summary_of
from vicode.docsite.linking import Linker
from vicode.docsite.listings import TITLES, block_of
from vicode.docsite.views import CodeBlock, Line, Part, PseudoLine, TransitionRow
from vicode.findings import Path
from vicode.model.design import COMMON, Code, Decision, Design, Group, Guard, Transition
from vicode.model.enabling import disabled_states, is_working
from vicode.model.walks import Located, always_holds, walk_decisions

Places = Mapping[Path, tuple[Part, ...]]
"""Where a thing stands in the texts of its component."""

_AND = Part(text=" and ", kind="k")


def blocks_of(code: Code) -> tuple[CodeBlock, ...]:
    """Code in all its languages."""
    return tuple(
        CodeBlock(language=TITLES.get(language, language), html=block_of(text, language))
        for language, text in code.texts
    )


def guard_line(guard: Guard, linker: Linker) -> Line:
    """A guard in words, "" for one that always holds."""
    parts: list[Part] = []
    if guard.when:
        parts += linker.expression(guard.when)
    if guard.after:
        parts += [_AND] if parts else []
        parts += [Part(text="after ", kind="k"), *linker.time(guard.after)]
    if guard.code is not None:
        parts += [_AND] if parts else []
        parts.append(Part(text="code holds", kind="code-sign", title="A condition written as code"))
    return tuple(parts)


def transition_rows(design: Design, linker: Linker, addresses: Addresses) -> Iterator[TransitionRow]:
    """Every transition and every stay, in the order in which they are tested."""
    orders: Counter[str] = Counter()
    off = disabled_states(design)
    for located in walk_decisions(design):
        if isinstance(located.decision, Group):
            continue
        orders[located.source] += 1
        is_common = located.source == COMMON
        common = Part(text="every state", href=addresses.thing(design.component, ("common",)))
        source = common if is_common else linker.state(located.source)
        guard = located.decision.guard
        timer = linker.time(guard.after) if guard.after else ()
        yield TransitionRow(
            order=Part(text=str(orders[located.source]), href=f"#{anchor_of(located.path)}"),
            source=source,
            guards=tuple(_guards(located, linker)),
            timer=timer,
            target=_target(located.decision, linker),
            doc_html=line_html_of(located.decision.doc),
            is_off=not is_working(located, off),
        )


def pseudo_lines(items: tuple[Decision, ...], linker: Linker, path: Path, places: Places) -> tuple[PseudoLine, ...]:
    """The decisions as code to read; `path` leads to them. Nothing where nothing is decided."""
    lines = tuple(
        replace(line, anchor=anchor_of(of), places=places.get(of, ())) if of else line
        for of, line in _pseudo(items, linker, path, 0)
    )
    if not items or any(always_holds(item) for item in items):
        return lines
    is_common = path[0] == "common"
    last = "what the state itself decides" if is_common else "stay"
    before = "else " if _ends(items[-1]) else ""
    return (*lines, PseudoLine(depth=0, parts=(Part(text=before + last, kind="k"),)))


def _guards(located: Located, linker: Linker) -> Iterator[Line]:
    for group, is_then in located.groups:
        line = guard_line(group.guard, linker)
        if line and is_then:
            yield line
        elif line:
            yield (Part(text="not ", kind="k"), Part(text="("), *line, Part(text=")"))
    own = located.decision.guard
    rest = Guard(when=own.when, code=own.code)
    if not rest.is_empty:
        yield guard_line(rest, linker)


def _target(decision: Decision, linker: Linker) -> Part:
    return linker.state(decision.to) if isinstance(decision, Transition) else Part(text="stays", kind="muted")


def _pseudo(items: tuple[Decision, ...], linker: Linker, path: Path, depth: int) -> Iterator[tuple[Path, PseudoLine]]:
    """Lines, each with the path of the decision that begins there, () for none."""
    for index, item in enumerate(items):
        here = (*path, index)
        guard = guard_line(item.guard, linker)
        blocks = blocks_of(item.guard.code) if item.guard.code else ()
        doc = " ".join(item.doc.split())
        is_group = isinstance(item, Group)
        deeper = depth + (bool(guard) or is_group)
        before = "else " if index and _ends(items[index - 1]) else ""
        if guard or is_group:
            test = (Part(text=f"{before}if ", kind="k"), *guard)
            parts = test if guard else (Part(text="always", kind="k"),)
            yield here, PseudoLine(depth=depth, parts=parts, doc=doc, is_off=item.disabled, blocks=blocks)
        if isinstance(item, Group):
            yield from _pseudo(item.then, linker, (*here, "then"), deeper)
            if item.otherwise and guard:
                parts = (Part(text="else", kind="k"),)
                yield (), PseudoLine(depth=depth, parts=parts, is_off=item.disabled)
                yield from _pseudo(item.otherwise, linker, (*here, "else"), deeper)
        else:
            parts, doc = _outcome(item, linker, "" if guard else before), "" if guard else summary_of(doc)
            yield () if guard else here, PseudoLine(depth=deeper, parts=parts, doc=doc, is_off=item.disabled)


def _ends(item: Decision) -> bool:
    """Whether nothing after a decision is tested when its guard holds."""
    if item.disabled:
        return False
    if isinstance(item, Group):
        return not item.otherwise and any(always_holds(each) for each in item.then)
    return True


def _outcome(decision: Decision, linker: Linker, before: str) -> Line:
    if isinstance(decision, Transition):
        return (Part(text=f"{before}go to ", kind="k"), linker.state(decision.to))
    return (Part(text=f"{before}stay", kind="k"),)
