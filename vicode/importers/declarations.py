"""What a behavior declares, in the words of a project: enumerations, constants, and components with symbols."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

from vicode.findings import DesignPath
from vicode.importers.names import DesignNames, to_design_number, xabsl_name_or_empty
from vicode.model.design import Declaration
from vicode.model.project import INTERNAL, WORLD, Enumeration, Interface
from vicode.model.xabsl.names import symbol_name
from vicode.xabsl import tree
from vicode.xabsl.ranges import parse_range
from vicode.xabsl.source_loader import ProgramSource
from vicode.xabsl.symbol_table import BOOLEAN, DECIMAL, ENUM, Definition, SymbolTable

_TYPES = {BOOLEAN: "bool", DECIMAL: "float"}

PlacedComment = tuple[DesignPath, str]
"""A comment above the thing that a path leads to."""


@dataclass(slots=True)
class ImportedDeclarations:
    """What names mean, and how designs say them.

    `components` are names of components by option and basic behavior, `symbols` pairs of a component and a name in it,
    `names` the names of constants, enumerations, and of parameters inside calls.
    """

    enumerations: list[Enumeration] = field(default_factory=list)
    constants: list[Declaration] = field(default_factory=list)
    interfaces: list[Interface] = field(default_factory=list)
    comments: list[PlacedComment] = field(default_factory=list)
    components: dict[Definition, str] = field(default_factory=dict)
    symbols: dict[Definition, tuple[str, str]] = field(default_factory=dict)
    names: dict[Definition, str] = field(default_factory=dict)
    enums: dict[str, Enumeration] = field(default_factory=dict)
    """Enumerations by their names in XABSL."""
    paths: dict[int, DesignPath] = field(default_factory=dict)
    """Where in the project file a declaration went, by the identity of its node."""
    shared: DesignNames = field(default_factory=DesignNames)
    """Names that every design knows: those of constants and enumerations."""

    @property
    def shared_names(self) -> frozenset[str]:
        """Names of constants and enumerations, which no design may give to another thing."""
        return frozenset([each.name for each in self.constants] + [each.name for each in self.enumerations])


def import_declarations(source: ProgramSource, table: SymbolTable) -> ImportedDeclarations:
    """Name all that a behavior declares, in the order of its files."""
    return _DeclarationImporter(table).run(source)


class _DeclarationImporter:
    """Gives names and collects declarations."""

    def __init__(self, table: SymbolTable) -> None:
        self.table = table
        self.result = ImportedDeclarations()
        # Components and enumerations become classes side by side.
        self.class_names = DesignNames()
        everything = [*(each for found in table.readable.values() for each in found)]
        everything += [*table.enums.values(), *table.options.values(), *table.behaviors.values()]
        self.by_node = {id(each.node): each for each in everything}

    def run(self, source: ProgramSource) -> ImportedDeclarations:
        """All declarations."""
        namespaces = [
            item
            for parsed in source.files.values()
            for item in parsed.file.body
            if isinstance(item, tree.NamespaceNode)
        ]
        for each in self.table.enums.values():
            self._enumeration(each)
        for option in sorted(self.table.options.values(), key=lambda each: each.name.lower()):
            self._component(option)
        for behavior in self.table.behaviors.values():
            self._component(behavior)
        for namespace in namespaces:
            self._namespace(namespace)
        return self.result

    def _component(self, declared: Definition) -> None:
        self.result.components[declared] = self.class_names.allocate(declared.name)
        if declared.role == "behavior":
            names = DesignNames()
            for each in declared.parameters.values():
                self.result.names[each] = names.allocate(each.name)

    def _enumeration(self, declared: Definition) -> None:
        assert isinstance(declared.node, tree.EnumerationNode)
        name = self.result.shared.allocate(self.class_names.allocate(declared.name))
        self.result.names[declared] = name
        names, elements, others = DesignNames(), [], []
        for each in declared.elements.values():
            element = names.allocate(each.name)
            self.result.names[each] = f"{name}.{element}"
            elements.append((element, ""))
            if element != each.name:
                others.append((element, each.name))
        made = Enumeration(
            name=name,
            elements=tuple(elements),
            doc=declared.node.doc,
            internal=declared.node.is_internal,
            xabsl_name=xabsl_name_or_empty(name, declared.name),
            xabsl_elements=tuple(others),
        )
        self.result.enumerations.append(made)
        self.result.enums[declared.name] = made
        self.result.paths[id(declared.node)] = ("enumerations", name)

    def _namespace(self, item: tree.NamespaceNode) -> None:
        """A component of the world for what the robot's program has, one more for what the engine keeps."""
        kept: list[Definition] = []
        given: list[Definition] = []
        first: DesignPath | None = None
        for each in item.declarations:
            declared = self.by_node.get(id(each))
            if declared is None:
                continue
            if isinstance(each, tree.BehaviorNode):
                self._behavior(each, declared)
            elif isinstance(each, tree.ConstantNode):
                self._constant(each, declared)
            elif isinstance(each, tree.SymbolNode):
                (kept if declared.role == "internal" else given).append(declared)
            first = first or self.result.paths.get(id(each))
        if given:
            self._add_interface(item, "", WORLD, given)
        if kept:
            self._add_interface(item, "_internal" if given else "", INTERNAL, kept)
        if first is not None and not given and not kept:
            words = [f"namespace {item.name.text}", item.title, item.doc]
            self.result.comments.append((first, ": ".join(word for word in words if word)))

    def _add_interface(
        self, item: tree.NamespaceNode, suffix: str, implementation: str, symbols: Iterable[Definition]
    ) -> None:
        component = self.class_names.allocate(item.name.text + suffix)
        names = DesignNames()
        outputs: list[Declaration] = []
        variables: list[Declaration] = []
        for each in symbols:
            assert isinstance(each.node, tree.SymbolNode)
            name = names.allocate(each.name)
            self.result.symbols[each] = (component, name)
            made = _with_symbol_name(component, self._declaration(each.node, each, name), each.name)
            (outputs if each.role == "input" else variables).append(made)
            section = "outputs" if each.role == "input" else "variables"
            self.result.paths[id(each.node)] = ("components", component, section, name)
        self.result.interfaces.append(
            Interface(
                component=component,
                title=item.title if item.title != component else "",
                doc=item.doc,
                xabsl_name=xabsl_name_or_empty(component, item.name.text + suffix),
                implementation=implementation,
                outputs=tuple(outputs),
                variables=tuple(variables),
            )
        )

    def _behavior(self, item: tree.BehaviorNode, declared: Definition) -> Interface:
        component = self.result.components[declared]
        made = Interface(
            component=component,
            doc=item.doc,
            xabsl_name=xabsl_name_or_empty(component, declared.name),
            implementation=WORLD,
            parameters=tuple(self._parameters(declared)),
        )
        self.result.interfaces.append(made)
        self.result.paths[id(item)] = ("components", component)
        return made

    def _constant(self, item: tree.ConstantNode, declared: Definition) -> Declaration:
        name = self.result.shared.allocate(declared.name)
        self.result.names[declared] = name
        made = Declaration(
            name=name,
            type="float",
            initial=to_design_number(item.number),
            unit=item.unit,
            doc=item.doc,
            xabsl_name=xabsl_name_or_empty(name, declared.name),
        )
        self.result.constants.append(made)
        self.result.paths[id(item)] = ("constants", name)
        return made

    def _parameters(self, owner: Definition) -> Iterator[Declaration]:
        for each in owner.parameters.values():
            assert isinstance(each.node, tree.ParameterNode)
            yield self._declaration(each.node, each, self.result.names[each])

    def _declaration(self, item: tree.SymbolNode | tree.ParameterNode, declared: Definition, name: str) -> Declaration:
        arguments: tuple[Declaration, ...] | None = None
        if isinstance(item, tree.SymbolNode) and item.parameters is not None:
            names = DesignNames()
            for each in declared.parameters.values():
                self.result.names[each] = names.allocate(each.name)
            arguments = tuple(_with_default(each, self.result.enumerations) for each in self._parameters(declared))
        return convert_declaration(item, declared, name, self.result, arguments)


