"""From the current design to the files and the setup of a simulation process."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from pathlib import Path

from vicode.bica.tick import choose_tick_ns
from vicode.check import find_errors
from vicode.check.classes import check_classes
from vicode.check.module_names import check_module_names
from vicode.generators import collect_components, generate, python_class_path, python_probes
from vicode.model.decision_keys import with_decision_ids
from vicode.model.design import Decision, DecisionGroup, Design, Transition
from vicode.model.project import INTERNAL, Interface, Project
from vicode.output import OutputFile
from vicode.runs.inputs import SimulationInput, collect_inputs, input_types, make_stub
from vicode.simulation import Setup
from vicode.simulation.stubs import STUB_MODULE
from vicode.store import read_python_module


class NotReadyError(Exception):
    """The design cannot be simulated; the message is the reason."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunConfig:
    """How to simulate: the stubbed components (None: all hand-written ones), the seed of the world, the time between
    iterations (None: fits the frequencies).
    """

    stubbed: frozenset[str] | None = None
    seed: int = 0
    tick_ms: float | None = None
    limit_s: float = 2.0
    memory_bytes: int = 1 << 30


@dataclass(frozen=True, slots=True, kw_only=True)
class PreparedRun:
    """The files to write into an empty folder, the setup, and the inputs."""

    design: Design
    files: tuple[OutputFile, ...]
    setup: Setup
    inputs: tuple[SimulationInput, ...]


def used_components(project: Project, design: Design) -> tuple[str, ...]:
    """The components that a design uses, directly or not; users come before what they use."""
    found: list[str] = []
    waiting = [use.component for use in design.uses]
    while waiting:
        component = waiting.pop(0)
        if component in found or component == design.component:
            continue
        found.append(component)
        own = project.design(component)
        waiting += [use.component for use in own.uses] if own else []
    return tuple(found)


def hand_written_components(project: Project, design: Design) -> frozenset[str]:
    """The used components without a design, except shared memories, which vicode stores."""
    kept = {each.component for each in project.components if each.implementation == INTERNAL}
    return frozenset(name for name in used_components(project, design) if project.design(name) is None) - kept


def stubbed_components(project: Project, design: Design, config: RunConfig) -> frozenset[str]:
    """The components that a configuration replaces by stubs."""
    return hand_written_components(project, design) if config.stubbed is None else config.stubbed


def prepare_run(
    project: Project, design: Design, config: RunConfig, sources: Mapping[str, str], folder: Path
) -> PreparedRun:
    """Generate everything a run needs, without writing files.

    Args:
        project: the project of the design.
        design: the current design.
        config: how to simulate.
        sources: the design files by component.
        folder: the project folder, from which hand-written code is imported.

    Raises:
        NotReadyError: The design, or one that it uses, has errors.
        UnsoundDesignError: It cannot be generated.
    """
    designs = tuple(design if each.component == design.component else each for each in project.designs)
    whole = replace(project, designs=designs)
    chosen = stubbed_components(whole, design, config)
    stub_names = tuple(name for name in used_components(whole, design) if name in chosen)
    inputs = collect_inputs(whole, design, stub_names)
    stubbed = _with_stubs(whole, stub_names)
    _check_errors(whole, collect_components(stubbed, (design.component,)))
    ready = replace(stubbed, designs=tuple(with_decision_ids(each) for each in stubbed.designs))
    files = generate(ready, components=(design.component,), languages=("python",), sources=sources)
    probes = python_probes(ready, design.component)
    types = input_types(whole, inputs)
    class_path = python_class_path(ready, design.component)
    runs_by_hand = hand_written_components(stubbed, design) - set(stub_names)
    _check_classes(whole, runs_by_hand, folder)
    if runs_by_hand and project.clock:
        remedy = "run it with vicode run --watch, and attach"
        raise NotReadyError(f"{project.world} sets the pace (clock: world), which a simulation cannot follow; {remedy}")
    setup = Setup(
        component=class_path,
        probes=f"{class_path.partition('.')[0]}._probes",
        path=(str(folder.resolve()),),
        stubs=tuple(make_stub(whole, component, inputs, types) for component in stub_names),
        functions=_function_outputs(stubbed, design, stub_names),
        parameter_types=tuple((each.name, types[each.key]) for each in inputs if not each.component),
        world=project.world if runs_by_hand else "",
        seed=config.seed,
        tick_ns=round(config.tick_ms * 1e6) if config.tick_ms else _fitting_tick_ns(whole, design),
        limit_s=config.limit_s,
        memory_bytes=config.memory_bytes,
    )
    return PreparedRun(design=design, files=(*files, probes), setup=setup, inputs=inputs)


