"""The documentation site of a project: static pages with diagrams, cross-references and search."""

from vicode.docsite.build_cache import StoredResults
from vicode.docsite.not_found import not_found_page
from vicode.docsite.site_builder import SiteBuilder, build_site
from vicode.docsite.site_index import plan_site_index
from vicode.docsite.site_input import (
    ComponentFinding,
    SiteInput,
    SourceText,
    iter_action_paths,
    iter_documented_paths,
    make_site_input,
)
from vicode.docsite.site_writer import (
    Manifest,
    PlannedFile,
    load_manifest,
    manifest_path,
    results_path,
    save_manifest,
    tool_digest,
    write_site,
)
from vicode.docsite.urls import SiteUrls, state_anchor

__all__ = [
    "ComponentFinding",
    "Manifest",
    "PlannedFile",
    "SiteBuilder",
    "SiteInput",
    "SiteUrls",
    "SourceText",
    "StoredResults",
    "build_site",
    "iter_action_paths",
    "iter_documented_paths",
    "load_manifest",
    "make_site_input",
    "manifest_path",
    "not_found_page",
    "plan_site_index",
    "results_path",
    "save_manifest",
    "state_anchor",
    "tool_digest",
    "write_site",
]