def convert_declaration(
    item: tree.SymbolNode | tree.ParameterNode,
    declared: Definition,
    name: str,
    vocabulary: ImportedDeclarations,
    arguments: tuple[Declaration, ...] | None = None,
) -> Declaration:
    """A symbol or parameter as a design declares it; a range that is no pair of numbers goes to the words about it."""
    ends = parse_range(item.range) if declared.kind == DECIMAL else None
    docs = [item.doc, "" if ends or not item.range else f"[{item.range}]"]
    return Declaration(
        name=name,
        type=vocabulary.enums[declared.enum].name if declared.kind == ENUM else _TYPES[declared.kind],
        unit=item.unit,
        range=ends,
        doc=" ".join(doc for doc in docs if doc),
        xabsl_name=xabsl_name_or_empty(name, declared.name),
        arguments=arguments,
    )


def _with_default(declaration: Declaration, enums: Iterable[Enumeration]) -> Declaration:
    """An argument that may be left out, as all may in XABSL."""
    firsts = {each.name: f"{each.name}.{each.elements[0][0]}" for each in enums}
    return replace(declaration, initial={"bool": "False", "float": "0", **firsts}[declaration.type])


def _with_symbol_name(component: str, declaration: Declaration, written: str) -> Declaration:
    """With the name of a symbol where that is not the one it would get in XABSL, which begins with its component's."""
    plain = replace(declaration, xabsl_name="")
    return plain if symbol_name(component, plain) == written else replace(plain, xabsl_name=written)
