"""Each edit of an imported project changes the lines of a behavior that a person would change, and no others."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from tests.services.imported_behavior.kickoff_behavior import TEXTS, changed_lines, paired
from tests.services.imported_behavior.test_behavior_update import imported, updated
from tests.services.imported_behavior.test_update_examples import change_state, with_transitions
from tests.strategies.project_edits import with_design
from vicode.model.design import Declaration
from vicode.model.project import Project
from vicode.model.rename import SymbolRef, rename_symbol

RENAMES: dict[str, tuple[SymbolRef, list[str]]] = {
    "parameter": (
        SymbolRef(section="parameters", component="kickoff", name="reach"),
        ['- float @reach "mm";', '+ float @new "mm";'],
    ),
    "element": (
        SymbolRef(section="elements", owner="side", name="left"),
        ["- left,", "+ new,", "- } else if(ball.side==left) {", "+ } else if(ball.side==new) {"],
    ),
    "enumeration": (
        SymbolRef(section="enumerations", name="side"),
        ["- enum side {", "+ enum new {", "- enum side input ball.side;", "+ enum new input ball.side;"],
    ),
    "constant": (
        SymbolRef(section="constants", name="near"),
        [
            '- float const near = 100 "mm";',
            '+ float const new = 100 "mm";',
            "- if((ball.x<near)  &&  ball.seen) { // now",
            "+ if((ball.x<new)  &&  ball.seen) { // now",
        ],
    ),
    "parameter of a basic behavior": (
        SymbolRef(section="parameters", component="walk", name="speed"),
        [
            "- behavior walk { float speed; bool fast; }",
            "+ behavior walk { float new; bool fast; }",
            "- walk(speed=ball.x*2,",
            "+ walk(new=ball.x*2,",
        ],
    ),
}


@pytest.mark.parametrize("name", RENAMES)
def test_a_renamed_symbol_changes_its_uses(name: str) -> None:
    symbol, expected = RENAMES[name]
    assert paired(changed_lines(rename_symbol(imported(TEXTS), symbol, "new"))) == paired(expected)


def test_a_renamed_design_renames_its_file() -> None:
    project = imported(TEXTS)
    project = replace(
        project,
        designs=(replace(project.designs[0], component="start"),),
        agents=(replace(project.agents[0], root="start"),),
    )
    new = updated(TEXTS, project)
    kickoff = new.pop("Options/SetPlays/start.xabsl")
    assert kickoff == TEXTS["Options/SetPlays/kickoff.xabsl"].replace("option kickoff", "option start")
    agents = TEXTS["agents.xabsl"].replace("kickoff.xabsl", "start.xabsl").replace(", kickoff", ", start")
    others = {name: text for name, text in TEXTS.items() if "kickoff" not in name}
    assert new == {**others, "agents.xabsl": agents}


def change_component(name: str, **changes: object) -> Callable[[Project], Project]:
    def change(project: Project) -> Project:
        components = (
            replace(each, **changes) if each.component == name else each  # type: ignore[arg-type]
            for each in project.components
        )
        return replace(project, components=tuple(components))

    return change


def with_outputs(change: Callable[..., tuple[Declaration, ...]]) -> Callable[[Project], Project]:
    def changed(project: Project) -> Project:
        ball = next(each for each in project.components if each.component == "ball")
        return change_component("ball", outputs=change(*ball.outputs))(project)

    return changed


PROJECT_EDITS: dict[str, tuple[Callable[[Project], Project], list[str]]] = {
    "a range": (
        with_outputs(lambda x, *rest: (replace(x, range=(-5000, 5000)), *rest)),
        ['- float input ball.x [-4500..4500] "mm";  // field', '+ float input ball.x [-5000..5000] "mm";  // field'],
    ),
    "a word of a description": (
        with_outputs(lambda x, *rest: (replace(x, doc="where it was"), *rest)),
        ["- /** where it is */", "+ /** where it was */"],
    ),
    "a type": (
        with_outputs(lambda x, seen, *rest: (x, replace(seen, type="float"), *rest)),
        ["- bool  input ball.seen;", "+ float input ball.seen;"],
    ),
    "an added output": (
        with_outputs(lambda *all: (*all, Declaration(name="far", type="bool"))),
        ["+ bool input ball.far;"],
    ),
    "a removed output": (
        with_outputs(lambda x, seen, side: (x, seen)),
        ["- enum side input ball.side;"],
    ),
    "an added element": (
        lambda project: replace(
            project,
            enumerations=(replace(project.enumerations[0], elements=(*project.enumerations[0].elements, ("top", ""))),),
        ),
        ["- right", "+ right,", "+ top"],
    ),
    "a constant": (
        lambda project: replace(project, constants=(replace(project.constants[0], initial="-2", unit="cm"),)),
        ['- float const near = 100 "mm";', '+ float const near = -2 "cm";'],
    ),
    "an added constant": (
        lambda project: replace(project, constants=(*project.constants, Declaration(name="far", initial="9"))),
        ["+ float const far = 9;"],
    ),
    "a parameter of a basic behavior": (
        change_component("walk", parameters=(Declaration(name="speed", type="float", unit="m"),)),
        ["- behavior walk { float speed; bool fast; }", '+ behavior walk { float speed "m"; }'],
    ),
    "a namespace": (
        change_component("ball", title="A ball", doc="It rolls."),
        ['- namespace ball("Ball")', "+ /** It rolls. */", '+ namespace ball("A ball")'],
    ),
    "an agent": (
        lambda project: replace(project, agents=(replace(project.agents[0], title="One", doc="the two"),)),
        [
            "- /** the one */",
            "+ /** the two */",
            '- agent player("Player", kickoff);',
            '+ agent player("One", kickoff);',
        ],
    ),
    "a second agent": (
        lambda project: replace(project, agents=(*project.agents, replace(project.agents[0], name="other"))),
        ["+ /** the one */", '+ agent other("Player", kickoff);'],
    ),
    "the title": (
        lambda project: replace(project, doc="A team\nof one."),
        ["+ /***", "+ Title: A team", "+ of one.", "+ */"],
    ),
}
USED_ELSEWHERE = {
    "a type": with_transitions("wait", lambda one, two: (two,)),
    "a removed output": with_transitions("wait", lambda one, two: (one,)),
    "a parameter of a basic behavior": lambda design: change_state("kick", actions=())(
        change_state("wait", actions=())(design)
    ),
}


@pytest.mark.parametrize("name", PROJECT_EDITS)
def test_an_edited_project_changes_these_lines(name: str) -> None:
    change, expected = PROJECT_EDITS[name]
    project = imported(TEXTS)
    if name in USED_ELSEWHERE:
        project = with_design(project, USED_ELSEWHERE[name](project.designs[0]))
    lines = changed_lines(change(project))
    for line in changed_lines(project):
        lines.remove(line)
    assert paired(lines) == paired(expected)
