"""Renders the source files of an event queue, in Python and C++: the hand-written component of an imported project."""

from vicode.generators.cpp.names import element_name, member_name, namespace
from vicode.generators.plan.project import plan_package
from vicode.importers.scxml import ScxmlImport
from vicode.importers.scxml.queue import EVENTS_MODULE
from vicode.templating import render


def render_event_queue(imported: ScxmlImport) -> dict[str, str]:
    """The files by path; none if the events are inputs without a queue."""
    events = imported.events
    if not events.has_queue:
        return {}
    package = plan_package(imported.project, frozenset())
    outputs, sent = events.inputs.names.items(), events.sent.items()
    view = {"package": package.name, "events": events.name, "sent_type": events.sent_type, "slots": events.slot_names}
    return {
        f"{EVENTS_MODULE}.py": render("importers/scxml_events.py.jinja", outputs=outputs, sent=sent, **view),
        f"{EVENTS_MODULE}.hpp": render(
            "importers/scxml_events.hpp.jinja",
            namespace=namespace(package),
            outputs=[(known, member_name(name)) for known, name in outputs],
            sent=[(item, element_name(element), member_name(item.output)) for item, element in sent],
            **view,
        ),
    }
