"""Compares the declarations of two versions of a project, without its designs."""

from collections.abc import Iterator

from vicode.findings import DesignPath
from vicode.model.diff.changes import Change, ChangeKind, describe_value
from vicode.model.diff.item_diff import diff_attributes, diff_declarations, diff_keyed
from vicode.model.project import Agent, Enumeration, Interface, Project

_PROJECT_ATTRIBUTES = {
    "name": "project name",
    "doc": "description",
    "languages": "languages",
    "world": "world",
    "generated": "output folder",
}
_ENUMERATION_ATTRIBUTES = {
    "doc": "description",
    "internal": "internal",
    "xabsl_name": "XABSL name",
    "xabsl_elements": "XABSL names of elements",
}
_INTERFACE_ATTRIBUTES = {
    "title": "title",
    "doc": "description",
    "xabsl_name": "XABSL name",
    "implementation": "implementation",
    "frequency_hz": "frequency",
}
_AGENT_ATTRIBUTES = {"root": "root", "title": "title", "doc": "description", "xabsl_name": "XABSL name"}


def diff_projects(old: Project, new: Project) -> tuple[Change, ...]:
    """Compare what project.yaml declares."""
    return tuple(_diff_content(old, new))


def _diff_content(old: Project, new: Project) -> Iterator[Change]:
    yield from diff_attributes((), "", old, new, _PROJECT_ATTRIBUTES)
    yield from diff_keyed(
        ("enumerations",),
        old.enumerations,
        new.enumerations,
        subject=_enumeration_subject,
        content=_describe_elements,
        compare=_diff_elements,
    )
    yield from diff_declarations(("constants",), old.constants, new.constants, "constant")
    yield from diff_keyed(
        ("components",),
        old.components,
        new.components,
        subject=lambda interface: f"component {interface.component}",
        content=lambda interface: str(interface.implementation),
        compare=_diff_interface,
    )
    yield from diff_keyed(
        ("agents",),
        old.agents,
        new.agents,
        subject=lambda agent: f"agent {agent.name}",
        content=lambda agent: str(agent.root),
        compare=_diff_agent,
    )


def _enumeration_subject(enumeration: Enumeration) -> str:
    return f"enumeration {enumeration.name}"


def _describe_elements(enumeration: Enumeration) -> str:
    return ", ".join(enumeration.element_names)


def _diff_elements(path: DesignPath, old: Enumeration, new: Enumeration) -> Iterator[Change]:
    yield from diff_attributes(path, _enumeration_subject(new), old, new, _ENUMERATION_ATTRIBUTES)
    yield from diff_keyed(
        (*path, "elements"),
        old.elements,
        new.elements,
        subject=lambda element: f"element {new.name}.{element[0]}",
        content=lambda _element: "",
        compare=lambda here, before, after: _diff_element_doc(
            here, f"element {new.name}.{after[0]}", before[1], after[1]
        ),
    )


def _diff_element_doc(path: DesignPath, subject: str, old: str, new: str) -> Iterator[Change]:
    if old != new:
        texts = describe_value(old), describe_value(new)
        yield Change(
            kind=ChangeKind.CHANGED, subject=subject, path=path, attribute="description", old=texts[0], new=texts[1]
        )


def _diff_interface(path: DesignPath, old: Interface, new: Interface) -> Iterator[Change]:
    yield from diff_attributes(path, f"component {new.component}", old, new, _INTERFACE_ATTRIBUTES)
    for section in ("parameters", "outputs", "variables"):
        before, after = getattr(old, section), getattr(new, section)
        owner = f" of {new.component}"
        yield from diff_declarations((*path, section), before, after, section.removesuffix("s"), owner)


def _diff_agent(path: DesignPath, old: Agent, new: Agent) -> Iterator[Change]:
    return diff_attributes(path, f"agent {new.name}", old, new, _AGENT_ATTRIBUTES)
