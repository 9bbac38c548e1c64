"""Proposes states that were added, deleted or renamed in a C++ source."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from vicode.generators.cpp import CppCode
from vicode.model.design import Design, State
from vicode.model.edits import remove_states, rename_state
from vicode.sync.interpret.cpp_comparison import CppFile


def propose_states(design: Design, code: CppCode, generated: CppFile, edited: CppFile) -> Iterator[Design]:
    """Yield designs with the states that `state_name` lists in the edited file."""
    own = _names(generated)
    written = _names(edited)
    removed = [element for element in own if element not in written]
    added = [element for element in written if element not in own]
    states = code.symbols.states
    if not written or not (removed or added):
        yield design
        return
    if len(removed) == len(added) == 1 and list(own).index(removed[0]) == list(written).index(added[0]):
        yield rename_state(design, states[removed[0]], written[added[0]])
    changed = remove_states(design, [states[element] for element in removed if element in states])
    order = list(written)
    for element in added:
        before = [states.get(each, written[each]) for each in order[: order.index(element)]]
        changed = _inserted(changed, written[element], before)
    yield changed


def _names(file: CppFile) -> dict[str, str]:
    """The states by the element of the enumeration."""
    found = next((name for name, item in file.functions.items() if item.short_name == "state_name"), "")
    cases = (file.body(found).cases or {}) if found else {}
    return {element: tokens[1].text.strip('"') for element, tokens in cases.items() if len(tokens) == 3}


def _inserted(design: Design, name: str, before: Sequence[str]) -> Design:
    """The design with an empty state behind the last of some states.

    It has the requirements that all others have: the code for them names no state.
    """
    requires = {state.requires for state in design.states}
    state = State(name=name, requires=requires.pop() if len(requires) == 1 else ())
    places = [at for at, each in enumerate(design.states) if each.name in before]
    at = places[-1] + 1 if places else len(design.states)
    return replace(design, states=(*design.states[:at], state, *design.states[at:]))
