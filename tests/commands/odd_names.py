"""Projects with odd names: of the project and its files, of components, states, values, constants and elements."""

from pathlib import Path

from vicode.model.names import snake_case

DESIGN = """\
vicode: 1
component: Lamp
uses: {eye: Eye, arm: Arm}
initial: Idle
states:
  Idle: {requires: [eye], transitions: [{to: Busy, when: eye.near}]}
  Busy: {requires: [eye], modulates: {arm: {speed: 2}}, transitions: [{to: Idle, when: not eye.near}]}
"""
ALONE = """\
vicode: 1
component: Lamp
outputs: {lit: false}
initial: Off
states:
  Off: {actions: [{set: {lit: false}}], transitions: [{to: On, after: 0.1}]}
  On: {actions: [{set: {lit: true}}], transitions: [{to: Off, after: 0.1}]}
"""
PROJECT = """\
vicode: 1
project: {name!r}
languages: [python, cpp, xabsl]
world: rig:Rig
components:
  Eye: {{implementation: world, outputs: {{near: {{type: bool, xabsl_name: near}}}}}}
  Arm: {{implementation: world, parameters: {{speed: {{type: float, default: 0, xabsl_name: arm.speed}}}}}}
agents: {{main: {{root: Lamp}}}}
"""
PROGRAM = """\
#include "{package}/components.hpp"

class Rig final : public {space}::World {{
public:
    bool near() override {{ return ++calls % 10 > 5; }}
    void arm(double) override {{}}

    int calls = 0;
}};

int main() {{
    bica::Root root;
    Rig rig;
    {space}::Components components(root, rig);
    for (int step = 0; step < 50; ++step) {{
        root.step(components.lamp, step * 20'000'000);
    }}
    return 0;
}}
"""
RIG = """\
class Rig:
    near = False
    calls = 0

    def advance(self, now_ns):
        self.near = now_ns // 100_000_000 % 2 == 1

    def {behavior}(self, **parameters):
        self.calls += 1
"""


def write_named(folder: Path, *, name: str, file: str) -> None:
    """A project of this name with a design in `file`."""
    folder.mkdir(parents=True)
    _write(folder / "project.yaml", PROJECT.format(name=name))
    _write(folder / file, DESIGN)
    _write(folder / "rig.py", RIG.format(behavior="arm"))


def write_program(folder: Path, *, name: str) -> None:
    """A project of this name with a program in C++."""
    write_named(folder, name=name, file="lamp.yaml")
    space = {"robot": "robot", "install": "install"}.get(name, f"{name}_")
    _write(folder / "main.cpp", PROGRAM.format(package=name, space=space))


def write_unnamed(folder: Path, *, file: str) -> None:
    """A design without a project file."""
    folder.mkdir(parents=True)
    _write(folder / file, ALONE)


def write_named_components(folder: Path, words: tuple[str, ...]) -> None:
    """A chain of components with these names; the last one is a component of the world."""
    folder.mkdir(parents=True)
    *designs, last = words
    _write(
        folder / "project.yaml",
        "vicode: 1\nproject: Chain\nlanguages: [python, cpp, xabsl]\nworld: rig:Rig\n"
        f"components: {{{last}: {{implementation: world, parameters: {{speed: {{type: float, default: 0}}}}}}}}\n"
        f"agents: {{main: {{root: {designs[0]}}}}}\n",
    )
    for word, used in zip(designs, [*designs[1:], last], strict=True):
        given = "{speed: 1}" if used == last else "{}"
        _write(
            folder / f"{word}.yaml",
            f"vicode: 1\ncomponent: {word}\nuses: {{next_: {used}}}\ninitial: A\nstates:\n"
            f"  A: {{modulates: {{next_: {given}}}, transitions: [{{to: B, after: 0.2}}]}}\n"
            "  B: {transitions: [{to: A, after: 0.1}]}\n",
        )
    _write(folder / "rig.py", RIG.format(behavior=snake_case(last)))


def write_named_members(folder: Path, words: tuple[str, ...]) -> None:
    """A design whose states, variables and outputs have these names, and which uses components under them."""
    folder.mkdir(parents=True)
    _write(
        folder / "project.yaml",
        "vicode: 1\nproject: Members\nlanguages: [python, cpp, xabsl]\nagents: {main: {root: Lamp}}\n",
    )
    states = "".join(
        f"  {word}:\n    actions: [{{set: {{{word}: {word} + 1, v_{word}: v_{word} + 2}}}}]\n"
        f"    transitions: [{{to: {following}, when: {word} > 2 and {following} <= {word}}}]\n"
        for word, following in zip(words, [*words[1:], words[0]], strict=True)
    )
    _write(
        folder / "lamp.yaml",
        f"vicode: 1\ncomponent: Lamp\noutputs: {{{', '.join(f'{word}: 0' for word in words)}}}\n"
        f"variables: {{{', '.join(f'v_{word}: 0' for word in words)}}}\ninitial: {words[0]}\nstates:\n{states}",
    )


def write_named_declarations(folder: Path, words: tuple[str, ...]) -> None:
    """Constants and elements with these names, enumerations with others of them, and a design that reads them."""
    folder.mkdir(parents=True)
    half = len(words) // 2
    constants, types = words[:half], words[half:]
    elements = ", ".join(["first", *words])
    _write(
        folder / "project.yaml",
        "vicode: 1\nproject: Declarations\nlanguages: [python, cpp, xabsl]\nagents: {main: {root: Lamp}}\n"
        f"constants: {{{', '.join(f'{word}: 3' for word in constants)}}}\n"
        "enumerations:\n" + "".join(f"  {word}: {{elements: [{elements}]}}\n" for word in types),
    )
    variables = ", ".join(f"x{number}: {{type: {word}}}" for number, word in enumerate(types))
    steps = [f"x{number} == {word}.{words[number]}" for number, word in enumerate(types)]
    changes = [f"x{number}: {word}.{words[number]}" for number, word in enumerate(types)]
    _write(
        folder / "lamp.yaml",
        f"vicode: 1\ncomponent: Lamp\noutputs: {{n: 0}}\nvariables: {{{variables}}}\ninitial: Count\nstates:\n"
        "  Count:\n    actions: [{set: {n: n + 1}}]\n"
        f"    transitions: [{{to: Set, when: n > {' and n > '.join(constants)}}}]\n"
        f"  Set:\n    actions: [{{set: {{{', '.join(changes)}}}}}]\n"
        f"    transitions: [{{to: Done, when: {' and '.join(steps)}}}]\n"
        "  Done: {final: true}\n",
    )


def _write(file: Path, text: str) -> None:
    file.write_text(text, encoding="utf-8")
