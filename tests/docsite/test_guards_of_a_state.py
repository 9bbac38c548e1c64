"""What the page of a state machine says about the guards of a state."""

from tests.docsite.link_checker import read_page
from vicode.docsite import SiteInput, build_site
from vicode.model.design import Declaration, Design, Guard, State, Transition
from vicode.model.project import Project


def test_guards_that_can_hold_together_are_shown_if_they_are_few() -> None:
    def transitions(*guards: str) -> tuple[Transition, ...]:
        return tuple(Transition(to=f"B{index}", guard=Guard(when=guard)) for index, guard in enumerate(guards))

    states = (
        State(name="Few", transitions=(*transitions("d < 3", "d > 1", "d > 5"), Transition(to="Many"))),
        State(name="Many", transitions=transitions("d > 4", "d > 3", "d > 2", "d > 1")),
        *(State(name=f"B{index}") for index in range(4)),
    )
    distance = Declaration(name="d", type="float", range=(0, 9))
    design = Design(component="Team", parameters=(distance,), initial="Few", states=states)
    files = build_site(SiteInput(project=Project(name="p", designs=(design,))))
    (text,) = (file.text for file in files if file.path == "component-Team.html")
    words = " ".join(read_page(text).text.split())
    assert "Can hold together1 and 2, with d = 2; 2 and 3, with d = 7: the first one is taken" in words
    assert words.count("Can hold together") == 1
