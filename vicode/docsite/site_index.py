"""The common home page of several sites."""

from collections.abc import Mapping
from functools import partial

from vicode.docsite.build_cache import compute_digest
from vicode.docsite.doc_text import render_doc
from vicode.docsite.markdown_pages import render_markdown_page
from vicode.docsite.natural_sort import natural_sort_key
from vicode.docsite.site_input import SiteInput
from vicode.docsite.site_writer import PlannedFile
from vicode.docsite.urls import HOME
from vicode.docsite.views import ProjectCard, TextSpan
from vicode.templating import read_asset, render


def plan_site_index(
    site_inputs: Mapping[str, SiteInput], *, title: str = "", is_markdown: bool = False
) -> tuple[PlannedFile, ...]:
    """Plan the home page and its assets; the keys of `site_inputs` are the folders of the sites."""
    rows = tuple(_project_card(folder, site_inputs[folder]) for folder in sorted(site_inputs, key=natural_sort_key))
    if is_markdown:
        text = render_markdown_page("projects", projects=rows, title=title or "Projects")
        return (PlannedFile(path="index.md", key=compute_digest(text), render=lambda: text),)
    style, views = read_asset("docsite/site.css"), {"projects": rows, "title": title or "Projects"}
    page = PlannedFile(
        path=HOME, key=compute_digest(rows, title), render=partial(render, "docsite/projects.html.jinja", **views)
    )
    return (page, PlannedFile(path="site.css", key=compute_digest(style), render=lambda: style))


def _project_card(folder: str, subject: SiteInput) -> ProjectCard:
    project = subject.project
    counts = (
        (len(project.designs), "state machine"),
        (sum(len(design.states) for design in project.designs), "state"),
        (len(project.agents), "agent"),
    )
    return ProjectCard(
        link=TextSpan(text=subject.name, href=f"{folder}/{HOME}"),
        folder=folder,
        doc_html=render_doc(project.doc, parent_level=2),
        facts=tuple(f"{count} {word}{'s' * (count != 1)}" for count, word in counts if count),
    )
