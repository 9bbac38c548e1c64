"""A project that `check` accepts compiles, whatever its elements are called: each name of the headers, in each role."""

import keyword
import os
import re
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from tests.cpp_tools import find_gpp, outputs, start, write_unit
from tests.generators.code_tools import write_files
from vicode.check import check_project
from vicode.findings import Severity
from vicode.generators import generate
from vicode.languages import LANGUAGES
from vicode.model.design import Assign, Call, Declaration, Design, Guard, State, Transition, Use
from vicode.model.project import Enumeration, Interface, Project
from vicode.templating import read_asset

STANDARD = "-std=gnu++17"
"""With the macros of the system, such as `linux`."""

Names = tuple[str, ...]


@pytest.fixture(scope="module")
def words(tmp_path_factory: pytest.TempPathFactory) -> Names:
    """What the runtime and the headers that it includes declare or define, and the keywords."""
    folder = tmp_path_factory.mktemp("words")
    (folder / "bica.hpp").write_text(read_asset("cpp/bica.hpp"), encoding="utf-8")
    command = [find_gpp(), STANDARD, "-x", "c++", "-E", "bica.hpp"]
    code, macros = outputs(start([*command, *flags], folder) for flags in (["-P"], ["-dM"]))
    found = set(re.findall(r"\b[A-Za-z]\w*", code)) | set(re.findall(r"^#define ([A-Za-z]\w*)", macros, re.MULTILINE))
    own = set(re.findall(r"\b[A-Za-z]\w*", read_asset("cpp/bica.hpp")))
    others = {each for each in found - own if "__" not in each and len(each) > 1}
    kept = sorted(others) if "VICODE_HYPOTHESIS" in os.environ else sorted(others)[::16]
    macro_names = {each for each in others if each.isupper()}
    keywords = LANGUAGES["cpp"].keywords
    escaped = {f"{each}_" for each in (*keywords, "State", "errors", "next", "root", "EOF")}
    names = {*kept, *own, *macro_names, *keywords, *escaped}
    # Words of the language of expressions are no names there.
    return tuple(sorted(names - {*keyword.kwlist, "false", "true"}))


def of_enumerations(names: Names) -> Project:
    enumerations = tuple(Enumeration(name=name, elements=((name, ""), ("other", ""))) for name in names)
    values = tuple(Declaration(name=f"v{index}", initial=f"{name}.{name}") for index, name in enumerate(names))
    return project(enumerations=enumerations, designs=(design(values=values),))


def of_elements(names: Names) -> Project:
    every = Enumeration(name="Every", elements=tuple((name, "") for name in names))
    values = tuple(Declaration(name=f"v{index}", initial=f"Every.{name}") for index, name in enumerate(names))
    return project(enumerations=(every,), designs=(design(values=values),))


def of_constants(names: Names) -> Project:
    constants = tuple(Declaration(name=name, initial=str(index)) for index, name in enumerate(names))
    sums = tuple(Declaration(name=f"v{index}", initial=f"{name} + 1") for index, name in enumerate(names))
    return project(constants=constants, designs=(design(values=sums),))


def of_values(names: Names) -> Project:
    values = tuple(Declaration(name=name, initial="0") for name in names)
    steps = tuple(Assign(values=((name, f"{name} + 1"),)) for name in names)
    return project(designs=(design(values=values, steps=steps),))


def of_parameters(names: Names) -> Project:
    values = tuple(Declaration(name=name, initial="0") for name in names)
    called = Interface(component="Wheels", implementation="hands:Wheels", parameters=values)
    world = Interface(component="Lamp", implementation="world", parameters=values)
    own = design(
        values=(Declaration(name="v", initial="0"),),
        uses=(Use(alias="wheels", component="Wheels"), Use(alias="lamp", component="Lamp")),
    )
    arguments = tuple((name, "v + 1") for name in names)
    steps = (Call(alias="wheels", arguments=arguments), Call(alias="lamp", arguments=arguments))
    parameters = Design(component="Other", parameters=values, initial="A", states=(State(name="A"),))
    states = (State(name="A", actions=steps),)
    return project(components=(called, world), designs=(_with(own, states), parameters))


