"""Proposes edits for changes of the class and the module: settings, declarations, states, docs and added code."""

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from vicode.generators.python.names import component_class_name
from vicode.model.design import Code, Declaration, Design, State, Use
from vicode.model.edits import remove_states, set_declarations, update_state
from vicode.model.names import is_valid_state_name
from vicode.sync.code_items import CODE, COMMENT, DOCSTRING, REGION, CodeItem, docstring_text
from vicode.sync.interpret.edit_context import CodeChange, EditContext, is_generated_name, method_name
from vicode.sync.interpret.renames import list_states

_ENTRY = re.compile(r"    (\w+): (.*)")
_FACTS = re.compile(r" \([^()]*\)\Z")


def propose_class_edits(context: EditContext, change: CodeChange) -> Iterator[Design]:
    """Propose edits for a change outside of the methods of states."""
    method = method_name(change.item.scope)
    kinds = {item.kind for item in (*change.removed, *change.added)}
    if kinds == {DOCSTRING}:
        yield from _docs(context, change)
    elif method == "__init__":
        yield from _initial_values(context, change)
        yield from _added_uses(context, change.added)
        yield from _added_variables(context, change.added)
        yield from _changed_states(context, change)
    elif method == "modulate":
        yield from _defaults(context, change)
    elif not method and change.item.scope:
        yield from _settings(context, change)


def _docs(context: EditContext, change: CodeChange) -> Iterator[Design]:
    old, new = ("\n".join(docstring_text(item) for item in items) for items in (change.removed, change.added))
    place = context.place_of(change.item.scope)
    if place is not None:
        for text in _unwrapped(new):
            yield update_state(context.design, place.source, lambda state, doc=text: replace(state, doc=doc))  # type: ignore[misc]
    elif not method_name(change.item.scope) and change.item.scope:
        (old_doc, old_entries), (doc, entries) = _split_docstring(old), _split_docstring(new)
        for text in _unwrapped(doc) if doc.split() != old_doc.split() else [context.design.doc]:
            edited = replace(context.design, doc=text)
            yield _with_declaration_docs(edited, old_entries, entries)


def _unwrapped(doc: str) -> list[str]:
    """Return possible texts of a docstring: each paragraph as one line, and as it is."""
    paragraphs = re.split(r"\n\s*\n", doc)
    is_plain = all(line[:1].isalnum() for line in doc.split("\n") if line)
    joined = "\n\n".join(" ".join(paragraph.split()) for paragraph in paragraphs)
    return list(dict.fromkeys([joined, doc] if is_plain else [doc, joined]))


def _split_docstring(text: str) -> tuple[str, dict[str, str]]:
    """Split the docstring of a class into its doc and the texts of its attributes."""
    doc, _heading, section = f"{text}\n".partition("\nAttributes:\n")
    entries: dict[str, str] = {}
    name = ""
    for line in section.split("\n"):
        match = _ENTRY.match(line)
        if match:
            name, entries[match[1]] = match[1], match[2]
        elif name and line.strip():
            entries[name] += f" {line.strip()}"
    return doc.strip(), entries


def _with_declaration_docs(design: Design, old: dict[str, str], new: dict[str, str]) -> Design:
    for section in ("parameters", "outputs", "variables"):
        declarations = tuple(
            declaration
            if old.get(declaration.name) == new.get(declaration.name)
            else replace(declaration, doc=_doc_of(declaration, new.get(declaration.name, "")))
            for declaration in getattr(design, section)
        )
        design = set_declarations(design, section, declarations)
    return design


def _doc_of(declaration: Declaration, text: str) -> str:
    """Return the doc without the unit and range that the generator adds."""
    has_facts = declaration.unit or declaration.range
    doc = _FACTS.sub("", text) if has_facts else text
    return f"{doc}." if has_facts and declaration.doc.rstrip().endswith(".") and not doc.endswith(".") else doc


def _initial_values(context: EditContext, change: CodeChange) -> Iterator[Design]:
    if len(change.removed) != 1 or len(change.added) != 1:
        return
    old, new = _read_attribute(change.removed[0]), _read_attribute(change.added[0])
    if old is None or new is None or old[0] != new[0]:
        return
    yield from _with_initial(context, old[0], old[1], new[1])


