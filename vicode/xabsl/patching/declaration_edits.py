"""Edits declarations: symbols, constants, enumerations, basic behaviors, parameters and agents."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from vicode.matching import Match
from vicode.xabsl import tree
from vicode.xabsl.patching.doc_edits import edit_words
from vicode.xabsl.patching.list_edits import ListStyle, edit_list
from vicode.xabsl.patching.source_edits import SourceEdits, indented
from vicode.xabsl.printer import print_node
from vicode.xabsl.tokens import DOC

Parameters = Sequence[tree.ParameterNode]


def edit_doc(file: SourceEdits, old: tree.SyntaxNode, before: str, after: str) -> None:
    """Change the description before an item."""
    if before == after:
        return
    first = old.first_token
    if file.tokens.kinds[first] == DOC:
        start, end = file.start(first), file.end(first)
        if after:
            edit_words(file, [(start, end)], before, after)
        else:
            file.delete(start, file.start(first + 1))
        return
    start = file.start(first)
    indent = file.indent_at(start)
    file.insert(
        start, f"/** {' '.join(after.split())} */\n{indent}" if file.is_first_in_line(start) else f"/** {after} */ "
    )


def edit_parameters(
    file: SourceEdits, old: Parameters, versions: tuple[Parameters, Parameters], style: ListStyle
) -> None:
    """Change a list of parameters; `versions` are those before and after the change."""
    before, after = versions
    if before == after:
        return
    names = [parameter.name.text for parameter in old]
    known = {parameter.name.text: parameter for parameter in before}
    matches: list[Match] = []
    added = []
    for parameter in after:
        name = parameter.name.text
        if name in known and name in names:
            matches.append(names.index(name))
            added.append("")
            _edit_parameter(file, old[names.index(name)], known[name], parameter)
        else:
            matches.append(None)
            added.append(indented(print_node(parameter), style.indent, style.unit))
    if matches != list(range(len(old))):
        edit_list(file, old, matches, added, style)


def _edit_parameter(
    file: SourceEdits, old: tree.ParameterNode, before: tree.ParameterNode, after: tree.ParameterNode
) -> None:
    edit_doc(file, old, *_docs_without_range(file, old, before.doc, after.doc))
    if (before.type, before.range, before.unit) != (after.type, after.range, after.unit):
        file.replace(_head_start(file, old), file.end(old.last_token - 1), _without_doc(after).removesuffix(";"))


def _docs_without_range(
    file: SourceEdits, old: tree.ParameterNode | tree.SymbolNode, before: str, after: str
) -> tuple[str, str]:
    """The descriptions without a range that is not a pair of numbers: an import appends it to the description.

    If the new description lacks the range, it is deleted from the file.
    """
    words = f"[{old.range}]"
    if not old.range or not before.endswith(words):
        return before, after
    if not after.endswith(words):
        name = old.name.last_token
        file.delete(file.end(name), file.end(name + 1))
    return before.removesuffix(words).strip(), after.removesuffix(words).strip()


def edit_declaration(
    file: SourceEdits, old: tree.DeclarationNode, before: tree.DeclarationNode, after: tree.DeclarationNode
) -> None:
    """Change a declaration."""
    if before == after:
        return
    docs = before.doc, after.doc
    edit_doc(file, old, *(_docs_without_range(file, old, *docs) if isinstance(old, tree.SymbolNode) else docs))
    match old, before, after:
        case tree.SymbolNode(), tree.SymbolNode(), tree.SymbolNode():
            _edit_symbol(file, old, before, after)
        case tree.ConstantNode(), tree.ConstantNode(), tree.ConstantNode():
            _replace_constant(file, old, before, after)
        case tree.EnumerationNode(), tree.EnumerationNode(), tree.EnumerationNode():
            _edit_enumeration(file, old, before, after)
        case tree.BehaviorNode(), tree.BehaviorNode(), tree.BehaviorNode():
            opening = old.name.last_token + 1
            edit_parameters(
                file, old.parameters, (before.parameters, after.parameters), _style(file, old, opening, old.parameters)
            )
        case _:
            file.replace(_head_start(file, old), file.end(old.last_token), _without_doc(after))


def _edit_symbol(file: SourceEdits, old: tree.SymbolNode, before: tree.SymbolNode, after: tree.SymbolNode) -> None:
    if before.parameters is None or after.parameters is None or old.parameters is None:
        if before.parameters != after.parameters:
            file.replace(_head_start(file, old), file.end(old.last_token), _without_doc(after))
            return
    else:
        opening = file.tokens.kinds.index("(", old.name.last_token)
        edit_parameters(
            file, old.parameters, (before.parameters, after.parameters), _style(file, old, opening, old.parameters)
        )
    was = (before.direction, before.type, before.range, before.unit)
    if was != (after.direction, after.type, after.range, after.unit):
        end = file.tokens.kinds.index("(" if old.parameters is not None else ";", old.name.last_token) - 1
        head = tree.SymbolNode(after.direction, after.name, after.type, after.range, after.unit)
        file.replace(_head_start(file, old), file.end(end), print_node(head).removesuffix(";"))


def _replace_constant(
    file: SourceEdits, old: tree.ConstantNode, before: tree.ConstantNode, after: tree.ConstantNode
) -> None:
    # The name is followed by =, an optional sign, the number and an optional unit.
    number = old.name.last_token + 2
    end = number + old.number.startswith("-")
    if before.number != after.number:
        file.replace(file.start(number), file.end(end), after.number)
    if before.unit != after.unit:
        file.replace(file.end(end), file.end(old.last_token - 1), f' "{after.unit}"' if after.unit else "")


def _edit_enumeration(
    file: SourceEdits, old: tree.EnumerationNode, before: tree.EnumerationNode, after: tree.EnumerationNode
) -> None:
    if before.is_internal != after.is_internal:
        name = old.name.last_token
        opening = file.tokens.kinds.index("{", name)
        file.replace(file.end(name), file.end(opening - 1), " internal" if after.is_internal else "")
    names, new_names = [item.text for item in old.elements], [item.text for item in after.elements]
    if [item.text for item in before.elements] == new_names:
        return
    kept = [name for name in names if name in new_names]
    if [name for name in new_names if name in names] != kept or not kept:
        start, end = file.start(old.elements[0].first_token), file.end(old.elements[-1].last_token)
        file.replace(start, end, ", ".join(new_names))
        return
    _edit_elements(file, old.elements, new_names)


def _edit_elements(file: SourceEdits, old: Sequence[tree.NameNode], names: Sequence[str]) -> None:
    """Remove and add elements with the commas beside them."""
    known = {item.text: item for item in old}
    first = next(index for index, item in enumerate(old) if item.text in names)
    file.delete(file.start(old[0].first_token), file.start(old[first].first_token))
    for index in range(first + 1, len(old)):
        if old[index].text not in names:
            file.delete(file.end(old[index - 1].last_token), file.end(old[index].last_token))
    is_lines = len(old) > 1 and file.is_first_in_line(file.start(old[-1].first_token))
    gap = "\n" + file.indent_at(file.start(old[-1].first_token)) if is_lines else " "
    previous: tree.NameNode | None = None
    for name in names:
        if name in known:
            previous = known[name]
        elif previous is None:
            file.insert(file.start(old[0].first_token), f"{name},{gap}")
        else:
            file.insert(file.end(previous.last_token), f",{gap}{name}")


def edit_agent(file: SourceEdits, old: tree.AgentNode, before: tree.AgentNode, after: tree.AgentNode) -> None:
    """Change the description, title and root of an agent."""
    edit_doc(file, old, before.doc, after.doc)
    if before.title != after.title:
        title = old.name.last_token + 2
        file.replace(file.start(title), file.end(title), f'"{after.title}"')
    if before.root != after.root:
        file.replace_node(old.root, after.root.text)


def edit_declarations(
    file: SourceEdits,
    old: tree.NamespaceNode,
    known: Mapping[int, tuple[tree.DeclarationNode, tree.DeclarationNode]],
    new: Sequence[tree.DeclarationNode | int],
) -> None:
    """Change the declarations of a namespace.

    Args:
        file: The file of the namespace.
        old: The namespace.
        known: The versions before and after the change, by the index of the original declaration.
        new: The indices of the remaining declarations, and the added ones, in their order.
    """
    for index, versions in known.items():
        edit_declaration(file, old.declarations[index], *versions)
    matches = [item if isinstance(item, int) else None for item in new]
    if matches == list(range(len(old.declarations))):
        return
    opening = file.tokens.kinds.index("{", old.name.last_token)
    style = _style(file, old, opening, old.declarations)
    added = ["" if isinstance(item, int) else indented(print_node(item), style.indent, style.unit) for item in new]
    edit_list(file, old.declarations, matches, added, style)


def _style(
    file: SourceEdits, old: tree.SyntaxNode, opening: int, items: Sequence[tree.SyntaxNode] | None = None
) -> ListStyle:
    outer = file.indent_at(file.start(old.first_token))
    starts = [
        file.start(item.first_token) for item in items or () if file.is_first_in_line(file.start(item.first_token))
    ]
    indent = file.indent_at(starts[0]) if starts else f"{outer}  "
    return ListStyle(opening=opening, indent=indent, unit=indent.removeprefix(outer) or "  ")


def _head_start(file: SourceEdits, node: tree.SyntaxNode) -> int:
    """The start of an item after its description."""
    return file.start(node.first_token + (file.tokens.kinds[node.first_token] == DOC))


def _without_doc(node: tree.ParameterNode | tree.DeclarationNode) -> str:
    return print_node(replace(node, doc=""))
