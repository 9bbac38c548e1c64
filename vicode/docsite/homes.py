"""The common home of several sites that lie beside each other."""

from collections.abc import Mapping
from functools import partial

from vicode.docsite.addresses import HOME
from vicode.docsite.docs import html_of
from vicode.docsite.markdown import page_in_markdown
from vicode.docsite.memory import digest_of
from vicode.docsite.ordering import by_name
from vicode.docsite.subject import Subject
from vicode.docsite.views import HomeRow, Part
from vicode.docsite.writing import PlannedFile
from vicode.templating import render, text_of


def plan_home(
    subjects: Mapping[str, Subject], *, title: str = "", is_markdown: bool = False
) -> tuple[PlannedFile, ...]:
    """The page that leads to the sites, which lie in folders of these names, and what it looks like."""
    rows = tuple(_row(folder, subjects[folder]) for folder in sorted(subjects, key=by_name))
    if is_markdown:
        text = page_in_markdown("projects", projects=rows, title=title or "Projects")
        return (PlannedFile(path="index.md", key=digest_of(text), make=lambda: text),)
    style, views = text_of("docsite/site.css"), {"projects": rows, "title": title or "Projects"}
    page = PlannedFile(
        path=HOME, key=digest_of(rows, title), make=partial(render, "docsite/projects.html.jinja", **views)
    )
    return (page, PlannedFile(path="site.css", key=digest_of(style), make=lambda: style))


def _row(folder: str, subject: Subject) -> HomeRow:
    project = subject.project
    counts = (
        (len(project.designs), "state machine"),
        (sum(len(design.states) for design in project.designs), "state"),
        (len(project.agents), "agent"),
    )
    return HomeRow(
        site=Part(text=subject.name, href=f"{folder}/{HOME}"),
        folder=folder,
        doc_html=html_of(project.doc, below=2),
        facts=tuple(f"{count} {word}{'s' * (count != 1)}" for count, word in counts if count),
    )