def _with_initial(context: EditContext, name: str, old: ast.expr | None, new: ast.expr) -> Iterator[Design]:
    for section in ("parameters", "outputs", "variables"):
        declarations: tuple[Declaration, ...] = getattr(context.design, section)
        for declaration in declarations:
            if declaration.name != name:
                continue
            for text in context.reader.read_change(declaration.initial, old if declaration.initial else None, new):
                changed = tuple(replace(each, initial=text) if each is declaration else each for each in declarations)
                yield set_declarations(context.design, section, changed)
                # A value of another form changes a type that is inferred from it.
                typed = tuple(
                    replace(each, initial=text, type=each.type or "float") if each is declaration else each
                    for each in declarations
                )
                yield set_declarations(context.design, section, typed)


def _defaults(context: EditContext, change: CodeChange) -> Iterator[Design]:
    """Propose defaults of parameters for a changed signature of `modulate`."""
    nodes = [item.node for item in (*change.removed[:1], *change.added[:1])]
    match nodes:
        case [ast.FunctionDef(args=old), ast.FunctionDef(args=new)]:
            before = {argument.arg: value for argument, value in zip(old.kwonlyargs, old.kw_defaults, strict=True)}
            for argument, value in zip(new.kwonlyargs, new.kw_defaults, strict=True):
                was = before.get(argument.arg)
                if value is not None and was is not None and ast.dump(was) != ast.dump(value):
                    yield from _with_initial(context, argument.arg, was, value)


def _added_uses(context: EditContext, added: tuple[CodeItem, ...]) -> Iterator[Design]:
    """Propose to use a component for `self.alias = root.component(Class)`."""
    if len(added) != 1 or (read := _read_attribute(added[0])) is None:
        return
    match read[1]:
        case ast.Call(func=ast.Attribute(value=ast.Name(id="root"), attr="component"), args=[ast.Name(id=class_name)]):
            classes = {each.component: each.implementation.rpartition(":")[2] for each in context.project.components}
            classes |= {each.component: component_class_name(each.component) for each in context.project.designs}
            uses = context.design.uses
            for component in (name for name, found in classes.items() if found == class_name):
                use = Use(alias=read[0], component=component)
                for index in range(len(uses), -1, -1):
                    yield replace(context.design, uses=(*uses[:index], use, *uses[index:]))


def _added_variables(context: EditContext, added: tuple[CodeItem, ...]) -> Iterator[Design]:
    if len(added) != 1 or (read := _read_attribute(added[0])) is None:
        return
    name, value = read
    text = context.reader.read(value)
    type_name = _parameter_types(context).get(name)
    if type_name is not None:
        parameters = context.design.parameters
        for type_ in dict.fromkeys((type_name, "")):
            parameter = Declaration(name=name, initial=text, type=type_)
            for index in range(len(parameters), -1, -1):
                yield replace(context.design, parameters=(*parameters[:index], parameter, *parameters[index:]))
    variables = context.design.variables
    for type_ in ("", "float", "int", "bool"):
        declaration = Declaration(name=name, initial=text, type=type_)
        for index in range(len(variables), -1, -1):
            yield replace(context.design, variables=(*variables[:index], declaration, *variables[index:]))
    if isinstance(value, ast.Attribute):
        yield replace(context.design, variables=(*variables, Declaration(name=name, initial=text)))


def _parameter_types(context: EditContext) -> dict[str, str]:
    """Return the types of the parameters that `modulate` has in the edited file."""
    scopes = (name for name in context.edited.items if method_name(name) == "modulate")
    method = next((found for scope in scopes if (found := context.definition_of(scope))), None)
    arguments = method.args.kwonlyargs if method is not None else []
    return {each.arg: ast.unparse(each.annotation) if each.annotation else "" for each in arguments}


def _read_attribute(item: CodeItem) -> tuple[str, ast.expr] | None:
    match item.node:
        case ast.Assign(targets=[ast.Attribute(value=ast.Name(id="self"), attr=name)], value=value):
            return name, value
        case _:
            return None


def _changed_states(context: EditContext, change: CodeChange) -> Iterator[Design]:
    """Propose requirements, `final` and the numbers of robots for a changed `State(…)`."""
    if len(change.removed) != 1 or len(change.added) != 1:
        return
    match change.removed[0].node, change.added[0].node:
        case ast.Expr(value=ast.Call(args=[ast.Constant(value=str(name)), *_])), ast.Expr(value=ast.Call() as call):
            keywords = {keyword.arg: keyword.value for keyword in call.keywords}
            yield update_state(context.design, name, lambda state: _with_keywords(state, keywords))


