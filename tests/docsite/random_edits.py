"""Edits of a project, each of some other thing, for what must hold after any of them."""

import random
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from vicode.model.design import Declaration, Design, Guard, State, Transition
from vicode.model.project import Project
from vicode.store import open_project

FORWARD = open_project(Path(__file__).parents[2] / "designs" / "forward").project
NEW_STATE = State(name="Added", doc="*New* here.", transitions=(Transition(to="Added", guard=Guard(after="2")),))

Edit = Callable[[Project, random.Random], Project]


def edit_random_design(project: Project, chance: random.Random, change: Callable[[Design], Design]) -> Project:
    if not project.designs:
        return project
    at = chance.randrange(len(project.designs))
    designs = list(project.designs)
    designs[at] = change(designs[at])
    return replace(project, designs=tuple(designs))


def edit_random_state(project: Project, chance: random.Random, change: Callable[[State], State]) -> Project:
    def edit(design: Design) -> Design:
        at = chance.randrange(len(design.states)) if design.states else 0
        return replace(
            design, states=tuple(change(each) if index == at else each for index, each in enumerate(design.states))
        )

    return edit_random_design(project, chance, edit)


EDITS: tuple[Edit, ...] = (
    lambda project, chance: edit_random_design(
        project, chance, lambda design: replace(design, doc=f"Doc {chance.random()}.")
    ),
    lambda project, chance: edit_random_design(
        project, chance, lambda design: replace(design, states=design.states[1:])
    ),
    lambda project, chance: edit_random_design(
        project, chance, lambda design: replace(design, states=(*design.states, NEW_STATE))
    ),
    lambda project, chance: edit_random_design(project, chance, lambda design: replace(design, uses=design.uses[1:])),
    lambda project, chance: edit_random_design(
        project, chance, lambda design: replace(design, component=design.component + "X")
    ),
    lambda project, chance: edit_random_design(project, chance, lambda design: replace(design, initial="Nowhere")),
    lambda project, chance: edit_random_design(
        project,
        chance,
        lambda design: replace(design, outputs=(*design.outputs, Declaration(name=f"o{chance.randrange(9)}", doc="!"))),
    ),
    lambda project, chance: edit_random_state(
        project, chance, lambda state: replace(state, doc=f"*{chance.random()}*")
    ),
    lambda project, chance: edit_random_state(project, chance, lambda state: replace(state, transitions=())),
    lambda project, chance: edit_random_state(
        project, chance, lambda state: replace(state, requires=state.requires[1:])
    ),
    lambda project, chance: edit_random_state(project, chance, lambda state: replace(state, name=f"{state.name}2")),
    lambda project, chance: edit_random_state(
        project, chance, lambda state: replace(state, disabled=not state.disabled)
    ),
    lambda project, chance: edit_random_state(project, chance, lambda state: replace(state, at=None)),
    lambda project, chance: replace(project, designs=project.designs[1:]),
    lambda project, chance: replace(project, designs=(*project.designs, *FORWARD.designs[:1])),
    lambda project, chance: replace(project, doc=f"About {chance.random()}."),
    lambda project, chance: replace(project, agents=project.agents[1:]),
    lambda project, chance: replace(project, components=project.components[1:]),
    lambda project, chance: replace(
        project, components=tuple(replace(each, doc=f"{each.doc} more") for each in project.components)
    ),
    lambda project, chance: replace(project, enumerations=project.enumerations[1:]),
    lambda project, chance: replace(project, constants=(Declaration(name="limit", initial=str(chance.random())),)),
    lambda project, chance: FORWARD,
)
