"""The tooltip of an item."""

from dataclasses import replace

from vicode.editor.view import ItemRef, tooltip_sections
from vicode.model.design import Assign, Call, Code, CommonSection, Design, Guard, RunCode, State, Transition
from vicode.model.project import Project

PYTHON, CPP = (Project(name="p", languages=(language,)) for language in ("python", "cpp"))
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
    enter, do = tooltip_sections(
        Project(name="p", languages=("xabsl", "cpp")), DESIGN, ItemRef(kind="states", id="Kick")
    )
    assert enter == {"name": "enter", "text": "tries = 0\ngo();"}
    assert do == {"name": "do", "text": "walk(speed=3, turn=0)"}


def test_long_texts_are_shortened() -> None:
    (enter, _do) = tooltip_sections(PYTHON, DESIGN, ItemRef(kind="states", id="Kick"))
    assert enter["text"].splitlines()[-1] == "… 10 more lines"
    (common,) = tooltip_sections(PYTHON, DESIGN, ItemRef(kind="common", id="@common"))
    assert len(common["text"]) == 90


def test_a_transition_shows_its_predicate() -> None:
    (section,) = tooltip_sections(CPP, DESIGN, ItemRef(kind="transitions", id="Kick/0"))
    assert section == {"name": "holds when", "text": "go();"}
    assert tooltip_sections(CPP, DESIGN, ItemRef(kind="transitions", id="Kick/1")) == []


def test_what_the_drawing_does_not_show_is_named() -> None:
    design = replace(DESIGN, states=(State(name="Kick", capacity=2, xabsl_name="kick", color="red"),))
    (more,) = tooltip_sections(PYTHON, design, ItemRef(kind="states", id="Kick"))
    assert more == {"name": "more", "text": "XABSL name kick\ncapacity 2"}
    described = replace(DESIGN, common=CommonSection(doc="For all."))
    (more,) = tooltip_sections(PYTHON, described, ItemRef(kind="common", id="@common"))
    assert more == {"name": "more", "text": "description For all."}


def test_a_missing_item_has_no_tooltip() -> None:
    for of in ("states", "transitions", "components", "links", "nonsense"):
        assert tooltip_sections(PYTHON, DESIGN, ItemRef(kind=of, id="Gone/7")) == []


def test_a_state_says_how_long_it_lasts() -> None:
    def lasts(*guards: Guard, unit: str = "") -> list[str]:
        transitions = tuple(Transition(to="Rest", guard=each) for each in guards)
        states = (State(name="Kick", transitions=transitions), State(name="Rest"))
        design = Design(component="D", initial="Kick", time_unit=unit, states=states)
        sections = tooltip_sections(PYTHON, design, ItemRef(kind="states", id="Kick"))
        return [each["text"] for each in sections if each["name"] == "lasts"]

    assert lasts(Guard(after="3")) == ["3 s"]
    assert lasts(Guard(when="state_time > 2"), Guard(after="1", when="not state_time < 5")) == ["2 s"]
    assert lasts(Guard(after="250"), unit="ms") == ["250 ms"]
    assert lasts(Guard(when="done(x)")) == []
    assert lasts(Guard()) == ["one iteration"]
    assert lasts(Guard(after="2", when="action_done")) == ["at least 2 s"]
    assert lasts(Guard(when="action_done"), Guard(after="4")) == ["at most 4 s"]
    assert lasts(Guard(after="1", when="action_done"), Guard(after="4")) == ["1 to 4 s"]
    assert lasts() == []