def of_outputs(names: Names) -> Project:
    values = tuple(Declaration(name=name, initial="0") for name in names)
    kinds = {"eye": ("Eye", "hands:Eye"), "panel": ("Panel", "world"), "memory": ("Memory", "")}
    components = tuple(Interface(component=name, implementation=kind, outputs=values) for name, kind in kinds.values())
    uses = tuple(Use(alias=alias, component=name) for alias, (name, _kind) in kinds.items())
    steps = tuple(Assign(values=(("v", f"{alias}.{name} + v"),)) for alias in kinds for name in names)
    return project(
        components=components, designs=(design(values=(Declaration(name="v", initial="0"),), uses=uses, steps=steps),)
    )


def of_components(names: Names) -> Project:
    values = (Declaration(name="level", initial="0"),)
    components = tuple(
        Interface(component=name, implementation=("hands:Each", "world", "")[index % 3], outputs=values)
        for index, name in enumerate(names)
    )
    uses = tuple(Use(alias=f"a{index}", component=name) for index, name in enumerate(names))
    steps = tuple(Assign(values=(("v", f"a{index}.level + v"),)) for index in range(len(names)))
    return project(
        components=components, designs=(design(values=(Declaration(name="v", initial="0"),), uses=uses, steps=steps),)
    )


def of_aliases(names: Names) -> Project:
    memory = Interface(component="Memory0", outputs=(Declaration(name="level", initial="0"),))
    uses = tuple(Use(alias=name, component="Memory0") for name in names)
    steps = tuple(Assign(values=(("v", f"{name}.level + v"),)) for name in names)
    return project(
        components=(memory,), designs=(design(values=(Declaration(name="v", initial="0"),), uses=uses, steps=steps),)
    )


def of_states(names: Names) -> Project:
    steps = (Assign(values=(("v", "v + 1"),)),)
    states = tuple(
        State(
            name=name,
            enter=steps,
            actions=steps,
            leave=steps,
            capacity=index % 2 or None,
            final=index % 3 == 0,
            transitions=(Transition(to=names[index - 1], guard=Guard(when=f"v > {index}"), id=f"to{index}"),),
        )
        for index, name in enumerate(names)
    )
    return project(designs=(_with(design(values=(Declaration(name="v", initial="0"),)), states),))


def project(**parts: object) -> Project:
    return Project(name="Everything", languages=("cpp",), **parts)  # type: ignore[arg-type]


def design(*, values: tuple[Declaration, ...], uses: tuple[Use, ...] = (), steps: tuple[Assign, ...] = ()) -> Design:
    return Design(component="Main0", uses=uses, variables=values, initial="A", states=(State(name="A", actions=steps),))


def _with(given: Design, states: tuple[State, ...]) -> Design:
    from dataclasses import replace

    return replace(given, states=states, initial=states[0].name)


ROLES: list[Callable[[Names], Project]] = [
    of_enumerations,
    of_elements,
    of_constants,
    of_values,
    of_parameters,
    of_outputs,
    of_components,
    of_aliases,
    of_states,
]


@pytest.mark.parametrize("role", ROLES, ids=lambda role: role.__name__)
def test_names_that_check_accepts_compile(role: Callable[[Names], Project], words: Names, tmp_path: Path) -> None:
    made = accepted(role, words)
    write_files(generate(made, languages=["cpp"]), tmp_path)
    write_unit(tmp_path / "cpp", "everything")
    compilers = [find_gpp(), *filter(None, [shutil.which("clang++")])]
    started = [
        start([each, STANDARD, "-w", "-I.", "-fsyntax-only", "everything_unit.cpp"], tmp_path / "cpp")
        for each in compilers
    ]
    assert outputs(started) == [""] * len(compilers)


def accepted(role: Callable[[Names], Project], names: Names) -> Project:
    """The project with all names that `check` accepts in this role, which are most."""
    kept: Iterable[str] = names
    for _attempt in range(5):
        made = role(tuple(kept))
        errors = [each for each in check_project(made) if each.severity is Severity.ERROR]
        if not errors:
            assert len(tuple(kept)) > 0.9 * len(names)
            return made
        refused = {word for each in errors for word in re.findall(r"\w+", each.message)}
        kept = [name for name in kept if name not in refused]
    raise AssertionError([each.message for each in errors[:5]])
