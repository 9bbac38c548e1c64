"""A team of robots that run a design, as a model for SPIN."""

import re
from collections.abc import Iterator

from vicode.analysis.products import Product, TeamStep
from vicode.analysis.projects import ProjectAnalysis
from vicode.analysis.team_search import TooManyConfigurationsError
from vicode.analysis.teams import TeamAnalysis
from vicode.diagram.export_formats import NotExportableError
from vicode.model.design import Design
from vicode.model.project import Project

_MOST_ROBOTS = 200


def write_promela(project: Project, design: Design) -> str:
    """The model of as many robots as the states need that they coordinate.

    Raises:
        NotExportableError: SPIN cannot have so many robots, or a robot has too many states.
    """
    team = TeamAnalysis(ProjectAnalysis(project), (design.component,))
    if team.size > _MOST_ROBOTS:
        raise NotExportableError(f"a model for SPIN has at most {_MOST_ROBOTS} robots; the design needs {team.size}")
    try:
        product = team.make_product((design.component,) * team.size)
    except TooManyConfigurationsError:
        raise NotExportableError("the components of a robot have too many states together") from None
    return "\n".join(_write(product, design.component)) + "\n"


def _write(product: Product, component: str) -> Iterator[str]:
    names = [f"s{number}_{'_'.join(map(_word, active.values()))}" for number, active in enumerate(product.states)]
    size = len(product.robots)
    yield f"/* {size} robots with the component {_word(component)}. The end is invalid if a robot waits forever:"
    yield "   spin -a FILE && gcc -O2 -DSAFETY -o pan pan.c && ./pan; spin -t -p FILE shows how it comes to this. */"
    yield from (f"#define {name} {number}" for number, name in enumerate(names))
    yield f"short at[{size}]; /* the states of the robots */\n"
    places = list(dict.fromkeys(step.place for step in product.steps if step.cooperation))
    barriers = {step.place: step for step in product.steps if step.is_barrier}
    for number, place in enumerate(places):
        yield f"/* {_word(place[0])}: {_word(place[1])} */"
        counted = {"inside": product.find_states(*place)}
        if place in barriers:
            counted |= {"active": product.find_states(place[0]), "ready": frozenset(barriers[place].targets)}
        for kind, states in counted.items():
            macro, robots = f"{kind}{number}", range(size)
            yield f"#define {macro}(r) ({' || '.join(f'at[r] == {names[state]}' for state in sorted(states))})"
            yield f"#define {macro}_count ({' + '.join(f'{macro}({robot})' for robot in robots)})"
    yield f"\nactive [{size}] proctype robot() {{\n  do"
    for step in product.steps:
        if not step.is_barrier:
            room = f" && inside{places.index(step.place)}_count < {step.cooperation.number}" if step.cooperation else ""
            yield from (f"  :: atomic {{ {_move(move, names, '_pid', room)} }}" for move in step.targets.items())
    yield from (f"  :: at[_pid] == {name} -> break" for state, name in enumerate(names) if not product.leaving[state])
    yield "  od\n}"
    for place, step in barriers.items():
        yield from _write_barrier(step, places.index(place), names, size)


def _write_barrier(step: TeamStep, number: int, names: list[str], size: int) -> Iterator[str]:
    """A process that moves all robots at once when they are ready."""
    least = step.cooperation.number if step.cooperation else 0
    yield f"\nactive proctype together{number}() {{\n  byte r;\nend:\n  do\n  :: d_step {{"
    yield f"       active{number}_count >= {least} && ready{number}_count > 0 &&"
    yield f"       ready{number}_count + inside{number}_count == active{number}_count ->\n       r = 0;\n       do"
    for move in step.targets.items():
        yield f"       :: r < {size} && {_move(move, names, 'r', '')}; r++"
    yield f"       :: r < {size} && !ready{number}(r) -> r++\n       :: r == {size} -> r = 0; break\n       od"
    yield "     }\n  od\n}"


def _move(move: tuple[int, int], names: list[str], robot: str, condition: str) -> str:
    return f"at[{robot}] == {names[move[0]]}{condition} -> at[{robot}] = {names[move[1]]}"


def _word(text: str) -> str:
    return re.sub(r"\W", "_", text, flags=re.ASCII)
