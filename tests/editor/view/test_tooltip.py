"""The tooltip of an item."""

from dataclasses import replace

from vicode.editor.view import ItemRef, tooltip_sections
from vicode.model.design import Assign, Call, Code, CommonSection, Design, Guard, RunCode, State, Transition

BODY = Code(texts=(("cpp", "go();"), ("python", "\n".join(f"step({index})" for index in range(20)))))
DESIGN = Design(
    component="D",
    states=(
        State(
            name="Kick",
            enter=(Assign(values=(("tries", "0"),)), RunCode(code=BODY)),
            modulates=(Call(alias="walk", arguments=(("speed", "3"), ("turn", "0"))),),
            transitions=(Transition(to="Kick", guard=Guard(code=BODY)), Transition(to="Kick")),
        ),
    ),
    common=CommonSection(actions=(Assign(values=(("seen", "x" * 200),)),)),
)


def test_a_state_shows_its_code_in_the_first_language() -> None:
    enter, do = tooltip_sections(DESIGN, ItemRef(kind="states", id="Kick"), ("xabsl", "cpp"))
    assert enter == {"name": "enter", "text": "tries = 0\ngo();"}
    assert do == {"name": "do", "text": "walk(speed=3, turn=0)"}


def test_long_texts_are_shortened() -> None:
    (enter, _do) = tooltip_sections(DESIGN, ItemRef(kind="states", id="Kick"), ("python",))
    assert enter["text"].splitlines()[-1] == "… 10 more lines"
    (common,) = tooltip_sections(DESIGN, ItemRef(kind="common", id="@common"), ("python",))
    assert len(common["text"]) == 90


def test_a_transition_shows_its_predicate() -> None:
    (section,) = tooltip_sections(DESIGN, ItemRef(kind="transitions", id="Kick/0"), ("cpp",))
    assert section == {"name": "holds when", "text": "go();"}
    assert tooltip_sections(DESIGN, ItemRef(kind="transitions", id="Kick/1"), ("cpp",)) == []


def test_what_the_drawing_does_not_show_is_named() -> None:
    design = replace(DESIGN, states=(State(name="Kick", capacity=2, xabsl_name="kick", color="red"),))
    (more,) = tooltip_sections(design, ItemRef(kind="states", id="Kick"), ("python",))
    assert more == {"name": "more", "text": "XABSL name kick\ncapacity 2"}
    described = replace(DESIGN, common=CommonSection(doc="For all."))
    (more,) = tooltip_sections(described, ItemRef(kind="common", id="@common"), ("python",))
    assert more == {"name": "more", "text": "description For all."}


def test_a_missing_item_has_no_tooltip() -> None:
    for of in ("states", "transitions", "components", "links", "nonsense"):
        assert tooltip_sections(DESIGN, ItemRef(kind=of, id="Gone/7"), ("python",)) == []
