"""The documentation site of a project: a page a component, with drawings, cross links and a search; plain files."""

from vicode.docsite.site import MARK, build_site
from vicode.docsite.subject import OwnFinding, SourceText, Subject, described_paths, subject_of

__all__ = ["MARK", "OwnFinding", "SourceText", "Subject", "build_site", "described_paths", "subject_of"]