def prepare_view(design: Design) -> PreparedRun:
    """A design to view what ran elsewhere; it may have errors."""
    return PreparedRun(design=design, files=(), setup=Setup(component=design.component, probes="", path=()), inputs=())


def _fitting_tick_ns(project: Project, design: Design) -> int:
    """The tick of `vicode run`."""
    names = {design.component, *used_components(project, design)}
    declared: list[Design | Interface] = [*project.designs, *project.components]
    return choose_tick_ns(each.frequency_hz for each in declared if each.frequency_hz and each.component in names)


def behavior_key(project: Project, design: Design) -> object:
    """A value that changes exactly when the behavior of a simulation may change; positions do not count."""
    names = {design.component, *used_components(project, design)}
    current = (design if each.component == design.component else each for each in project.designs)
    designs = tuple(_without_positions(each) for each in current if each.component in names)
    return (designs, project.enumerations, project.constants, project.components, project.world)


def _check_errors(project: Project, components: frozenset[str]) -> None:
    errors = [each for each in find_errors(project, components) if each.applies_to("python")]
    if errors:
        first = errors[0]
        where = f"{first.subject.component}: " if first.subject and first.subject.component else ""
        more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
        raise NotReadyError(f"{where}{first.message}{more}. Fix it, then restart.")


def _check_classes(project: Project, components: Collection[str], folder: Path) -> None:
    read_module = partial(read_python_module, folder)
    found = (check(project, read_module, components) for check in (check_classes, check_module_names))
    for finding in chain.from_iterable(found):
        where = f"{Path(finding.location.file).name}, line {finding.location.line}: " if finding.location else ""
        raise NotReadyError(f"{where}{finding.message}. Fix it, then restart.")


def _with_stubs(project: Project, stub_names: tuple[str, ...]) -> Project:
    """The project with stubs in place of components."""
    replaced = []
    for component in stub_names:
        interface = project.interface(component) or Interface(component=component)
        replaced.append(replace(interface, implementation=f"{STUB_MODULE}:{component}", remote=None))
    kept = tuple(each for each in project.components if each.component not in stub_names)
    designs = tuple(each for each in project.designs if each.component not in stub_names)
    return replace(project, components=(*kept, *replaced), designs=designs)


def _function_outputs(
    project: Project, design: Design, stub_names: tuple[str, ...]
) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """Outputs with arguments of components that are not stubbed; they are not called between iterations."""
    found = []
    for use in design.uses:
        interface = project.interface(use.component)
        outputs = interface.readable if interface and use.component not in stub_names else ()
        names = tuple(output.name for output in outputs if output.arguments is not None)
        found += [(use.alias, names)] if names else []
    return tuple(found)


def _without_positions(design: Design) -> Design:
    common = replace(design.common, at=None, transitions=_without_label_positions(design.common.transitions))
    states = (replace(each, at=None, transitions=_without_label_positions(each.transitions)) for each in design.states)
    uses = (replace(use, at=None) for use in design.uses)
    return replace(design, uses=tuple(uses), common=common, states=tuple(states))


def _without_label_positions(items: tuple[Decision, ...]) -> tuple[Decision, ...]:
    def unplaced(item: Decision) -> Decision:
        if isinstance(item, DecisionGroup):
            return replace(
                item, then=_without_label_positions(item.then), otherwise=_without_label_positions(item.otherwise)
            )
        return replace(item, label_at=None) if isinstance(item, Transition) else item

    return tuple(unplaced(item) for item in items)
