"""Proposes edits of actions for changes of the methods that act: calls, assignments and hand-written code."""

import ast
from collections.abc import Iterator
from dataclasses import replace

from vicode.generators import list_regions
from vicode.model.design import COMMON, Action, Assign, Call, Code, Design, RunCode
from vicode.model.edits import replace_action, unique_name, update_actions, update_state
from vicode.model.names import snake_case
from vicode.model.traversal import LocatedAction, iter_actions
from vicode.sync.apply_regions import set_code
from vicode.sync.code_items import COMMENT, REGION, CodeItem
from vicode.sync.interpret.edit_context import CodeChange, EditContext, Place, is_generated_name

_Pairs = tuple[tuple[str, str], ...]
_LEAVING = (ast.Return, ast.Yield, ast.YieldFrom, ast.Await, ast.Nonlocal, ast.Global, ast.Break, ast.Continue)


def propose_actions(context: EditContext, change: CodeChange) -> Iterator[Design]:
    """Propose changed, added and removed actions."""
    place = context.place_of(change.item.scope)
    if place is None or place.phase == "decisions":
        return
    if change.removed and change.added:
        if len(change.removed) == len(change.added) == 1:
            yield from _changed_calls(context, place, change)
            yield from _changed_values(context, place, change)
    elif change.added:
        yield from _added_actions(context, place, change.added)
    else:
        yield from _removed_actions(context, place)


def _changed_calls(context: EditContext, place: Place, change: CodeChange) -> Iterator[Design]:
    old, new = _read_call(change.removed[0]), _read_call(change.added[0])
    if old is None or new is None:
        return
    for located in context.actions_in(place):
        action = located.action
        if isinstance(action, Call) and action.alias == old[0]:
            for is_shortest in (False, True):
                pairs = _changed_arguments(context, action, old[1], new[1], is_shortest=is_shortest)
                yield _replace(context.design, located, replace(action, alias=new[0], arguments=pairs))


def _changed_arguments(
    context: EditContext, call: Call, old: dict[str, ast.expr], new: dict[str, ast.expr], *, is_shortest: bool
) -> _Pairs:
    """Return the arguments of the design after a change.

    Args:
        context: The design.
        call: The call in the design.
        old: The arguments in the generated code, with the defaults of hand-written components.
        new: The arguments in the changed code.
        is_shortest: Replace the whole expression of a changed argument.
    """
    given = dict(call.arguments)
    pairs = []
    for name, value in new.items():
        before = old.get(name)
        is_same = before is not None and ast.dump(before) == ast.dump(value)
        if is_same and name in given:
            pairs.append((name, given[name]))
        elif not is_same:
            texts = context.reader.read_change(given.get(name, ""), before if name in given else None, value)
            pairs.append((name, texts[-1 if is_shortest else 0]))
    order = {name: index for index, name in enumerate(given)}
    return tuple(sorted(pairs, key=lambda pair: order.get(pair[0], len(order))))


def _changed_values(context: EditContext, place: Place, change: CodeChange) -> Iterator[Design]:
    old, new = _read_assignment(change.removed[0]), _read_assignment(change.added[0])
    if old is None or new is None:
        return
    for located in context.actions_in(place):
        if isinstance(located.action, Assign):
            for index, (name, text) in enumerate(located.action.values):
                if name != old[0]:
                    continue
                for changed in context.reader.read_change(text, old[1], new[1]):
                    values = _replaced(located.action.values, index, (new[0], changed))
                    yield _replace(context.design, located, Assign(values=values))


def _added_actions(context: EditContext, place: Place, added: tuple[CodeItem, ...]) -> Iterator[Design]:
    """Propose a call or an assignment at each place."""
    if len(added) != 1:
        return
    call, assignment = _read_call(added[0]), _read_assignment(added[0])
    if call is not None:
        action: Action = Call(
            alias=call[0], arguments=tuple((name, context.reader.read(value)) for name, value in call[1].items())
        )
        yield from _insert_modulation(context, place, action)
    elif assignment is not None:
        action = Assign(values=((assignment[0], context.reader.read(assignment[1])),))
    else:
        return
    yield from _insert(context, place, action)


def _insert_modulation(context: EditContext, place: Place, action: Action) -> Iterator[Design]:
    state = context.design.state(place.source)
    if not isinstance(action, Call) or place.phase or state is None:
        return
    if action.alias in {call.alias for call in state.modulates}:
        return
    for index in range(len(state.modulates), -1, -1):
        calls = (*state.modulates[:index], action, *state.modulates[index:])
        yield update_state(context.design, state.name, lambda old, calls=calls: replace(old, modulates=calls))  # type: ignore[misc]


def _insert(context: EditContext, place: Place, action: Action) -> Iterator[Design]:
    path, length = context.action_list_in(place)
    for index in range(length, -1, -1):
        yield update_actions(
            context.design,
            path,
            lambda old, at=index: (*old[:at], action, *old[at:]),  # type: ignore[misc]
        )
    yield from _insert_behind_modulation(context, place, action)


def _insert_behind_modulation(context: EditContext, place: Place, action: Action) -> Iterator[Design]:
    """Modulated components run last: those before the new action become calls in the list of actions."""
    state = context.design.state(place.source)
    for count in range(1, len(state.modulates) + 1) if state is not None and not place.phase else ():
        yield update_state(
            context.design,
            place.source,
            lambda old, count=count: replace(  # type: ignore[misc]
                old, actions=(*old.actions, *old.modulates[:count], action), modulates=old.modulates[count:]
            ),
        )


