"""Compares the declarations of two versions of a project, without its designs."""

from collections.abc import Iterator

from vicode.findings import DesignPath
from vicode.model.diff.changes import Change, ChangeKind, describe_value
from vicode.model.diff.item_diff import diff_attributes, diff_declarations, diff_keyed
from vicode.model.project import Agent, Enumeration, Interface, Profile, ProfileClass, Project, RemoteReference

_PROJECT_ATTRIBUTES = {
    "name": "project name",
    "doc": "description",
    "languages": "languages",
    "world": "world",
    "clock": "clock",
    "generated": "output folder",
    "xabsl_encoding": "encoding of XABSL files",
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
_BRIDGE_ATTRIBUTES = {"world": "world", "tick_ms": "tick", "port": "port"}
_REMOTE_ATTRIBUTES = {
    "remote": "remote component",
    "reliable": "reliable",
    "max_age": "longest age",
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
    yield from diff_keyed(
        ("profiles",),
        old.profiles,
        new.profiles,
        subject=lambda profile: f"profile {profile.name}",
        content=lambda profile: str(profile.world),
        compare=_diff_profile,
    )
    yield from diff_attributes(("bridge",), "bridge", old.bridge, new.bridge, _BRIDGE_ATTRIBUTES)


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


def _diff_profile(path: DesignPath, old: Profile, new: Profile) -> Iterator[Change]:
    yield from diff_attributes(path, f"profile {new.name}", old, new, {"world": "world", "clock": "clock"})
    yield from diff_keyed(
        (*path, "components"),
        old.components,
        new.components,
        subject=lambda replacement: f"profile {new.name}, component {replacement.component}",
        content=_describe_replacement,
        compare=lambda here, before, after: _diff_replacement(here, new.name, before, after),
    )


def _describe_replacement(replacement: ProfileClass | RemoteReference) -> str:
    return replacement.implementation if isinstance(replacement, ProfileClass) else replacement.remote


def _diff_replacement(
    path: DesignPath, profile: str, old: ProfileClass | RemoteReference, new: ProfileClass | RemoteReference
) -> Iterator[Change]:
    subject = f"profile {profile}, component {new.component}"
    if type(old) is not type(new):
        yield Change(
            kind=ChangeKind.CHANGED,
            subject=subject,
            path=path,
            old=_describe_replacement(old),
            new=_describe_replacement(new),
        )
    elif isinstance(new, ProfileClass):
        yield from diff_attributes(path, subject, old, new, {"implementation": "class"})
    else:
        yield from diff_attributes(path, subject, old, new, _REMOTE_ATTRIBUTES)
