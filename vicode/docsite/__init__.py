"""The documentation site of a project: a page a component, with drawings, cross links and a search; plain files."""

from vicode.docsite.addresses import Addresses, state_anchor
from vicode.docsite.homes import plan_home
from vicode.docsite.missing import missing_page
from vicode.docsite.site import SiteBuilder, build_site
from vicode.docsite.subject import OwnFinding, SourceText, Subject, described_paths, subject_of
from vicode.docsite.writing import (
    Manifest,
    PlannedFile,
    load_manifest,
    manifest_file,
    save_manifest,
    write_site,
)

__all__ = [
    "Addresses",
    "Manifest",
    "OwnFinding",
    "PlannedFile",
    "SiteBuilder",
    "SourceText",
    "Subject",
    "build_site",
    "described_paths",
    "load_manifest",
    "manifest_file",
    "missing_page",
    "plan_home",
    "save_manifest",
    "state_anchor",
    "subject_of",
    "write_site",
]
