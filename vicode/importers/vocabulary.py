"""What a behavior declares, in the words of a project: enumerations, constants, and components with symbols."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

from vicode.findings import Path
from vicode.importers.names import Names, other_name, plain_number
from vicode.model.design import Declaration
from vicode.model.project import INTERNAL, WORLD, Enumeration, Interface
from vicode.model.xabsl.names import symbol_name
from vicode.xabsl import tree
from vicode.xabsl.declared import BOOLEAN, DECIMAL, ENUM, Declared, Table
from vicode.xabsl.ranges import range_of
from vicode.xabsl.sources import Source

_TYPES = {BOOLEAN: "bool", DECIMAL: "float"}

Remark = tuple[Path, str]
"""A comment above the thing that a path leads to."""


@dataclass(slots=True)
class Vocabulary:
    """What names mean, and how designs say them.

    `components` are names of components by option and basic behavior, `symbols` pairs of a component and a name in it,
    `plain` the names of constants, enumerations, and of parameters inside calls.
    """

    enumerations: list[Enumeration] = field(default_factory=list)
    constants: list[Declaration] = field(default_factory=list)
    interfaces: list[Interface] = field(default_factory=list)
    remarks: list[Remark] = field(default_factory=list)
    components: dict[Declared, str] = field(default_factory=dict)
    symbols: dict[Declared, tuple[str, str]] = field(default_factory=dict)
    plain: dict[Declared, str] = field(default_factory=dict)
    enums: dict[str, Enumeration] = field(default_factory=dict)
    """Enumerations by their names in XABSL."""
    paths: dict[int, Path] = field(default_factory=dict)
    """Where in the project file a declaration went, by the identity of its node."""
    shared: Names = field(default_factory=Names)
    """Names that every design knows: those of constants and enumerations."""

    @property
    def shared_names(self) -> frozenset[str]:
        """Names of constants and enumerations, which no design may give to another thing."""
        return frozenset([each.name for each in self.constants] + [each.name for each in self.enumerations])


def learn(source: Source, table: Table) -> Vocabulary:
    """Name all that a behavior declares, in the order of its files."""
    return _Learner(table).learn(source)


class _Learner:
    """Gives names and collects declarations."""

    def __init__(self, table: Table) -> None:
        self.table = table
        self.made = Vocabulary()
        # Components and enumerations become classes side by side.
        self.classes = Names()
        everything = [*(each for found in table.readable.values() for each in found)]
        everything += [*table.enums.values(), *table.options.values(), *table.behaviors.values()]
        self.by_node = {id(each.node): each for each in everything}

    def learn(self, source: Source) -> Vocabulary:
        """All declarations."""
        namespaces = [
            item for parsed in source.files.values() for item in parsed.file.body if isinstance(item, tree.Namespace)
        ]
        for each in self.table.enums.values():
            self._enumeration(each)
        for option in sorted(self.table.options.values(), key=lambda each: each.name.lower()):
            self._component(option)
        for behavior in self.table.behaviors.values():
            self._component(behavior)
        for namespace in namespaces:
            self._namespace(namespace)
        return self.made

    def _component(self, declared: Declared) -> None:
        self.made.components[declared] = self.classes.give(declared.name)
        if declared.role == "behavior":
            names = Names()
            for each in declared.parameters.values():
                self.made.plain[each] = names.give(each.name)

    def _enumeration(self, declared: Declared) -> None:
        assert isinstance(declared.node, tree.Enumeration)
        name = self.made.shared.give(self.classes.give(declared.name))
        self.made.plain[declared] = name
        names, elements, others = Names(), [], []
        for each in declared.elements.values():
            element = names.give(each.name)
            self.made.plain[each] = f"{name}.{element}"
            elements.append((element, ""))
            if element != each.name:
                others.append((element, each.name))
        made = Enumeration(
            name=name,
            elements=tuple(elements),
            doc=declared.node.doc,
            internal=declared.node.is_internal,
            xabsl_name=other_name(name, declared.name),
            xabsl_elements=tuple(others),
        )
        self.made.enumerations.append(made)
        self.made.enums[declared.name] = made
        self.made.paths[id(declared.node)] = ("enumerations", name)

    def _namespace(self, item: tree.Namespace) -> None:
        """A component of the world for what the robot's program has, one more for what the engine keeps."""
        kept: list[Declared] = []
        given: list[Declared] = []
        first: Path | None = None
        for each in item.declarations:
            declared = self.by_node.get(id(each))
            if declared is None:
                continue
            if isinstance(each, tree.Behavior):
                self._behavior(each, declared)
            elif isinstance(each, tree.Constant):
                self._constant(each, declared)
            elif isinstance(each, tree.Symbol):
                (kept if declared.role == "internal" else given).append(declared)
            first = first or self.made.paths.get(id(each))
        if given:
            self._offer(item, "", WORLD, given)
        if kept:
            self._offer(item, "_internal" if given else "", INTERNAL, kept)
        if first is not None and not given and not kept:
            words = [f"namespace {item.name.text}", item.title, item.doc]
            self.made.remarks.append((first, ": ".join(word for word in words if word)))

    def _offer(self, item: tree.Namespace, suffix: str, implementation: str, symbols: Iterable[Declared]) -> None:
        component = self.classes.give(item.name.text + suffix)
        names = Names()
        outputs: list[Declaration] = []
        variables: list[Declaration] = []
        for each in symbols:
            assert isinstance(each.node, tree.Symbol)
            name = names.give(each.name)
            self.made.symbols[each] = (component, name)
            made = _with_symbol_name(component, self._declaration(each.node, each, name), each.name)
            (outputs if each.role == "input" else variables).append(made)
            section = "outputs" if each.role == "input" else "variables"
            self.made.paths[id(each.node)] = ("components", component, section, name)
        self.made.interfaces.append(
            Interface(
                component=component,
                title=item.title if item.title != component else "",
                doc=item.doc,
                xabsl_name=other_name(component, item.name.text + suffix),
                implementation=implementation,
                outputs=tuple(outputs),
                variables=tuple(variables),
            )
        )

    def _behavior(self, item: tree.Behavior, declared: Declared) -> Interface:
        component = self.made.components[declared]
        made = Interface(
            component=component,
            doc=item.doc,
            xabsl_name=other_name(component, declared.name),
            implementation=WORLD,
            parameters=tuple(self._parameters(declared)),
        )
        self.made.interfaces.append(made)
        self.made.paths[id(item)] = ("components", component)
        return made

    def _constant(self, item: tree.Constant, declared: Declared) -> Declaration:
        name = self.made.shared.give(declared.name)
        self.made.plain[declared] = name
        made = Declaration(
            name=name,
            type="float",
            initial=plain_number(item.number),
            unit=item.unit,
            doc=item.doc,
            xabsl_name=other_name(name, declared.name),
        )
        self.made.constants.append(made)
        self.made.paths[id(item)] = ("constants", name)
        return made

    def _parameters(self, owner: Declared) -> Iterator[Declaration]:
        for each in owner.parameters.values():
            assert isinstance(each.node, tree.Parameter)
            yield self._declaration(each.node, each, self.made.plain[each])

    def _declaration(self, item: tree.Symbol | tree.Parameter, declared: Declared, name: str) -> Declaration:
        arguments: tuple[Declaration, ...] | None = None
        if isinstance(item, tree.Symbol) and item.parameters is not None:
            names = Names()
            for each in declared.parameters.values():
                self.made.plain[each] = names.give(each.name)
            arguments = tuple(_with_default(each, self.made.enumerations) for each in self._parameters(declared))
        return declaration_of(item, declared, name, self.made, arguments)


def declaration_of(
    item: tree.Symbol | tree.Parameter,
    declared: Declared,
    name: str,
    vocabulary: Vocabulary,
    arguments: tuple[Declaration, ...] | None = None,
) -> Declaration:
    """A symbol or parameter as a design declares it; a range that is no pair of numbers goes to the words about it."""
    ends = range_of(item.range) if declared.kind == DECIMAL else None
    docs = [item.doc, "" if ends or not item.range else f"[{item.range}]"]
    return Declaration(
        name=name,
        type=vocabulary.enums[declared.enum].name if declared.kind == ENUM else _TYPES[declared.kind],
        unit=item.unit,
        range=ends,
        doc=" ".join(doc for doc in docs if doc),
        xabsl_name=other_name(name, declared.name),
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
