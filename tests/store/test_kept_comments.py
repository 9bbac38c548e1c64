"""Comments of items that stay in a design stay in its file, and a saved file can be loaded, also with anchors."""

import contextlib
import re
from dataclasses import replace

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from tests.store.test_save_edits import EDITS
from tests.strategies.commented_texts import commented_texts, fewer_examples, find_comments
from vicode.model.design import Design
from vicode.store import UnreadContentError, read_design, save_design

DOCS = (
    "one line",
    "two\nlines\n",
    "with: a colon # and a hash",
    "word " * 40,
    "- a list\n\n- of two\n",
    " indented",
    "x",
)

ANCHORS = """\
vicode: 1
component: Lamp
initial: Dark
doc: &about all about it
states:
  Dark: &base
    doc: &text the lamp is dark  # why
    transitions: &ways
      # when it is late
      - &way {to: Lit, after: 1}
      - {to: Off}
  Lit:
    <<: *base
    doc: *text
    transitions: *ways
  Off:
    doc: *about
    transitions: [*way, {to: Dark, doc: &inner deep}]
  Last: {doc: *inner, transitions: [{to: Dark}]}
"""


def design_in(text: str) -> Design:
    read = read_design(text)
    assert read.design is not None
    return read.design


def with_states(design: Design, **changed: object) -> Design:
    states = (replace(state, **changed.get(state.name, {})) for state in design.states)  # type: ignore[arg-type]
    return replace(design, states=tuple(states))


@st.composite
def commented_machines(draw: st.DrawFn) -> str:
    """Three states with different transitions, and comments above and behind some lines."""
    lines = ["vicode: 1", "component: Lamp", "initial: A", "states:"]
    for state in "ABC":
        lines += [f"  {state}:", "    transitions:"]
        for number in range(draw(st.integers(1, 3))):
            lines += [f"      - to: {draw(st.sampled_from('ABC'))}", f"        after: {len(lines) + number}"]
    text = ""
    for number, line in enumerate(lines):
        place = draw(st.sampled_from(["above", "behind", "", ""]))
        text += f"{' ' * (len(line) - len(line.lstrip()))}# above {number}\n" if place == "above" else ""
        text += f"{line}  # behind {number}\n" if place == "behind" else f"{line}\n"
    return text


@given(commented_machines(), st.permutations("ABC"), st.data())
def test_a_transition_takes_its_comments_to_another_state(text: str, names: list[str], data: st.DataObject) -> None:
    design = design_in(text)
    source, target = (next(each for each in design.states if each.name == name) for name in names[:2])
    number = data.draw(st.integers(0, len(source.transitions) - 1))
    place = data.draw(st.integers(0, len(target.transitions)))
    left = source.transitions[:number] + source.transitions[number + 1 :]
    there = (*target.transitions[:place], source.transitions[number], *target.transitions[place:])
    new = with_states(design, **{source.name: {"transitions": left}, target.name: {"transitions": there}})
    saved = save_design(new, text)
    assert design_in(saved) == new
    before, after = (set(re.findall(r"# \w+ \d+", each)) for each in (text, saved))
    # Those of a list that is empty now and has gone.
    key = re.search(rf"^  {source.name}:.*\n(?: *(# .*)\n)?    transitions:(?:  (# .*))?$", text, re.MULTILINE)
    assert key is not None
    assert before - after <= (set() if left else {*key.groups()})
    assert len(re.findall(r"# \w+ \d+", saved)) == len(after)


