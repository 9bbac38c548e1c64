"""Rules for the robots of a team: states in which they wait forever, barriers that are never met."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from vicode.analysis.products import Place
from vicode.analysis.projects import ProjectAnalysis
from vicode.analysis.team_search import TeamSearch, Waiting
from vicode.analysis.teams import TeamAnalysis
from vicode.findings import DesignPath, Finding, FindingSubject, Note, get_rule
from vicode.model.design import Design
from vicode.model.project import Project


@dataclass(frozen=True, slots=True)
class ShownNames:
    """The names of a project in messages."""

    project: Project
    are_xabsl: bool

    def component(self, design: Design) -> str:
        return (self.are_xabsl and design.xabsl_name) or design.component

    def state(self, design: Design, name: str) -> str:
        state = design.state(name)
        return (self.are_xabsl and state is not None and state.xabsl_name) or name

    def input(self, component: str, name: str) -> str:
        interface = self.project.interface(component)
        declared = (interface.output(name) or interface.parameter(name)) if interface else None
        is_known = self.are_xabsl and declared is not None and declared.xabsl_name
        return declared.xabsl_name if declared is not None and is_known else f"{component}.{name}"


def find_in_teams(analysis: ProjectAnalysis, names: ShownNames) -> Iterator[Finding]:
    """D436, D437 and P215."""
    team = TeamAnalysis(analysis)
    if team.searches is None:
        yield _report_undecided(team)
        return
    entered = {search.product.steps[number].place for search in team.searches for number in search.find_taken()}
    never = [place for place, each in team.places.items() if each.is_barrier and place not in entered]
    yield from (_report_never(place, team, names) for place in never)
    shortest: dict[tuple[Place, Place], tuple[TeamSearch, Waiting]] = {}
    for search in team.searches:
        found = tuple(search.find_waiting())
        explained = {each.robots for each in found if each.place in never}
        for each in found:
            key = (each.source, each.place)
            is_shorter = key not in shortest or len(each.run) < len(shortest[key][1].run)
            if each.robots not in explained and is_shorter:
                shortest[key] = (search, each)
    for (source, place), (search, each) in shortest.items():
        machine = analysis.machines[source[0]]
        state = machine.design.state(source[1])
        if state is not None and not state.final:
            path = next(edge.path for edge in machine.live_in(state.name) if edge.target == place[1])
            yield _report_waiting(each, _TeamText(search, names), team, path)


class _TeamText:
    """Describes what the robots of a team do.

    Args:
        search: The search of the team.
        names: The names in messages.
    """

    def __init__(self, search: TeamSearch, names: ShownNames) -> None:
        self._product = search.product
        self._names = names
        self._has_one_component = len({name for active in self._product.states for name in active}) == 1

    def place(self, place: Place) -> str:
        """A state, with its component if the robots have several."""
        design = self._names.project.design(place[0])
        if design is None:
            return f"'{place[1]}'"
        of = "" if self._has_one_component else f" of {self._names.component(design)}"
        return f"'{self._names.state(design, place[1])}'{of}"

    def configuration(self, at: Sequence[int]) -> str:
        """Where the robots are."""
        groups: dict[int, list[int]] = {}
        for number, state in enumerate(at):
            groups.setdefault(state, []).append(number)
        return ", ".join(
            f"{_robots(numbers)} in {' and '.join(map(self.place, self._product.states[state].items()))}"
            for state, numbers in groups.items()
        )

    def run(self, run: Iterable[int]) -> str:
        """What the robots do one after another."""
        parts: list[tuple[list[int], list[str]]] = []
        at = self._product.start
        for number in run:
            step, before, at = self._product.steps[number], at, self._product.take(number, at)
            moved = [robot for robot, state in enumerate(at) if state != before[robot]]
            entered = self.place(step.place) + " together" * step.is_barrier
            if parts and parts[-1][0] == moved:
                parts[-1][1].append(entered)
            elif parts and parts[-1][1] == [entered] and not step.is_barrier:
                parts[-1][0].extend(moved)
            else:
                parts.append((moved, [entered]))
        return "; ".join(
            f"{_robots(moved)} enter{'s' * (len(moved) == 1)} {', '.join(entered)}" for moved, entered in parts
        )


def _robots(numbers: Sequence[int]) -> str:
    texts = [str(number + 1) for number in numbers]
    return f"robot {texts[0]}" if len(texts) == 1 else f"robots {', '.join(texts[:-1])} and {texts[-1]}"


def _report_waiting(waiting: Waiting, text: _TeamText, team: TeamAnalysis, path: DesignPath) -> Finding:
    cooperation = team.places[waiting.place]
    limit, others = ("robots enter together", "come to it") if cooperation.is_barrier else ("can be in", "leave it")
    source, place = text.place(waiting.source), text.place(waiting.place)
    run = text.run(waiting.run)
    return Finding(
        rule=get_rule("D436"),
        message=f"a robot can wait forever in {source} for {place}, which {cooperation.number} {limit}: "
        + text.configuration(waiting.robots),
        fix=f"before this transition, add one that leaves {source}, or let the other robots {others}",
        subject=FindingSubject(component=waiting.place[0], path=path),
        notes=(Note(message=f"a run of {team.size} robots: {run}"),) if run else (),
    )


def _report_never(place: Place, team: TeamAnalysis, names: ShownNames) -> Finding:
    component, name = place
    design = names.project.design(component)
    shown = names.state(design, name) if design else name
    return Finding(
        rule=get_rule("D437"),
        message=f"no run of {team.size} robots ever makes {team.places[place].number} of them enter '{shown}' together",
        fix="let so many robots be in this component at the same time, all with a transition to the state",
        subject=FindingSubject(component=component, path=("states", name, "synchronized")),
    )


def _report_undecided(team: TeamAnalysis) -> Finding:
    component, name = next(iter(team.places))
    return Finding(
        rule=get_rule("P215"),
        message="whether robots can wait forever for each other was not decided: "
        f"{team.size} robots have too many configurations",
        fix="reduce the numbers of robots in `capacity` and `synchronized`, or search the model of "
        "`vicode export --format promela` with SPIN",
        subject=FindingSubject(component=component, path=("states", name)),
    )
