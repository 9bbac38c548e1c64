"""Compares the declarations of two versions of a project, without its designs."""

from collections.abc import Iterator

from vicode.findings import DesignPath
from vicode.model.diff.changes import Change, ChangeKind
from vicode.model.diff.item_diff import diff_declarations, diff_fields, diff_keyed, diff_values
from vicode.model.project import Elsewhere, Enumeration, Interface, Profile, ProfileClass, Project, TopicReference
from vicode.model.words import describe_value

_SECTIONS = ("parameters", "outputs", "variables")
_APART = {
    Project: ("enumerations", "constants", "components", "agents", "profiles", "bridge", "designs", "unreadable"),
    Enumeration: ("name", "elements"),
    # A profile sets `remote` in the components of a run, no file does.
    Interface: ("component", *_SECTIONS, "remote"),
    Profile: ("name", "components"),
}
"""The fields that are not compared as one value."""


def diff_projects(old: Project, new: Project) -> tuple[Change, ...]:
    """Compare what project.yaml declares."""
    return tuple(_diff_content(old, new))


def _diff_content(old: Project, new: Project) -> Iterator[Change]:
    yield from diff_fields((), "", old, new, _APART[Project])
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
        compare=lambda here, before, after: diff_fields(here, f"agent {after.name}", before, after),
    )
    yield from diff_keyed(
        ("profiles",),
        old.profiles,
        new.profiles,
        subject=lambda profile: f"profile {profile.name}",
        content=lambda profile: str(profile.world),
        compare=_diff_profile,
    )
    yield from diff_fields(("bridge",), "bridge", old.bridge, new.bridge)


def _enumeration_subject(enumeration: Enumeration) -> str:
    return f"enumeration {enumeration.name}"


def _describe_elements(enumeration: Enumeration) -> str:
    return ", ".join(enumeration.element_names)


def _diff_elements(path: DesignPath, old: Enumeration, new: Enumeration) -> Iterator[Change]:
    yield from diff_fields(path, _enumeration_subject(new), old, new, _APART[Enumeration])
    yield from diff_keyed(
        (*path, "elements"),
        old.elements,
        new.elements,
        subject=lambda element: f"element {new.name}.{element[0]}",
        content=lambda _element: "",
        compare=lambda here, before, after: diff_values(
            here, f"element {new.name}.{after[0]}", before[1], after[1], describe_value, attribute="description"
        ),
    )


def _diff_interface(path: DesignPath, old: Interface, new: Interface) -> Iterator[Change]:
    yield from diff_fields(path, f"component {new.component}", old, new, _APART[Interface])
    for section in _SECTIONS:
        before, after = getattr(old, section), getattr(new, section)
        owner = f" of {new.component}"
        yield from diff_declarations((*path, section), before, after, section.removesuffix("s"), owner)


def _diff_profile(path: DesignPath, old: Profile, new: Profile) -> Iterator[Change]:
    yield from diff_fields(path, f"profile {new.name}", old, new, _APART[Profile])
    yield from diff_keyed(
        (*path, "components"),
        old.components,
        new.components,
        subject=lambda replacement: f"profile {new.name}, component {replacement.component}",
        content=_describe_replacement,
        compare=lambda here, before, after: _diff_replacement(here, new.name, before, after),
    )


def _describe_replacement(replacement: ProfileClass | Elsewhere) -> str:
    match replacement:
        case ProfileClass():
            return replacement.implementation
        case TopicReference():
            return f"{replacement.topic} ({replacement.type})"
        case _:
            return replacement.remote


def _diff_replacement(
    path: DesignPath, profile: str, old: ProfileClass | Elsewhere, new: ProfileClass | Elsewhere
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
    else:
        yield from diff_fields(path, subject, old, new, ("component",))
