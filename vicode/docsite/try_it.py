"""*Try it*: for each design, a script that runs it on its page and in other documentation."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from vicode.bica.tick import choose_tick_ns
from vicode.docsite.build_cache import BuildCache, StoredForm
from vicode.docsite.code_pages import CodeFile, CodeFiles
from vicode.docsite.languages import GenerationErrors
from vicode.docsite.page_inputs import restrict_to_used
from vicode.docsite.urls import SiteUrls, path_anchor, state_anchor
from vicode.docsite.views import RichText, TextSpan
from vicode.generators import collect_components, javascript_name, javascript_runtime, javascript_script
from vicode.model.decision_keys import with_decision_ids
from vicode.model.design import Declaration, Design
from vicode.model.expressions import OutputRef, build_scope, parse_expression, walk
from vicode.model.project import INTERNAL, Interface, Project
from vicode.model.traversal import iter_expressions
from vicode.templating import read_asset

TRY_SCRIPT = "try.js"
_MAX_CHARACTERS = 40_000
"""Of the script of a design; with `TRY_SCRIPT`, a page gets at most 60 kB."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TryIt:
    """The script of a design, or why there is none."""

    script: str = ""
    reason: RichText = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class TryScripts:
    """Writes the scripts of the designs of a project, whose expressions are those of the designs."""

    project: Project
    code_files: CodeFiles
    generation_errors: GenerationErrors
    urls: SiteUrls
    cache: BuildCache

    def find(self, component: str) -> TryIt:
        """The script of a design, if it and all designs that it uses are generated as JavaScript."""
        names = sorted(collect_components(self.project, (component,)), key=lambda name: (name != component, name))
        files = {name: self._module(name) for name in names}
        for name, file in files.items():
            if file is None:
                return TryIt(reason=self._explain(name))
        modules = tuple(file.text for name, file in files.items() if file and name != component)
        if sum(map(len, modules)) <= _MAX_CHARACTERS:
            key = (restrict_to_used(self.project, component), component, modules, self.urls.key)
            make = partial(_write_script, *key[:3], self.urls)
            script = self.cache.get_or_create("try", key, make, StoredForm(str, str))
            if len(script) <= _MAX_CHARACTERS:
                return TryIt(script=script)
        return TryIt(reason=(TextSpan(text=f"its code in JavaScript is larger than {_MAX_CHARACTERS // 1000} kB"),))

    def _module(self, name: str) -> CodeFile | None:
        return next((each for each in self.code_files.files_of(name) if each.variant == "javascript"), None)

    def _explain(self, name: str) -> RichText:
        errors = self.generation_errors["javascript"].get(name, ())
        link = TextSpan(text=self.urls.names.component(name), href=f"{self.urls.component(name)}#languages")
        return (link, TextSpan(text=f": {errors[0].message}" if errors else " has errors"))


def try_script() -> str:
    """The script that all pages share: the runtime of generated code, and the controls."""
    parts = (f"const bica = {javascript_runtime()};", read_asset("docsite/js/try_it.js"))
    return (
        "/* vicode docs: runs a design on its page. */\n(() => {\n" + '"use strict";\n' + "\n".join(parts) + "})();\n"
    )


def _write_script(project: Project, component: str, modules: tuple[str, ...], urls: SiteUrls) -> str:
    designs = tuple(with_decision_ids(each, path_anchor) for each in project.designs)
    design = next(each for each in designs if each.component == component)
    others: list[Design | Interface] = [each for each in designs if each is not design]
    parts: list[Design | Interface] = [design, *others, *project.components]
    page = {"page": urls.component(component), "title": urls.names.component(component)}
    facts = {
        "main": javascript_name(component),
        "stepNs": choose_tick_ns(each.frequency_hz for each in parts if each.frequency_hz),
        "states": {each.name: [f"#{state_anchor(each.name)}", urls.names.state(each)] for each in design.states},
        "inputs": list(_inputs(project, design, urls)),
        "parts": [
            {
                "component": javascript_name(each.component),
                "label": urls.names.component(each.component),
                "href": urls.component(each.component),
            }
            for each in parts
        ],
    }
    classes = ", ".join(javascript_name(each.component) for each in parts)
    return (
        "/* vicode docs: a design that runs in the browser. */\n(() => {\n"
        f'"use strict";\nconst design = {json.dumps(page)};\n{read_asset("docsite/js/try_frame.js")}'
        "vicodeTry((bica) => {\n"
        f"{javascript_script(replace(project, designs=designs), component, modules)}"
        f"return {{ classes: {{ {classes} }}, guards, ...{json.dumps(facts)} }};\n}});\n}})();\n"
    )


def _inputs(project: Project, design: Design, urls: SiteUrls) -> Iterator[Mapping[str, Any]]:
    """The parameters of a design, and what it and the designs that it uses read of components without a design."""
    scope, read = build_scope(project, None), _read_outputs(project)

    def describe(owner: Design | Interface, section: str, each: Declaration) -> Mapping[str, Any]:
        enumeration = project.enumeration(scope.type_of(each))
        elements = enumeration.element_names if enumeration else ()
        low, high = each.range or (0, 0)
        return {
            "component": javascript_name(owner.component),
            "name": javascript_name(each.name),
            "label": urls.names.declaration(owner, section, each),
            "type": scope.type_of(each),
            "options": [f"{enumeration.name}.{name}" for name in elements] if enumeration else [],
            "unit": each.unit,
            "range": [low, high] if low < high else None,
            "isFunction": each.arguments is not None,
        }

    for each in design.parameters:
        yield describe(design, "parameters", each)
    for interface in project.components:
        for section in ("outputs", "variables") if interface.implementation != INTERNAL else ():
            for each in getattr(interface, section):
                if (interface.component, each.name) in read:
                    yield describe(interface, section, each)


def _read_outputs(project: Project) -> set[tuple[str, str]]:
    """What the designs of a project read of other components, as pairs of component and name."""
    found = set()
    for design in project.designs:
        scope, components = build_scope(project, design), {use.alias: use.component for use in design.uses}
        trees = (parse_expression(each.text, scope).tree for each in iter_expressions(design))
        nodes = (node for tree in trees if tree for node in walk(tree))
        found |= {(components[node.alias], node.output) for node in nodes if isinstance(node, OutputRef)}
    return found
