"""Who uses whom, as tables."""

from collections.abc import Iterator

from vicode.docsite.addresses import Addresses
from vicode.docsite.docs import line_html_of, summary_of
from vicode.docsite.linking import Linker, listed
from vicode.docsite.views import Line, Part, UseRow
from vicode.model.design import COMMON, Call, Design
from vicode.model.project import Project
from vicode.model.walks import walk_actions


def use_rows(design: Design, linker: Linker) -> Iterator[UseRow]:
    """What a design uses, and in which states."""
    for use in design.uses:
        component = linker.component(use.component)
        yield UseRow(
            component=component,
            alias=use.alias,
            required_in=required_in(design, use.alias, linker),
            modulated_in=modulated_in(design, use.alias, linker),
            doc_html=line_html_of(component.title),
        )


def user_rows(project: Project, component: str, addresses: Addresses) -> Iterator[UseRow]:
    """Who uses a component, and in which states."""
    for design in project.designs:
        linker = Linker(project, addresses, design)
        for use in design.uses:
            if use.component == component:
                yield UseRow(
                    component=Part(
                        text=design.component,
                        href=addresses.component(design.component),
                        title=summary_of(design.doc),
                    ),
                    alias=use.alias,
                    required_in=required_in(design, use.alias, linker),
                    modulated_in=modulated_in(design, use.alias, linker),
                    doc_html="",
                )


def required_in(design: Design, alias: str, linker: Linker) -> Line:
    """The states that require it."""
    return listed(linker.state(state.name) for state in design.states if alias in state.requires)


def modulated_in(design: Design, alias: str, linker: Linker) -> Line:
    """The states that call it."""
    calls = (
        each.state for each in walk_actions(design) if isinstance(each.action, Call) and each.action.alias == alias
    )
    return listed(linker.state(name, "every state" if name == COMMON else "") for name in dict.fromkeys(calls))
