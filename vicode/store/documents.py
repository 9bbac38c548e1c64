"""Reads the text of a design file or of a project.yaml into the model."""

import re
from dataclasses import dataclass, replace
from pathlib import PurePath

from vicode.findings import Finding, FindingSubject, sort_findings
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.store.decode import decode_design, decode_project
from vicode.store.format import DESIGN, PROJECT
from vicode.store.line_index import LineIndex, ReadReport
from vicode.store.schema_reader import SchemaReader
from vicode.store.schema_types import RecordSchema
from vicode.store.source_map import SourceMap
from vicode.store.typed_node import TypedNode
from vicode.store.yaml_tree import MAX_BYTES, YamlTree, parse_yaml

PROJECT_FILES = ("project.yaml", "project.yml")


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignReadResult:
    """A design as read; None when nothing could be made of the text. `source_map` tells where its things stand."""

    design: Design | None
    source_map: SourceMap
    findings: tuple[Finding, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectReadResult:
    """What a project.yaml declares, without designs; None when nothing could be made of the text."""

    project: Project | None
    source_map: SourceMap
    findings: tuple[Finding, ...]


def read_design(text: str | bytes, file: str = "design.yaml") -> DesignReadResult:
    """Read a design with all mistakes at once; what can be kept of a broken one is kept.

    Args:
        text: The content of the file.
        file: How findings name the file; a design that does not name its component is called like its stem.
    """
    report, root = read_record(text, file, DESIGN)
    design = None
    if root is not None and root.value is not None:
        design = decode_design(root.value, PurePath(file).stem)
    source = SourceMap(file=file, line_index=report.line_index, root=root)
    component = design.component if design else ""
    return DesignReadResult(design=design, source_map=source, findings=_with_component(report.findings, component))


def read_project_file(text: str | bytes, file: str = "project.yaml") -> ProjectReadResult:
    """Read a project.yaml with all mistakes at once; what can be kept of a broken one is kept."""
    report, root = read_record(text, file, PROJECT)
    project = None
    if root is not None and root.value is not None:
        project = decode_project(root.value, default_project_name(PurePath(file).parent.name))
    source = SourceMap(file=file, line_index=report.line_index, root=root)
    return ProjectReadResult(project=project, source_map=source, findings=_with_component(report.findings, ""))


def default_project_name(folder: str) -> str:
    """The name of a project that does not say it: that of its folder, made fit for a name."""
    name = re.sub(r"\W+", "_", folder, flags=re.ASCII).strip("_")
    return name if name[:1].isalpha() else f"project_{name}".rstrip("_")


def read_record(text: str | bytes, file: str, shape: RecordSchema) -> tuple[ReadReport, TypedNode | None]:
    """Read a whole text as one record; no record when the text is broken as a whole."""
    if len(text) > MAX_BYTES:
        report = ReadReport(line_index=LineIndex("", file))
        report.add("Y108", f"the file is larger than {MAX_BYTES} bytes", (0, 1), fix="split the design")
        return report, None
    try:
        decoded = text if isinstance(text, str) else text.decode("utf-8")
    except UnicodeDecodeError as error:
        return _not_utf8(error, file), None
    report = ReadReport(line_index=LineIndex(decoded, file))
    tree = parse_yaml(decoded, report)
    if tree.root is None:
        if not report.findings:
            report.add("Y103", "the file is empty", (0, 1), fix="begin with 'vicode: 1'")
        return report, None
    root = SchemaReader(report).read(tree.root, shape)
    return report, _complete_root(root, tree, report)


def _complete_root(root: TypedNode, tree: YamlTree, report: ReadReport) -> TypedNode | None:
    if not tree.is_complete:
        # What is missing in the part that was read may well stand in the rest.
        starts = {
            (place.line, place.column) for place in (report.line_index.locate(each, each) for each in tree.unclosed)
        }
        report.findings[:] = [each for each in report.findings if _is_certain(each, starts)]
        return None
    is_known_version = all(finding.rule.code != "Y109" for finding in report.findings)
    return root if root.value is not None and is_known_version else None


def _is_certain(finding: Finding, unfinished: set[tuple[int, int]]) -> bool:
    is_of_unfinished = finding.location is not None and (finding.location.line, finding.location.column) in unfinished
    return finding.rule.code == "Y101" or not (finding.rule.code == "Y104" or is_of_unfinished)


def _not_utf8(error: UnicodeDecodeError, file: str) -> ReadReport:
    """The report on a file in another encoding, at its first byte that is no UTF-8."""
    before = error.object[: error.start].decode("utf-8")
    report = ReadReport(line_index=LineIndex(before, file))
    is_utf16 = error.object.startswith((b"\xff\xfe", b"\xfe\xff"))
    what = "the file is UTF-16" if is_utf16 else f"the byte 0x{error.object[error.start]:02x} is not UTF-8"
    report.add("Y110", what, (len(before), len(before) + 1), fix="save the file as UTF-8")
    return report


def _with_component(findings: list[Finding], component: str) -> tuple[Finding, ...]:
    named = (
        replace(each, subject=FindingSubject(component=component, path=each.subject.path))
        if each.subject is not None
        else each
        for each in findings
    )
    return sort_findings(named)
