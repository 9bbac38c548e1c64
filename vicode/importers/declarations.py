"""Convert the declarations of a behavior to enumerations, constants and components of a project."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

from vicode.findings import DesignPath
from vicode.importers.comments import PlacedComment
from vicode.importers.design_names import DesignNames, to_design_number, xabsl_name_or_empty
from vicode.model.design import Declaration
from vicode.model.project import INTERNAL, WORLD, Enumeration, Interface
from vicode.model.xabsl.names import symbol_name
from vicode.xabsl import tree
from vicode.xabsl.ranges import parse_range
from vicode.xabsl.source_loader import ProgramSource
from vicode.xabsl.symbol_table import BOOLEAN, DECIMAL, ENUM, Definition, SymbolTable

_TYPES = {BOOLEAN: "bool", DECIMAL: "float"}


@dataclass(slots=True)
class ImportedDeclarations:
    """The declarations of a project and the names they have in designs.

    Attributes:
        components: Component names by option and basic behavior.
        symbols: The component and the name in it, by symbol.
        names: Names of constants, enumerations, elements and parameters.
        enums: Enumerations by XABSL name.
        paths: The path of a declaration in the project file, by the id of its node.
        shared: The names of constants and enumerations, which are visible in every design.
    """

    enumerations: list[Enumeration] = field(default_factory=list)
    constants: list[Declaration] = field(default_factory=list)
    interfaces: list[Interface] = field(default_factory=list)
    comments: list[PlacedComment] = field(default_factory=list)
    components: dict[Definition, str] = field(default_factory=dict)
    symbols: dict[Definition, tuple[str, str]] = field(default_factory=dict)
    names: dict[Definition, str] = field(default_factory=dict)
    enums: dict[str, Enumeration] = field(default_factory=dict)
    paths: dict[int, DesignPath] = field(default_factory=dict)
    shared: DesignNames = field(default_factory=DesignNames)

    @property
    def shared_names(self) -> frozenset[str]:
        """Names of constants and enumerations, which designs must not reuse."""
        return frozenset([item.name for item in self.constants] + [item.name for item in self.enumerations])


def import_declarations(source: ProgramSource, table: SymbolTable) -> ImportedDeclarations:
    """Convert the declarations of a behavior in the order of its files."""
    return _DeclarationImporter(table).run(source)


class _DeclarationImporter:
    """Allocates names and collects declarations."""

    def __init__(self, table: SymbolTable) -> None:
        self.table = table
        self.result = ImportedDeclarations()
        # Components and enumerations become classes in one namespace.
        self.class_names = DesignNames()
        everything = [*(symbol for symbols in table.readable.values() for symbol in symbols)]
        everything += [*table.enums.values(), *table.options.values(), *table.behaviors.values()]
        self.by_node = {id(declared.node): declared for declared in everything}

    def run(self, source: ProgramSource) -> ImportedDeclarations:
        namespaces = [
            item
            for parsed in source.files.values()
            for item in parsed.file.body
            if isinstance(item, tree.NamespaceNode)
        ]
        for enumeration in self.table.enums.values():
            self._enumeration(enumeration)
        for option in sorted(self.table.options.values(), key=lambda option: option.name.lower()):
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
            for parameter in declared.parameters.values():
                self.result.names[parameter] = names.allocate(parameter.name)

    def _enumeration(self, declared: Definition) -> None:
        assert isinstance(declared.node, tree.EnumerationNode)
        name = self.result.shared.allocate(self.class_names.allocate(declared.name))
        self.result.names[declared] = name
        names, elements, xabsl_elements = DesignNames(), [], []
        for definition in declared.elements.values():
            element = names.allocate(definition.name)
            self.result.names[definition] = f"{name}.{element}"
            elements.append((element, ""))
            if element != definition.name:
                xabsl_elements.append((element, definition.name))
        enumeration = Enumeration(
            name=name,
            elements=tuple(elements),
            doc=declared.node.doc,
            internal=declared.node.is_internal,
            xabsl_name=xabsl_name_or_empty(name, declared.name),
            xabsl_elements=tuple(xabsl_elements),
        )
        self.result.enumerations.append(enumeration)
        self.result.enums[declared.name] = enumeration
        self.result.paths[id(declared.node)] = ("enumerations", name)

    def _namespace(self, item: tree.NamespaceNode) -> None:
        """Convert a namespace to a component for the symbols of the world and one for internal symbols."""
        internal: list[Definition] = []
        world: list[Definition] = []
        first: DesignPath | None = None
        for node in item.declarations:
            declared = self.by_node.get(id(node))
            if declared is None:
                continue
            if isinstance(node, tree.BehaviorNode):
                self._behavior(node, declared)
            elif isinstance(node, tree.ConstantNode):
                self._constant(node, declared)
            elif isinstance(node, tree.SymbolNode):
                (internal if declared.role == "internal" else world).append(declared)
            first = first or self.result.paths.get(id(node))
        if world:
            self._add_interface(item, "", WORLD, world)
        if internal:
            self._add_interface(item, "_internal" if world else "", INTERNAL, internal)
        if first is not None and not world and not internal:
            texts = [f"namespace {item.name.text}", item.title, item.doc]
            self.result.comments.append(PlacedComment(path=first, text=": ".join(text for text in texts if text)))

    def _add_interface(
        self, item: tree.NamespaceNode, suffix: str, implementation: str, symbols: Iterable[Definition]
    ) -> None:
        component = self.class_names.allocate(item.name.text + suffix)
        names = DesignNames()
        outputs: list[Declaration] = []
        variables: list[Declaration] = []
        for symbol in symbols:
            assert isinstance(symbol.node, tree.SymbolNode)
            name = names.allocate(symbol.name)
            self.result.symbols[symbol] = (component, name)
            declaration = _with_symbol_name(component, self._declaration(symbol.node, symbol, name), symbol.name)
            (outputs if symbol.role == "input" else variables).append(declaration)
            section = "outputs" if symbol.role == "input" else "variables"
            self.result.paths[id(symbol.node)] = ("components", component, section, name)
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

    def _behavior(self, item: tree.BehaviorNode, declared: Definition) -> None:
        component = self.result.components[declared]
        interface = Interface(
            component=component,
            doc=item.doc,
            xabsl_name=xabsl_name_or_empty(component, declared.name),
            implementation=WORLD,
            parameters=tuple(self._parameters(declared)),
        )
        self.result.interfaces.append(interface)
        self.result.paths[id(item)] = ("components", component)

    def _constant(self, item: tree.ConstantNode, declared: Definition) -> None:
        name = self.result.shared.allocate(declared.name)
        self.result.names[declared] = name
        constant = Declaration(
            name=name,
            type="float",
            initial=to_design_number(item.number),
            unit=item.unit,
            doc=item.doc,
            xabsl_name=xabsl_name_or_empty(name, declared.name),
        )
        self.result.constants.append(constant)
        self.result.paths[id(item)] = ("constants", name)

    def _parameters(self, owner: Definition) -> Iterator[Declaration]:
        for parameter in owner.parameters.values():
            assert isinstance(parameter.node, tree.ParameterNode)
            yield self._declaration(parameter.node, parameter, self.result.names[parameter])

    def _declaration(self, item: tree.SymbolNode | tree.ParameterNode, declared: Definition, name: str) -> Declaration:
        arguments: tuple[Declaration, ...] | None = None
        if isinstance(item, tree.SymbolNode) and item.parameters is not None:
            names = DesignNames()
            for parameter in declared.parameters.values():
                self.result.names[parameter] = names.allocate(parameter.name)
            arguments = tuple(_with_default(item, self.result.enumerations) for item in self._parameters(declared))
        return convert_declaration(item, declared, name, self.result, arguments)


def convert_declaration(
    item: tree.SymbolNode | tree.ParameterNode,
    declared: Definition,
    name: str,
    declarations: ImportedDeclarations,
    arguments: tuple[Declaration, ...] | None = None,
) -> Declaration:
    """Convert a symbol or parameter; a range that is not a pair of numbers becomes part of the doc."""
    ends = parse_range(item.range) if declared.kind == DECIMAL else None
    docs = [item.doc, "" if ends or not item.range else f"[{item.range}]"]
    return Declaration(
        name=name,
        type=declarations.enums[declared.enum].name if declared.kind == ENUM else _TYPES[declared.kind],
        unit=item.unit,
        range=ends,
        doc=" ".join(doc for doc in docs if doc),
        xabsl_name=xabsl_name_or_empty(name, declared.name),
        arguments=arguments,
    )


def _with_default(declaration: Declaration, enums: Iterable[Enumeration]) -> Declaration:
    """Add the XABSL default to an argument, since every argument is optional in XABSL."""
    firsts = {item.name: f"{item.name}.{item.elements[0][0]}" for item in enums}
    return replace(declaration, initial={"bool": "False", "float": "0", **firsts}[declaration.type])


def _with_symbol_name(component: str, declaration: Declaration, written: str) -> Declaration:
    """Set the XABSL name of a declaration if it differs from the default, which starts with the component name."""
    plain = replace(declaration, xabsl_name="")
    return plain if symbol_name(component, plain) == written else replace(plain, xabsl_name=written)
