"""A project written by somebody who means harm: every text in it tries to run."""

import json
from pathlib import Path

PAYLOADS = {
    "script": "</script><script>window.ran = 'script'</script>",
    "comment": "<!--<script>",
    "image": "<img src=x onerror=\"window.ran = 'image'\">",
    "drawing": "\"'><svg onload=\"window.ran = 'drawing'\"><text>",
    "template": "{{ window.ran = 'template' }}{{ constructor.constructor('window.ran = 1')() }}",
    "script in a template": "${window.ran = 'js'}`; window.ran = 'js'; //",
    "address": "javascript:window.ran='address'",
    "prop": '" onclick="window.ran = 1" v-html="x" :style="window.ran = 1" @mouseover="window.ran = 1',
    "direction": "evil\u202etxt.exe\u202c\u2066 \u200b",
    "other scripts": "نص عربي طويل · 長い日本語の名前 · 한국어 " + "W" * 400,
}


def write_hostile_project(folder: Path, payload: str) -> None:
    """Write a project named, described and filled with one payload; what must be a name is one."""
    folder.mkdir(parents=True)
    evil = json.dumps(payload)
    (folder / "project.yaml").write_text(
        f"""
vicode: 1
project: {evil}
doc: {evil}
enumerations: {{Side: {{doc: {evil}, elements: {{left: {evil}}}}}}}
constants: {{limit: {{value: 1, unit: {evil}, doc: {evil}}}}}
components:
  Eyes:
    implementation: "eyes:Eyes"
    doc: {evil}
    outputs: {{seen: {{type: bool, unit: {evil}, doc: {evil}}}}}
    parameters: {{speed: {{type: float, default: {evil}, unit: {evil}, doc: {evil}}}}}
""",
        encoding="utf-8",
    )
    (folder / "player.yaml").write_text(
        f"""
vicode: 1
component: Player
doc: {evil}
uses: {{eyes: {{component: Eyes, at: [300, 0]}}}}
parameters: {{lost: {{type: float, default: {evil}, unit: {evil}, doc: {evil}}}}}
outputs: {{shown: {{type: bool, initial: {evil}, unit: {evil}, doc: {evil}}}}}
variables: {{own: {{type: float, initial: {evil}, unit: {evil}, doc: {evil}}}}}
module: {{python: {evil}}}
members: {{python: {evil}}}
initial: Seek
common: {{doc: {evil}, transitions: [{{to: Seek, when: {evil}, doc: {evil}}}]}}
states:
  Seek:
    doc: {evil}
    at: [0, 0]
    requires: [eyes]
    modulates: {{eyes: {{speed: {evil}}}}}
    enter: [{{set: {{own: {evil}}}}}]
    actions: [{{code: {{python: {evil}}}}}]
    transitions:
      - {{to: Rest, when: {evil}, after: {evil}, doc: {evil}}}
      - {{to: Rest, code: {{python: {evil}}}, doc: {evil}}}
      - {{when: {evil}, doc: {evil}, then: [{{to: Rest, doc: {evil}}}]}}
  Rest: {{doc: {evil}, at: [0, 160]}}
""",
        encoding="utf-8",
    )


def write_hostile_names(folder: Path, payload: str) -> None:
    """Write designs where the payload stands for every name, in files and a folder of that name too."""
    folder = folder / payload.replace("/", "∕")[:80]
    folder.mkdir(parents=True)
    evil = json.dumps(payload)
    (folder / "project.yaml").write_text("vicode: 1\nproject: Names\n", encoding="utf-8")
    (folder / f"{payload.replace('/', '∕')[:60]}.yaml").write_text(f"vicode: 1\n{evil}: [{evil}\n", encoding="utf-8")
    (folder / "wave.yaml").write_text(
        f"""
vicode: 1
component: Wave
uses: {{{evil}: {{component: {evil}}}, eyes: {{component: {evil}}}}}
variables: {{{evil}: {{type: {evil}, initial: 0}}}}
initial: {evil}
states:
  {evil}: {{requires: [{evil}], modulates: {{{evil}: {{{evil}: 1}}}}, transitions: [{{to: {evil}}}]}}
  Up: {{requires: [{evil}], transitions: [{{to: {evil}, when: x}}]}}
""",
        encoding="utf-8",
    )
