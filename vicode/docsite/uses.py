"""Tables of users and used components."""

from collections.abc import Iterator

from vicode.docsite.doc_text import render_facts, summarize
from vicode.docsite.name_linker import NameLinker, join_spans
from vicode.docsite.reference_lists import ReferenceIndex
from vicode.docsite.urls import SiteUrls
from vicode.docsite.views import RichText, TextSpan, UseRow
from vicode.model.design import COMMON, Call, Design
from vicode.model.project import Project
from vicode.model.traversal import iter_actions
from vicode.model.words import describe_fields


def use_rows(design: Design, linker: NameLinker) -> Iterator[UseRow]:
    """The components that a design uses, with the states."""
    for use in design.uses:
        component = linker.component(use.component)
        yield UseRow(
            component=component,
            alias=use.alias,
            required_in=required_in(design, use.alias, linker),
            modulated_in=modulated_in(design, use.alias, linker),
            doc_html=render_facts(component.title, describe_fields(use, ("alias", "component"))),
        )


def user_rows(project: Project, component: str, addresses: SiteUrls, references: ReferenceIndex) -> Iterator[UseRow]:
    """The designs that use a component, with the states."""
    for design in project.designs:
        linker = NameLinker(project, addresses, design)
        for use in design.uses:
            if use.component == component:
                yield UseRow(
                    component=TextSpan(
                        text=addresses.names.component(design.component),
                        href=addresses.component(design.component),
                        title=summarize(design.doc),
                    ),
                    alias=use.alias,
                    required_in=required_in(design, use.alias, linker),
                    modulated_in=references.calls(design.component, component),
                    doc_html="",
                )


def required_in(design: Design, alias: str, linker: NameLinker) -> RichText:
    return join_spans(linker.state(state.name) for state in design.states if alias in state.requires)


def modulated_in(design: Design, alias: str, linker: NameLinker) -> RichText:
    calls = (
        each.state for each in iter_actions(design) if isinstance(each.action, Call) and each.action.alias == alias
    )
    return join_spans(linker.state(name, "every state" if name == COMMON else "") for name in dict.fromkeys(calls))
