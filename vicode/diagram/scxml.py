"""Writes a design as SCXML, if SCXML can say it with the same meaning."""

from collections.abc import Iterable, Iterator
from xml.sax.saxutils import quoteattr

from vicode.diagram.export_formats import NotExportableError
from vicode.model.design import Action, Assign, Decision, Declaration, Design, State, Stay, Transition
from vicode.model.disabled import strip_disabled
from vicode.model.expressions import (
    Binary,
    Boolean,
    Comparison,
    Expr,
    FunctionCall,
    Logic,
    Minus,
    Not,
    Number,
    OutputRef,
    Scope,
    Variable,
    build_scope,
    parse_expression,
)
from vicode.model.project import Interface, Project

_NAMESPACE = "http://www.w3.org/2005/07/scxml"
_TRIGONOMETRY = ("sin", "cos", "tan", "atan2", "asin", "acos", "atan", "hypot")
_FUNCTIONS = frozenset({*_TRIGONOMETRY, "abs", "min", "max", "floor", "ceil", "sqrt", "exp", "log", "sign"})
_OPERATORS = {"==": "===", "!=": "!==", "and": "&&", "or": "||"}


def write_scxml(design: Design) -> str:
    """Write a design as SCXML; events are the bool inputs that its guards test.

    Raises:
        NotExportableError: SCXML cannot say it.
    """
    design = strip_disabled(design)
    _check_design(design)
    scope = build_scope(_project(design), design)
    lines = ['<?xml version="1.0" encoding="UTF-8"?>']
    head = f'<scxml xmlns="{_NAMESPACE}" version="1.0" datamodel="ecmascript" initial={quoteattr(design.initial)}>'
    lines += [head, *_data(design, scope)]
    for state in design.states:
        lines += _state(design, state, scope)
    return "\n".join([*lines, "</scxml>", ""])


def _check_design(design: Design) -> None:
    if not design.states:
        raise NotExportableError("a document of SCXML has a state")
    for is_used, part in (
        (design.frequency_hz is not None, "frequency"),
        (design.resume, "resume"),
        (bool(design.parameters), "parameters"),
        (bool(design.common.actions), "common actions"),
        (bool(design.arithmetic), f"arithmetic: {design.arithmetic}"),
        (bool(design.time_unit), f"time_unit: {design.time_unit}"),
    ):
        if is_used:
            raise NotExportableError(f"SCXML has no counterpart of {part}")
    for state in design.states:
        parts: dict[str, object] = {"requires": state.requires, "modulates": state.modulates, "actions": state.actions}
        parts |= {"capacity": state.capacity, "synchronized": state.synchronized}
        found = [name for name, value in parts.items() if value]
        if found:
            raise NotExportableError(f"SCXML has no counterpart of {found[0]} (state {state.name})")
        if state.final and (state.transitions or design.common.transitions):
            raise NotExportableError(f"a final state of SCXML has no transitions (state {state.name})")


def _project(design: Design) -> Project:
    """The events: all bool outputs that guards name."""
    words = " ".join(each.guard.when for state in design.states for each in _flat(design, state)).split()
    names = {word.strip("()") for word in words if "." in word}
    components = tuple(
        Interface(
            component=use.component,
            outputs=tuple(
                Declaration(name=name.partition(".")[2], type="bool")
                for name in sorted(names)
                if name.partition(".")[0] == use.alias
            ),
        )
        for use in design.uses
    )
    return Project(name="events", components=components, designs=(design,))


def _data(design: Design, scope: Scope) -> Iterator[str]:
    declared = (*design.outputs, *design.variables)
    if declared:
        yield "  <datamodel>"
        for each in declared:
            type_ = scope.type_of(each)
            if type_ not in ("bool", "int", "float"):
                raise NotExportableError(f"'{each.name}' is an enumeration; data of SCXML are numbers and bools here")
            value = _expression(each.initial, scope, type_) if each.initial else "false" if type_ == "bool" else "0"
            yield f"    <data id={quoteattr(each.name)} expr={quoteattr(value)}/>"
        yield "  </datamodel>"


def _flat(design: Design, state: State) -> list[Decision]:
    return [*design.common.transitions, *state.transitions]


def _state(design: Design, state: State, scope: Scope) -> Iterator[str]:
    tag = "final" if state.final else "state"
    yield f"  <{tag} id={quoteattr(state.name)}>"
    decisions = _flat(design, state)
    delays = list(dict.fromkeys(each.guard.after for each in decisions if each.guard.after))
    entered = [
        f"      <send event={quoteattr(_timer(state, delay))} delay={quoteattr(delay + 's')}/>" for delay in delays
    ]
    for name, lines in (
        ("onentry", [*_assigns(state.enter, scope), *entered]),
        ("onexit", [*_assigns(state.leave, scope)]),
    ):
        if lines:
            yield from [f"    <{name}>", *lines, f"    </{name}>"]
    had_event = False
    for decision in decisions:
        text, is_event = _transition(state, decision, scope)
        if had_event and not is_event:
            reason = "tests transitions without event first, but the design has one after an input"
            raise NotExportableError(f"SCXML {reason} (state {state.name})")
        had_event = is_event
        yield f"    {text}"
    yield f"  </{tag}>"