@pytest.mark.parametrize("target", ["B: {}", "B: {transitions: [{to: A}]}", "B:\n    transitions:\n      - {to: A}"])
@pytest.mark.parametrize(
    "item",
    [
        "# why\n      - {to: B, after: 2}",
        "- {to: B, after: 2}  # why",
        "- to: B\n        # why\n        after: 2",
        "- to: B\n        after: 2\n        # why",
        "- when: state_time > 1\n        then:\n          # why\n          - {to: B}",
    ],
)
def test_each_comment_of_a_transition_moves_with_it(item: str, target: str) -> None:
    text = (
        "vicode: 1\ncomponent: Lamp\ninitial: A\nstates:\n  A:\n    transitions:\n"
        f"      - {{stay: true, after: 1}}\n      {item}\n  {target}\n"
    )
    design = design_in(text)
    first, second = design.states
    there = (*second.transitions, first.transitions[1])
    new = with_states(design, A={"transitions": first.transitions[:1]}, B={"transitions": there})
    saved = save_design(new, text)
    assert design_in(saved) == new
    assert saved.count("# why") == 1
    before, _why, after = saved.partition("# why")
    # In one line, an item has no line of its own that the comment could be above.
    assert "\n  B:" in before or after.startswith("\n  B: {")


@fewer_examples
@given(commented_texts(), st.data(), st.lists(st.sampled_from(DOCS), min_size=1, max_size=4))
def test_another_form_of_a_description_loses_no_comment(text: str, data: st.DataObject, docs: list[str]) -> None:
    design = design_in(text)
    name = data.draw(st.sampled_from([state.name for state in design.states]))
    for doc in docs:
        design = with_states(replace(design, doc=doc), **{name: {"doc": doc}})
        saved = save_design(design, text)
        assert design_in(saved) == design
        assert find_comments(text) <= find_comments(saved)
        text = saved


@pytest.mark.parametrize(
    ("old", "doc"),
    [
        ("one  # why", "two\nlines\n"),
        ("|  # why\n      two\n      lines", "one"),
        ("\n      # why\n      one", "two\nlines\n"),
        ("|\n      two\n      lines\n    # why", "one"),
        ("|\n      two\n      lines\n     # why", "one"),
        ("'one'  # why", "two\nlines\n"),
    ],
)
def test_the_comment_of_a_description_stays(old: str, doc: str) -> None:
    text = f"vicode: 1\ncomponent: Lamp\ninitial: Dark\nstates:\n  Dark:\n    doc: {old}\n    final: true\n"
    saved = save_design(with_states(design_in(text), Dark={"doc": doc}), text)
    assert design_in(saved).states[0].doc == doc
    assert saved.count("# why") == 1


def test_the_comment_of_a_removed_transition_goes() -> None:
    text = (
        "vicode: 1\ncomponent: Lamp\ninitial: A\nstates:\n  A:\n    transitions:\n"
        "      # gone\n      - {to: B}\n      # stays\n      - {to: A, after: 1}\n  B: {transitions: [{to: A}]}\n"
    )
    design = design_in(text)
    saved = save_design(with_states(design, A={"transitions": design.states[0].transitions[1:]}), text)
    assert ("# gone" in saved, saved.count("# stays")) == (False, True)


@given(
    removed=st.sets(st.sampled_from(["Dark", "Lit", "Off", "Last"]), max_size=3),
    edits=st.dictionaries(st.sampled_from(["Dark", "Lit", "Off", "Last"]), st.sampled_from(sorted(EDITS))),
    order=st.permutations(range(4)),
    doc=st.sampled_from([*DOCS, "all about it"]),
)
def test_anchors_and_aliases_stay_valid_or_the_edit_is_refused(
    removed: set[str], edits: dict[str, str], order: list[int], doc: str
) -> None:
    design = design_in(ANCHORS)
    states = [design.states[index] for index in order]
    kept = tuple(
        EDITS[edits[state.name]](state) if state.name in edits else state
        for state in states
        if state.name not in removed
    )
    new = replace(design, doc=doc, states=kept)
    saved = None
    with contextlib.suppress(UnreadContentError):
        saved = save_design(new, ANCHORS)
    if saved is not None:
        assert yaml.compose(saved, yaml.SafeLoader) is not None
        assert design_in(saved) == new


def test_a_refused_edit_names_the_line_of_an_alias() -> None:
    design = design_in(ANCHORS)
    with pytest.raises(UnreadContentError, match=r"^line \d+, '.*\*.*', was not understood and would be lost; correct"):
        save_design(replace(design, states=design.states[1:]), ANCHORS)
