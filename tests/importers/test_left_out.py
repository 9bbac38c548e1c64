"""What an importer does not read is listed with its line, files outside of the folder are refused, names are unique."""

import random
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.importers.test_other_tools import COUNTER_XML, FLEXBE, YASMIN, notes
from vicode.importers import ImportResult
from vicode.importers.cpp import import_cpp
from vicode.importers.design_names import design_files
from vicode.importers.scxml import ScxmlError, import_scxml
from vicode.importers.scxml.ecmascript import translate
from vicode.services.imported_behavior.other_tools import find_other_files, load_other

BICA = """<component id="walk">
<component id="legs" x="1" y="2"/>
<state id="A" initial="true" x="1" y="2"><activation id="legs"/></state>
<state id="B"/>
<transition src="A" dst="B"/>
</component>"""
SCXML = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" initial="a">
<datamodel><data id="n" expr="1"/></datamodel>
<state id="a"><onentry><assign location="n" expr="2"/><log expr="n"/></onentry>
<transition event="e" cond="n &gt; 1" target="b"><if cond="n == 2"><assign location="n" expr="3"/></if></transition>
</state>
<state id="b"><initial><transition target="c"/></initial><state id="c"/></state>
</scxml>"""


def load(folder: Path, name: str, text: str) -> ImportResult:
    (folder / name).write_text(text)
    result, errors = load_other([folder / name], folder, "p")
    assert not errors
    return result


def listed(folder: Path, name: str, text: str) -> list[str]:
    """The notes on a file."""
    return [each.removeprefix(f"{name}:") for each in notes(load(folder, name, text)) if each.startswith(f"{name}:")]


def listed_of_scxml(_folder: Path, _name: str, text: str) -> list[str]:
    return [f"{line}: {note}" for line, note in import_scxml(text.encode(), "C", "p").notes]


Listed = Callable[[Path, str, str], list[str]]
XML: list[tuple[str, str, Listed]] = [
    ("X.xml", COUNTER_XML, listed),
    ("x.bica", BICA, listed),
    ("patrol.xml", YASMIN, listed),
    ("x.scxml", SCXML, listed_of_scxml),
]


@pytest.mark.parametrize(("name", "text", "read"), XML, ids=[name for name, _text, _read in XML])
def test_each_unknown_attribute_element_and_text_is_listed(tmp_path: Path, name: str, text: str, read: Listed) -> None:
    before = read(tmp_path, name, text)
    assert not [each for each in before if "not in the design" in each]
    for tag in re.finditer(r"<(\w+)", text):
        line = text.count("\n", 0, tag.start()) + 1
        if tag[1] == "Key" or (name == "patrol.xml" and line == 10):
            # What runs in parallel, and data, are listed as a whole.
            continue
        unknown = f"{text[: tag.end()]} unknown='1'{text[tag.end() :]}"
        found = set(read(tmp_path, name, unknown)) - set(before)
        assert found == {f"{line}: not in the design: 'unknown' of <{tag[1]}>"}
    for tag in re.finditer(r"<(\w+)(?:\s[^<>]*)?(?<!/)>", text):
        line = text.count("\n", 0, tag.end()) + 1
        if name == "patrol.xml" and line == 10:
            continue
        for inner, shown in (("<unknown><more/></unknown>", "<unknown>"), ("words", f"the text of <{tag[1]}>")):
            if name == "x.scxml" and shown == "<unknown>":
                continue
            added = text[: tag.end()] + inner + text[tag.end() :]
            assert set(read(tmp_path, name, added)) - set(before) == {f"{line}: not in the design: {shown}"}


def test_unknown_elements_of_scxml_are_refused() -> None:
    with pytest.raises(ScxmlError, match="<unknown> has no meaning"):
        import_scxml(SCXML.replace("<datamodel>", "<unknown/><datamodel>").encode(), "C", "p")


def test_a_second_state_is_listed_with_what_it_contains(tmp_path: Path) -> None:
    xml = """<component id="X"><dependenceComponent id="Eyes"/><state id="A"><requirement id="Eyes"/></state>
