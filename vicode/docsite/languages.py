"""Per language: a link to the generated code of a component, or why it cannot be generated."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import replace

from vicode.check import find_errors
from vicode.docsite.findings import finding_row
from vicode.docsite.site_input import ComponentFinding, SiteInput
from vicode.docsite.urls import SiteUrls
from vicode.docsite.views import LanguageView
from vicode.findings import Finding, Severity
from vicode.generators import GENERATORS
from vicode.languages import language_title

GenerationErrors = Mapping[str, Mapping[str, tuple[Finding, ...]]]
"""The errors that prevent generation, by language and component ("" for the project)."""


def find_generation_errors(subject: SiteInput) -> GenerationErrors:
    """Find the errors that prevent generation, for all languages, enabled or not."""
    chosen = set(subject.project.languages)
    found = [each.finding for each in subject.findings]
    if not chosen.issuperset(GENERATORS):
        # The findings of the project omit rules for languages that are not enabled.
        everywhere = replace(subject.project, languages=tuple(GENERATORS))
        found += [each for each in find_errors(everywhere) if each.languages and not chosen & set(each.languages)]
    generation_errors: dict[str, dict[str, list[Finding]]] = {language: defaultdict(list) for language in GENERATORS}
    for finding in found:
        if finding.severity is Severity.ERROR:
            for language in GENERATORS:
                if finding.applies_to(language):
                    generation_errors[language][finding.subject.component if finding.subject else ""].append(finding)
    return {
        language: {component: tuple(findings) for component, findings in by_component.items()}
        for language, by_component in generation_errors.items()
    }


def find_components_with_errors(
    subject: SiteInput, language: str, generation_errors: GenerationErrors
) -> frozenset[str]:
    """The components without code in a language; errors in project.yaml affect all components."""
    faulty = subject.components_with_errors.get(language, frozenset()) | frozenset(generation_errors[language])
    return frozenset(design.component for design in subject.project.designs) if "" in faulty else faulty


def language_views(
    subject: SiteInput,
    component: str,
    written: Mapping[str, str],
    generation_errors: GenerationErrors,
    addresses: SiteUrls,
) -> Iterator[LanguageView]:
    """One row per language; `written` contains the paths of generated files by language."""
    for language in GENERATORS:
        reasons = (*generation_errors[language].get(component, ()), *generation_errors[language].get("", ()))
        rows = (
            finding_row(
                ComponentFinding(component=component if each.subject else "", line=0, finding=each), subject, addresses
            )
            for each in dict.fromkeys(reasons)
        )
        yield LanguageView(
            title=language_title(language),
            href=addresses.code(component, language) if language in written else "",
            path=written.get(language, ""),
            is_enabled=language in subject.project.languages,
            reasons=() if language in written else tuple(rows),
        )