def _with_keywords(state: State, keywords: dict[str | None, ast.expr]) -> State:
    requires = keywords.get("requires")
    final = keywords.get("final")
    return replace(
        state,
        requires=tuple(_attribute_names(requires)),
        final=isinstance(final, ast.Constant) and final.value is True,
        capacity=_whole_number(keywords.get("capacity")),
        synchronized=_whole_number(keywords.get("synchronized")),
    )


def _attribute_names(node: ast.expr | None) -> Iterator[str]:
    for element in node.elts if isinstance(node, ast.Tuple | ast.List) else ():
        if isinstance(element, ast.Attribute):
            yield element.attr


def _whole_number(node: ast.expr | None) -> int | None:
    match node:
        case ast.Constant(value=int(value)):
            return value
        case _:
            return None


def _settings(context: EditContext, change: CodeChange) -> Iterator[Design]:
    for item in change.added:
        match item.node:
            case ast.Assign(targets=[ast.Name(id="frequency_hz")], value=ast.Constant(value=int() | float() as hertz)):
                yield replace(context.design, frequency_hz=float(hertz))
            case ast.Assign(targets=[ast.Name(id="resume")], value=ast.Constant(value=bool(resume))):
                yield replace(context.design, resume=resume)
    if not change.added:
        yield replace(context.design, frequency_hz=None)
        yield replace(context.design, resume=False)


def propose_states(context: EditContext, change: CodeChange) -> Iterator[Design]:
    """Propose to add a state where the edited file lists it, or to remove one."""
    design = context.design
    listed = [name for name, _stem in list_states(context.edited.states())]
    own = [state.name for state in design.states]
    if change.removed and not change.added:
        yield from (remove_states(design, [name]) for name, _stem in list_states(change.removed) if name in own)
    elif change.added and not change.removed:
        for name, _stem in list_states(change.added):
            if name not in own and is_valid_state_name(name):
                before = sum(each in own for each in listed[: listed.index(name)])
                states = (*design.states[:before], State(name=name), *design.states[before:])
                yield replace(design, states=states)


def propose_class_code(context: EditContext, change: CodeChange) -> Iterator[Design]:
    """Propose code of the class or the module: definitions and assignments, behind or before the code that is there."""
    added = change.added
    if (
        change.removed
        or any(item.kind == REGION for item in added)
        or is_generated_name(method_name(change.item.scope))
    ):
        return
    definitions = [item for item in added if item.kind == CODE]
    first = next((item for item in added if item.kind != COMMENT), None)
    if first is None or not definitions:
        return
    text = context.source_of(added) + "\n"
    if first.depth == 0:
        is_definition = isinstance(first.node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef)
        if not is_definition and change.line > context.class_line:
            # Module code runs before the class is defined.
            return
        for code in _extended(context.design.module, text, separator="\n\n" if is_definition else ""):
            yield replace(context.design, module=code)
    elif first.depth == 1:
        for code in _extended(context.design.members, text, separator="\n"):
            yield replace(context.design, members=code)


def _extended(code: Code, text: str, *, separator: str) -> Iterator[Code]:
    """Yield the code with a text behind it, and before it."""
    own = code.in_language("python") or ""
    others = tuple(pair for pair in code.texts if pair[0] != "python")
    if not own.strip():
        yield replace(code, texts=(("python", text), *others))
        return
    own = own.rstrip("\n") + "\n"
    yield replace(code, texts=(("python", own + separator + text), *others))
    yield replace(code, texts=(("python", text + separator + own), *others))


def with_imports(design: Design, statements: list[str]) -> Design:
    """Return the design with import statements at the start of its module code."""
    own = design.module.in_language("python") or ""
    lines = "".join(f"{statement}\n" for statement in statements)
    separator = "" if not own.strip() or own.lstrip().startswith(("import ", "from ")) else "\n"
    others = tuple(pair for pair in design.module.texts if pair[0] != "python")
    return replace(design, module=Code(texts=(("python", lines + separator + own), *others)))