def _transition(state: State, decision: Decision, scope: Scope) -> tuple[str, bool]:
    if not isinstance(decision, Transition | Stay) or decision.guard.code is not None:
        raise NotExportableError(f"SCXML has no groups, and code is not translated (state {state.name})")
    guard, attributes, terms = decision.guard, "", list[Expr]()
    if guard.after and not _is_number(guard.after):
        raise NotExportableError(f"the time '{guard.after}' is not a number (state {state.name})")
    if guard.when:
        tree = _parse(guard.when, scope, "bool")
        terms = list(tree.operands) if isinstance(tree, Logic) and tree.operator == "and" else [tree]
    events = [term for term in terms if isinstance(term, OutputRef)]
    if guard.after:
        attributes = f" event={quoteattr(_timer(state, guard.after))}"
    elif events:
        attributes = f" event={quoteattr(f'{events[0].alias}.{events[0].output}')}"
        terms.remove(events[0])
    if terms:
        attributes += f" cond={quoteattr(' && '.join(_print(term) for term in terms))}"
    if isinstance(decision, Transition) and decision.to != state.name:
        attributes += f" target={quoteattr(decision.to)}"
    return f"<transition{attributes}/>", bool(guard.after or events)


def _timer(state: State, delay: str) -> str:
    return f"{state.name}.after.{delay.replace('.', '_')}"


def _is_number(text: str) -> bool:
    return text.replace(".", "", 1).isdigit()


def _assigns(actions: Iterable[Action], scope: Scope) -> Iterator[str]:
    for action in actions:
        if not isinstance(action, Assign):
            raise NotExportableError("SCXML only assigns: calls and code are not translated")
        for name, value in action.values:
            if "." in name:
                raise NotExportableError(f"'{name}' belongs to another component")
            text = quoteattr(_expression(value, scope, ""))
            yield f"      <assign location={quoteattr(name)} expr={text}/>"


def _expression(text: str, scope: Scope, expected: str) -> str:
    return _print(_parse(text, scope, expected), is_outer=True)


def _parse(text: str, scope: Scope, expected: str) -> Expr:
    parsed = parse_expression(text, scope, expected or None)
    if parsed.tree is None or parsed.diagnostics:
        reason = parsed.diagnostics[0].message if parsed.diagnostics else "not an expression"
        raise NotExportableError(f"'{text}': {reason}")
    return parsed.tree


def _print(node: Expr, *, is_outer: bool = False) -> str:
    """An expression of ECMAScript; every operation inside another one is in brackets."""
    match node:
        case Number(value=value):
            return repr(value)
        case Boolean(value=value):
            return str(value).lower()
        case Variable(name=name):
            return name
        case FunctionCall():
            return _print_call(node, is_outer=is_outer)
        case Not(operand=operand):
            return f"!({_print(operand, is_outer=True)})"
        case _:
            text = _print_operation(node)
            return text if is_outer else f"({text})"


def _print_call(node: FunctionCall, *, is_outer: bool) -> str:
    if node.function == "float":
        return _print(node.arguments[0], is_outer=is_outer)
    if node.function not in _FUNCTIONS:
        raise NotExportableError(f"SCXML has no function '{node.function}'")
    return f"Math.{node.function}({', '.join(_print(each, is_outer=True) for each in node.arguments)})"


def _print_operation(node: Expr) -> str:
    match node:
        case Minus(operand=operand):
            return f"-{_print(operand)}"
        case Binary(operator="+" | "-" | "*" | "/" as operator, left=left, right=right):
            return f"{_print(left)} {operator} {_print(right)}"
        case Binary(operator=operator):
            raise NotExportableError(f"SCXML has no operator '{operator}' with the same meaning")
        case Comparison(operands=(left, right), operators=(operator,)):
            return f"{_print(left)} {_OPERATORS.get(operator, operator)} {_print(right)}"
        case Logic(operator=operator, operands=operands):
            return f" {_OPERATORS[operator]} ".join(_print(operand) for operand in operands)
        case OutputRef(alias=alias, output=output):
            raise NotExportableError(
                f"'{alias}.{output}' is an input; as an event of SCXML, it can only be joined by 'and'"
            )
        case _:
            raise NotExportableError(f"SCXML has no counterpart of an expression ({type(node).__name__})")