def propose_action_code(context: EditContext, change: CodeChange) -> Iterator[Design]:
    """Propose hand-written code for added statements."""
    place, added = context.place_of(change.item.scope), change.added
    if place is None or place.phase == "decisions" or not added or change.removed:
        return
    if any(item.kind == REGION for item in added) or all(item.kind == COMMENT for item in added):
        return
    if not _is_movable(context, added):
        return
    code = Code(texts=(("python", context.source_of(added) + "\n"),))
    yield from _insert(context, place, RunCode(code=code))
    # An id keeps the regions of other code in the same list as they are.
    name = "common" if place.source == COMMON else snake_case(place.source)
    taken = {each.action.id for each in iter_actions(context.design) if isinstance(each.action, RunCode)}
    id_ = unique_name(f"{name}_{place.phase or 'actions'}_code", taken)
    yield from _insert(context, place, RunCode(code=code, id=id_))


def propose_region_code(context: EditContext, change: CodeChange) -> Iterator[Design]:
    """Propose statements before or behind a region as a part of its code."""
    added = change.added
    if change.removed or not added or any(item.kind == REGION for item in added):
        return
    unit = context.edited.items.get(".".join(change.item.scope.split(".")[:2]), ())
    regions = [item.code for item in unit if item.kind == REGION and item.depth == added[0].depth]
    project = replace(
        context.project,
        designs=tuple(
            context.design if each.component == context.design.component else each for each in context.project.designs
        ),
    )
    paths = list_regions(project, context.design.component, "python") if regions else {}
    text = context.source_of(added)
    for region in regions:
        body = context.bodies.get(region, "")
        if region in paths:
            for code in (f"{body}\n{text}", f"{text}\n{body}"):
                yield set_code(context.design, paths[region], "python", code)


def _is_movable(context: EditContext, added: tuple[CodeItem, ...]) -> bool:
    """Whether statements may stand in a method of their own: they share no local name with the rest of the method."""
    method = context.definition_of(added[0].scope)
    if method is None:
        return False
    lines = {line for item in added for line in range(item.first, item.last + 1)}
    if any(item.depth < added[0].depth for item in added):
        return False
    inside: list[ast.AST] = []
    outside: list[ast.AST] = []
    for node in ast.walk(method):
        (inside if getattr(node, "lineno", 0) in lines else outside).append(node)
    attributes = {node.attr for node in inside if isinstance(node, ast.Attribute)}
    has_steps = {"_call", "_change_to", "_stay"} & attributes or any(map(is_generated_name, attributes))
    if has_steps or any(isinstance(node, _LEAVING) for node in inside):
        return False
    parameters = {argument.arg for argument in method.args.args} - {"self"}
    return not (
        (_names(inside, ast.Load) & (_names(outside, ast.Store) | parameters))
        or (_names(inside, ast.Store) & (_names(outside, ast.Load) | parameters))
    )


def _names(nodes: list[ast.AST], context: type[ast.expr_context]) -> set[str]:
    return {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, context)}


def _removed_actions(context: EditContext, place: Place) -> Iterator[Design]:
    for located in context.actions_in(place):
        yield _remove(context.design, located)
        if isinstance(located.action, Assign) and len(located.action.values) > 1:
            values = located.action.values
            for index in range(len(values)):
                yield replace_action(
                    context.design, located.path, Assign(values=(*values[:index], *values[index + 1 :]))
                )


def _replace(design: Design, located: LocatedAction, action: Action) -> Design:
    if located.phase != "modulates":
        return replace_action(design, located.path, action)
    state = design.state(located.state)
    assert state is not None
    calls = tuple(action if call is located.action and isinstance(action, Call) else call for call in state.modulates)
    return update_state(design, state.name, lambda old: replace(old, modulates=calls))


def _remove(design: Design, located: LocatedAction) -> Design:
    if located.phase != "modulates":
        return replace_action(design, located.path)
    return update_state(
        design,
        located.state,
        lambda old: replace(old, modulates=tuple(call for call in old.modulates if call is not located.action)),
    )


def _replaced(values: _Pairs, index: int, pair: tuple[str, str]) -> _Pairs:
    return (*values[:index], pair, *values[index + 1 :])


def _read_call(item: CodeItem) -> tuple[str, dict[str, ast.expr]] | None:
    """Read `self._call(self.alias, name=value)`."""
    match item.node:
        case ast.Expr(
            value=ast.Call(
                func=ast.Attribute(value=ast.Name(id="self"), attr="_call"),
                args=[ast.Attribute(value=ast.Name(id="self"), attr=alias)],
                keywords=keywords,
            )
        ):
            return alias, {keyword.arg: keyword.value for keyword in keywords if keyword.arg}
        case _:
            return None


def _read_assignment(item: CodeItem) -> tuple[str, ast.expr] | None:
    """Read `self.name = value` or `self.alias.name = value`; an operator before `=` becomes part of the value."""
    match item.node:
        case ast.Assign(targets=[target], value=value):
            pass
        case ast.AugAssign(target=target, op=operator, value=right):
            value = ast.BinOp(left=target, op=operator, right=right)
        case _:
            return None
    match target:
        case ast.Attribute(value=ast.Name(id="self"), attr=name):
            return name, value
        case ast.Attribute(value=ast.Attribute(value=ast.Name(id="self"), attr=alias), attr=name):
            return f"{alias}.{name}", value
        case _:
            return None
