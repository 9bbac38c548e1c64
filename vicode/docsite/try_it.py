"""*Try it*: for each design, a script that runs it on its page and in other documentation."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from vicode.bica.tick import choose_tick_ns
from vicode.docsite.build_cache import BuildCache, StoredForm
from vicode.docsite.code_pages import CodeFiles
from vicode.docsite.languages import GenerationErrors
from vicode.docsite.page_inputs import restrict_to_used
from vicode.docsite.urls import SiteUrls, path_anchor, state_anchor
from vicode.docsite.views import RichText, TextSpan
from vicode.generators import collect_components
from vicode.generators.javascript import LANGUAGE, component_script, escape, script_runtime
from vicode.model.decision_keys import with_decision_ids
from vicode.model.design import Assign, Declaration, Design
from vicode.model.expressions import OutputRef, build_scope, parse_expression, walk
from vicode.model.project import INTERNAL, Interface, Project
from vicode.model.traversal import iter_actions, iter_expressions
from vicode.templating import read_asset

TRY_SCRIPT = "try.js"
_MAX_CHARACTERS = 40_000
"""Of the script of a design; with `TRY_SCRIPT`, a page gets at most 60 kB."""
_STORED_SCRIPT: StoredForm[str] = StoredForm(lambda text: {"script": text}, lambda value: str(value["script"]))


@dataclass(frozen=True, slots=True, kw_only=True)
class TryScripts:
    """Writes the scripts of the designs of a project, whose expressions are those of the designs."""

    project: Project
    code_files: CodeFiles
    generation_errors: GenerationErrors
    urls: SiteUrls
    cache: BuildCache

    def find(self, component: str) -> str | RichText:
        """The script of a design, or the reason if it or a design that it uses is not generated as JavaScript."""
        modules = []
        for name in sorted(collect_components(self.project, (component,)), key=lambda name: name != component):
            texts = [each.text for each in self.code_files.files_of(name) if each.variant == LANGUAGE]
            if not texts:
                return self._explain(name, component)
            modules += texts
        if sum(map(len, modules)) <= _MAX_CHARACTERS:
            # The component itself, which is first, is generated again with the ids of its decisions.
            key = (restrict_to_used(self.project, component), component, tuple(modules[1:]))
            make = partial(_write_script, *key, self.urls)
            script = self.cache.get_or_create("try", (*key, self.urls.key), make, _STORED_SCRIPT)
            if len(script) <= _MAX_CHARACTERS:
                return script
        return (TextSpan(text=f"its code in JavaScript is larger than {_MAX_CHARACTERS // 1000} kB"),)

    def _explain(self, name: str, component: str) -> RichText:
        errors, href = self.generation_errors[LANGUAGE].get(name, ()), f"{self.urls.component(name)}#languages"
        message = errors[0].message if errors else "there are errors"
        if name == component:
            return (TextSpan(text=message, href=href),)
        link = TextSpan(text=self.urls.names.component(name), href=href)
        return (TextSpan(text="in "), link, TextSpan(text=f", {message}"))


def try_script() -> str:
    """The script that all pages share: the runtime of generated code, and the controls."""
    runtime = f"const bica = {script_runtime()};\n"
    return _script("runs a design on its page", runtime + read_asset("docsite/js/try_it.js"))


def _script(title: str, statements: str) -> str:
    return f'/* vicode docs: {title} */\n(() => {{\n"use strict";\n{statements}}})();\n'


def _write_script(project: Project, component: str, modules: tuple[str, ...], urls: SiteUrls) -> str:
    designs = tuple(with_decision_ids(each, path_anchor) for each in project.designs)
    design = next(each for each in designs if each.component == component)
    parts: list[Design | Interface] = [design, *(each for each in designs if each is not design), *project.components]
    names = [(escape(name), urls.names.component(name), urls.component(name)) for name in (p.component for p in parts)]
    facts = {
        "stepNs": choose_tick_ns(each.frequency_hz for each in parts if each.frequency_hz),
        "states": {each.name: [f"#{state_anchor(each.name)}", urls.names.state(each)] for each in design.states},
        "inputs": list(_inputs(project, design, urls)),
        "parts": names,
    }
    frame = f"const [, title, page] = {json.dumps(names[0])};\n{read_asset('docsite/js/try_frame.js')}"
    code = component_script(replace(project, designs=designs), component, modules)
    classes = ", ".join(name for name, _label, _href in names)
    made = f"return {{ classes: {{ {classes} }}, guards, ...{json.dumps(facts)} }};\n"
    return _script("a design that runs in the browser", f"{frame}vicodeTry((bica) => {{\n{code}{made}}});\n")


def _inputs(project: Project, design: Design, urls: SiteUrls) -> Iterator[Mapping[str, Any]]:
    """The parameters of a design, and what it and the designs that it uses read of components without a design."""
    scope, found = build_scope(project, None), _find_inputs(project)

    def describe(owner: Design | Interface, section: str, each: Declaration) -> Mapping[str, Any]:
        type_ = scope.type_of(each)
        low, high = each.range or (0, 0)
        return {
            "component": escape(owner.component),
            "name": escape(each.name),
            "label": urls.names.declaration(owner, section, each),
            "type": type_,
            "options": [f"{type_}.{element}" for element in scope.enumerations.get(type_, ())],
            "unit": each.unit,
            "range": [low, high] if low < high else None,
            "isFunction": each.arguments is not None,
        }

    for each in design.parameters:
        yield describe(design, "parameters", each)
    for interface in project.components:
        for section in ("outputs", "variables") if interface.implementation != INTERNAL else ():
            read = (each for each in getattr(interface, section) if (interface.component, each.name) in found)
            yield from (describe(interface, section, each) for each in read)


def _find_inputs(project: Project) -> set[tuple[str, str]]:
    """What the designs of a project read of other components and do not set, as pairs of component and name."""
    read, written = set(), set()
    for design in project.designs:
        scope, components = build_scope(project, design), {use.alias: use.component for use in design.uses}
        trees = (parse_expression(each.text, scope).tree for each in iter_expressions(design))
        nodes = (node for tree in trees if tree for node in walk(tree))
        read |= {(components[node.alias], node.output) for node in nodes if isinstance(node, OutputRef)}
        actions = (each.action for each in iter_actions(design))
        names = (name.rpartition(".") for each in actions if isinstance(each, Assign) for name, _value in each.values)
        written |= {(components[alias], name) for alias, _dot, name in names if alias}
    return read - written
