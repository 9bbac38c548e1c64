"""Generated JavaScript: names, numbers, refused features, and the program of the manual."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from vicode.check import check_project
from vicode.conformance.javascript import find_node
from vicode.generators import UnsoundDesignError, generate, list_origins, list_outputs
from vicode.model.project import Project
from vicode.output import apply_diffs, compare_files
from vicode.store import open_project, read_design

REPOSITORY = Path(__file__).parents[2]
COUNTER = """\
vicode: 1
component: Counter
initial: class_
parameters: {new: 0}
outputs: {n: 1, half: 0.5}
states:
  class_:
    actions:
      - set: {n: n * n - new, half: "-new"}
    transitions:
      - {to: __proto__, when: n > 4 and n * n * n > 0, id: out}
  __proto__: {final: true}
"""


def javascript(text: str, **files: str) -> dict[str, str]:
    design = read_design(text).design
    assert design is not None
    project = Project(name="demo", designs=(design,), languages=("javascript",), **files)
    return {Path(file.path).name: file.text for file in generate(project)}


def run_node(folder: Path, program: str) -> list[str]:
    node = find_node()
    if node is None:
        pytest.skip("Node.js is missing: sudo apt install nodejs")
    (folder / "program.mjs").write_text(program, encoding="utf-8")
    done = subprocess.run([node, "program.mjs"], cwd=folder, capture_output=True, text=True, check=False)
    assert done.stderr == ""
    return done.stdout.splitlines()


def write(folder: Path, text: str) -> None:
    design = read_design(text).design
    assert design is not None
    files = generate(Project(name="demo", designs=(design,), languages=("javascript",)))
    apply_diffs(compare_files(files, folder), folder)


def test_reserved_names_get_an_underscore_and_large_ints_are_calculated_exactly() -> None:
    text = javascript(COUNTER)["counter.mjs"]
    assert "this.n = bica.limit(" in text
    assert "bica.saturate(" in text
    assert "this.new_" in text
    assert '["__proto__"]: {' in text


def test_names_of_objects_are_states_and_no_int_is_negative_zero(tmp_path: Path) -> None:
    write(tmp_path, COUNTER)
    program = """
    import { Root } from "./javascript/bica.mjs";
    import { Counter } from "./javascript/demo/counter.mjs";
    const root = new Root(), counter = root.component(Counter);
    for (const value of [0, -3, -3, -3]) {
      counter.new_ = value;
      root.step(counter, root.iteration * 1e9);
      console.log(counter.$state, counter.n, Object.is(counter.half, 0), counter.$done);
    }
    try { root.step(counter, 2 ** 53); } catch (error) { console.log(error.name); }
    """
    assert run_node(tmp_path, program) == [
        "class_ 1 true false",
        "class_ 4 false false",
        "class_ 19 false false",
        "__proto__ 19 false true",
        "RangeError",
    ]


@pytest.mark.parametrize(
    ("state", "path"),
    [
        ("{actions: [{code: self.x = 1}]}", ("states", "A", "actions", 0, "code")),
        ("{capacity: 1}", ("states", "A", "capacity")),
        ("{synchronized: 2}", ("states", "A", "synchronized")),
    ],
)
def test_what_javascript_cannot_express_is_refused(state: str, path: tuple[str, ...]) -> None:
    text = f"vicode: 1\ncomponent: Lamp\ninitial: A\nvariables: {{x: 0}}\nstates:\n  A: {state}\n"
    design = read_design(text).design
    assert design is not None
    project = Project(name="demo", designs=(design,), languages=("python", "javascript"))
    found = [each for each in check_project(project) if each.rule.code == "L705"]
    assert [(each.subject.path, each.languages) for each in found if each.subject] == [(path, ("javascript",))]
    with pytest.raises(UnsoundDesignError, match="JavaScript"):
        generate(project, languages=("javascript",))


def test_all_files_are_listed_and_the_lines_of_a_state_lead_to_it() -> None:
    design = read_design(COUNTER).design
    assert design is not None
    project = Project(name="demo", designs=(design,), languages=("javascript",))
    files = {file.path: file.text for file in generate(project)}
    assert set(files) == set(list_outputs(project))
    text = files["javascript/demo/counter.mjs"]
    origins = list_origins(project, "Counter", "javascript", text)
    assert [each.path for each in origins] == [("states", "class_"), ("states", "__proto__")]
    assert text.split("\n")[origins[0].first - 1].strip() == "class_: {"


def test_comments_cannot_end_and_are_one_line() -> None:
    text = COUNTER.replace("initial:", 'doc: "a\\u2028alert(1)\\n</script> `${1}`"\ninitial:', 1)
    lines = [line for line in javascript(text)["counter.mjs"].splitlines() if "alert" in line]
    assert len(lines) == 1
    assert lines[0].startswith("// ")


def test_the_program_of_the_manual_runs(tmp_path: Path) -> None:
    shutil.copytree(REPOSITORY / "designs" / "rescue", tmp_path / "designs")
    opened = open_project(tmp_path / "designs")
    files = generate(opened.project, languages=("javascript",))
    apply_diffs(compare_files(files, tmp_path / "generated"), tmp_path / "generated")
    page = (REPOSITORY / "docs" / "javascript.md").read_text(encoding="utf-8")
    program = re.findall(r"```js\n(.*?)```", page, flags=re.DOTALL)[0]
    lines = run_node(tmp_path, program)
    assert (lines[0], lines[-1]) == ("turn 0.1 30", "stop 0 0")