<state id="A"><modulation id="Eyes"/><foo/></state>
<bogus/></component>"""
    assert listed(tmp_path, "X.xml", xml)[2:] == [
        "2: another state has the id 'A': it is left out",
        "2: not in the design: <foo>",
        "2: not in the design: <modulation>",
        "3: not in the design: <bogus>",
    ]
    bica = BICA.replace(
        '<state id="B"/>', '<state id="B" initial="true"/>\n<state id="A"><activation id="legs"/></state>'
    )
    assert listed(tmp_path, "x.bica", bica) == [
        "4: 'B' is another initial state: 'A' is the first one",
        "5: another state has the id 'A': it is left out",
        "5: not in the design: <activation>",
    ]


def test_the_last_transition_of_an_outcome_is_taken_and_the_others_are_listed(tmp_path: Path) -> None:
    flexbe = FLEXBE.replace("'failed': target}", "'finished': 'failed'}")
    result = load(tmp_path, "fetch_sm.py", flexbe)
    grip = result.project.designs[0].state("Grip_it")
    assert grip is not None
    assert [getattr(each, "to", "") for each in grip.transitions] == ["failed"]
    assert "fetch_sm.py:36: 'finished' follows again in 'transitions': 'finished' is left out" in notes(result)
    yasmin = YASMIN.replace(
        '<Transition from="ok" to="end"/>', '<Transition from="ok" to="lost"/>\n<Transition from="ok" to="end"/>'
    )
    assert "6: another transition of 'Drive' from 'ok' follows: this one is left out" in listed(
        tmp_path, "patrol.xml", yasmin
    )


def outside_files(folder: Path) -> list[str]:
    """Paths that lead out of a folder."""
    (folder.parent / "secret.xml").write_text("a secret")
    (folder / "link.xml").symlink_to(folder.parent / "secret.xml")
    return ["../secret.xml", str(folder.parent / "secret.xml"), "link.xml", "../../../../../../../../etc/passwd"]


def test_files_outside_of_the_folder_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "in"
    folder.mkdir()
    paths = outside_files(folder)
    opened: list[Path] = []
    read_bytes = Path.read_bytes

    def recording_read(path: Path) -> bytes:
        opened.append(path.resolve())
        return read_bytes(path)

    monkeypatch.setattr(Path, "read_bytes", recording_read)
    for path in paths:
        inner = f'<StateMachine name="S" file_path="{path}"><Transition from="o" to="o"/></StateMachine>'
        (folder / "a.xml").write_text(f'<StateMachine outcomes="o">\n{inner}</StateMachine>')
        _result, (error,) = load_other([folder / "a.xml"], folder, "p")
        assert error.message == f"'{path}' is outside of the imported folder: it is not read"
        assert (error.location.line if error.location else 0) == 2
    (folder / "X.xml").write_text('<component id="X"><state id="A"/><dependenceComponent id="link"/></component>')
    (folder / "X.cpp").symlink_to(tmp_path / "secret.xml")
    result, (error,) = load_other([folder / "X.xml"], folder, "p")
    assert error.message == "'link.xml' is outside of the imported folder: it is not read"
    assert "X.cpp is not found" in str(notes(result))
    assert folder / "link.xml" not in find_other_files(folder)
    assert {each.parent for each in opened} == {folder}


def test_paths_of_designs_are_unique_ignoring_case() -> None:
    stems = ["Project", "Walk", "walk", "sub/project", "Walk_2"]
    assert [*design_files(stems)] == [
        "Project_2.yaml",
        "Walk.yaml",
        "walk_2.yaml",
        "sub/project_2.yaml",
        "Walk_2_2.yaml",
    ]


def test_a_machine_named_project_has_a_file_of_its_own(tmp_path: Path) -> None:
    result = load(tmp_path, "x.bica", BICA.replace('id="walk"', 'id="project"'))
    assert [each.path for each in result.designs] == ["Project_2.yaml"]
    cpp = "option(Project) { initial_state(a) { transition { } action { } } }"
    cpp_result = import_cpp({tmp_path / "x.h": cpp}, "p").result
    assert [each.path for each in cpp_result.designs] == ["Project_2.yaml"]


def flexbe_chain(count: int, *, is_cyclic: bool = False) -> str:
    lines = [
        "from flexbe_core import Behavior, OperatableStateMachine",
        "class FSM(Behavior):",
        "    def create(self):",
    ]
    lines += [f"        m{number} = OperatableStateMachine(outcomes=['a'])" for number in range(count)]
    for number in range(count):
        before = f"m{number - 1}" if number else f"m{count - 2}" if is_cyclic else "W()"
        lines.append(f"        with m{number}:")
        lines.append(f"            OperatableStateMachine.add('S{number}', {before}, transitions={{'a': 'a'}})")
    return "\n".join([*lines, f"        return m{count - 1}"])


def test_machines_inside_each_other_are_read_to_any_depth(tmp_path: Path) -> None:
    result = load(tmp_path, "f_sm.py", flexbe_chain(1500))
    assert len(result.project.designs) == 1500
    assert not result.notes
    cyclic = load(tmp_path, "f_sm.py", flexbe_chain(20, is_cyclic=True))
    assert len(cyclic.notes) == 19


@pytest.mark.parametrize("count", [600, 50_000])
def test_expressions_nested_too_deeply_are_an_error(tmp_path: Path, count: int) -> None:
    text = flexbe_chain(1).replace("        m0 =", f"        x = {'-' * count}1\n        m0 =", 1)
    (tmp_path / "f_sm.py").write_text(text)
    _result, errors = load_other([tmp_path / "f_sm.py"], tmp_path, "p")
    assert [each.message for each in errors] == ["nested too deeply"]


def bracketed(parts: list[str]) -> list[str]:
    """Negations in brackets, one after the other from the last one: the plain form of the algorithm."""
    for index in range(len(parts) - 1, -1, -1):
        if parts[index] == "!":
            end = index + 1
            if parts[end] != "(" and parts[end + 1 : end + 2] == ["("]:
                end += 1
            depth = 0
            while parts[end] == "(" or depth:
                depth += {"(": 1, ")": -1}.get(parts[end], 0)
                if depth == 0:
                    break
                end += 1
            parts[index : end + 1] = ["(", "not", *parts[index + 1 : end + 1], ")"]
    return parts


def random_condition(chance: random.Random, depth: int = 0) -> list[str]:
    match chance.randrange(5) if depth < 5 else 0:
        case 0:
            return ["a"]
        case 1:
            return ["(", *random_condition(chance, depth + 1), ")"]
        case 2:
            return [*random_condition(chance, depth + 1), "&&", *random_condition(chance, depth + 1)]
        case 3:
            return ["Math.abs", "(", *random_condition(chance, depth + 1), ")"]
        case _:
            return ["!", *random_condition(chance, depth + 1)]


@pytest.mark.parametrize("seed", range(100))
def test_negations_have_brackets(seed: int) -> None:
    parts = random_condition(random.Random(seed))
    words = {"&&": "and", "Math.abs": "abs"}
    expected = "".join(words.get(each, each) for each in bracketed([*parts]))
    assert translate(" ".join(parts), {"a": "a"}, bool, 1).replace(" ", "") == expected


def test_a_condition_with_many_negations_is_too_long() -> None:
    text = SCXML.replace("n &gt; 1", f"{'!' * 5000}true")
    with pytest.raises(ScxmlError, match="longer than 10000 characters"):
        import_scxml(text.encode(), "C", "p")
