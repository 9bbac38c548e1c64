"""Another name for something that is declared: an edit where one design says it, else planned and written to files."""

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from difflib import SequenceMatcher
from pathlib import Path

from vicode.check import check_project
from vicode.editor.session.document import Act, Document
from vicode.editor.session.names_in_xabsl import count_in_xabsl, follow_in_xabsl, new_words
from vicode.editor.session.renaming import Change, refuse_touching
from vicode.editor.session.wording import reason_of, words_of_path
from vicode.editor.session.workspace import Workspace
from vicode.findings import Finding, Severity
from vicode.model.design import Design
from vicode.model.names import is_name, name_like
from vicode.model.project import Project
from vicode.model.renaming import Declared, Said, Way, has_declared, names_beside, rename_declared
from vicode.model.renaming.cpp import count_in_cpp, says_in_cpp
from vicode.model.renaming.python import says_in_python
from vicode.model.walks import walk_code
from vicode.store import is_read_only, project_file_in, read_project_file, save_design, save_project_file, write_text

_WORDS = {"uses": "alias", "elements": "element", "enumerations": "enumeration"}
_OF_THE_PROJECT = ("enumerations", "constants", "components", "agents")


@dataclass(frozen=True, slots=True, kw_only=True)
class NamePlan:
    """What a new name would change. `refused` says in words why it cannot be done.

    Else `design` is the one design that says it, as it would be; or it is None, and `changes` are the files of all
    that do. `note` tells what nobody but a person can change.
    """

    thing: Declared
    new: str
    refused: str = ""
    design: Design | None = None
    changes: tuple[Change, ...] = ()
    note: str = ""
    by_hand: tuple[str, ...] = ()
    """Where code says the name and it is not certain what it means there."""
    is_alone: bool = False
    """Whether nothing says the name but the line of project.yaml that declares it."""


def words_of_declared(thing: Declared) -> str:
    """What it is, and its name."""
    return f"{_kind(thing)} {thing.name}"


def refuse_shape(name: str) -> str:
    """Why a text is no name of anything, in words; empty if it is one."""
    wanted = name.strip()
    if not wanted:
        return "it needs a name"
    if is_name(wanted):
        return ""
    example = name_like(wanted)
    like = f", such as {example[:1].lower() + example[1:]}" if example else ""
    return f"use letters, digits and underscores, a letter first{like}"


def plan_name(workspace: Workspace, thing: Declared, new: str) -> NamePlan:
    """What another name for a thing would change; nothing is touched."""
    project = workspace.project
    refused = _refuse_name(project, thing, new)
    if refused:
        return NamePlan(thing=thing, new=new, refused=refused)
    renamed = follow_in_xabsl(project, rename_declared(project, thing, new))
    by_hand = tuple(_left_in_code(project, renamed, thing))
    touched = [design.component for design in renamed.designs if project.design(design.component) != design]
    is_shared = any(getattr(renamed, section) != getattr(project, section) for section in _OF_THE_PROJECT)
    refused = refuse_outcome(project, renamed, touched if thing.component and not is_shared else None)
    refused = refused or _refuse_code(project, thing, new)
    if not refused and not is_shared and touched == [thing.component]:
        return NamePlan(thing=thing, new=new, design=renamed.design(thing.component), by_hand=by_hand)
    file = project_file_in(workspace.folder) if is_shared else None
    refused = refused or refuse_touching(workspace, touched) or _refuse_project_file(project, file)
    if refused or (is_shared and file is None):
        return NamePlan(thing=thing, new=new, refused=refused or "there is no project.yaml")
    changes = [_design_change(workspace, design) for design in renamed.designs if design.component in touched]
    if file is not None:
        changes.append(_project_change(file, renamed))
    plan = NamePlan(thing=thing, new=new, changes=tuple(changes), note=_note(project, thing), by_hand=by_hand)
    only = changes[0] if len(changes) == 1 and file is not None else None
    is_alone = only is not None and not plan.note and not by_hand and _changed_lines(only.old or "", only.new) == 1
    return replace(plan, is_alone=is_alone)


def rename_in_files(workspace: Workspace, plan: NamePlan, person: str = "") -> str:
    """Write what a plan says; returns why not, if the files are no longer what it was made for.

    Raises:
        OSError: A file cannot be written; those written before are as they were again.
    """
    again = plan_name(workspace, plan.thing, plan.new)
    if again != plan:
        return again.refused or "a file has changed meanwhile: look at the list once more"
    whole = NewName(workspace=workspace, thing=plan.thing, new=plan.new)
    _write_all(workspace, plan, Act(files=_files_of(plan), label=whole.label, person=person, whole=whole))
    return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class NewName:
    """A new name that was written into several files: the histories of their designs take it back in all of them."""

    workspace: Workspace
    thing: Declared
    new: str

    @property
    def label(self) -> str:
        """What the histories call it."""
        return f"rename {self.thing.name} to {self.new}"

    def take_back(self, person: str) -> str:
        """Give the thing its old name again; returns why not."""
        plan = plan_name(self.workspace, replace(self.thing, name=self.new), self.thing.name)
        return self._carry_out(plan, Act(files=_files_of(plan), label=f"undo {self.label}", person=person, undoes=self))

    def do_again(self, person: str) -> str:
        """Give it the new name once more; returns why not."""
        plan = plan_name(self.workspace, self.thing, self.new)
        return self._carry_out(plan, Act(files=_files_of(plan), label=f"redo {self.label}", person=person, whole=self))

    def _carry_out(self, plan: NamePlan, act: Act) -> str:
        if plan.refused:
            return plan.refused[:1].upper() + plan.refused[1:]
        document = self.workspace.document(self.thing.component)
        if plan.design is not None and document is not None:
            # Nobody else says it any more.
            Document(document.sheet, act.person).follow_act(act, plan.design)
            return ""
        try:
            _write_all(self.workspace, plan, act)
        except (OSError, ValueError) as error:
            return f"Not done: {reason_of(error)}"
        return ""


def _files_of(plan: NamePlan) -> frozenset[Path]:
    return frozenset(change.file for change in plan.changes)


def _write_all(workspace: Workspace, plan: NamePlan, act: Act) -> None:
    """Write all files of a plan, or none of them; open designs follow, and who is at them hears of it."""
    written: list[Change] = []
    try:
        for change in plan.changes:
            write_text(change.file, change.new)
            written.append(change)
    except OSError:
        for change in written:
            write_text(change.file, change.old or "")
        raise
    finally:
        workspace.follow_disk(act)
    who = workspace.people.name_of(act.person) if act.person else "Somebody"
    for document in workspace.documents:
        hand = Document(document.sheet, act.person)
        if document.file in act.files:
            hand.announce(f"{who} renamed {words_of_declared(plan.thing)} to {plan.new} in {_count_files(act.files)}")
        # The form of every design shows what the project declares.
        document.sheet.tell(hand)


def _kind(thing: Declared) -> str:
    return _WORDS.get(thing.section, thing.section.removesuffix("s"))


def _count_files(files: Collection[Path]) -> str:
    return "1 file" if len(files) == 1 else f"{len(files)} files"


def _refuse_name(project: Project, thing: Declared, new: str) -> str:
    """Why nothing can have such a name here, or is not there to get it."""
    kind = _kind(thing)
    shape = refuse_shape(new)
    if shape:
        return shape
    if not has_declared(project, thing):
        return f"there is no {words_of_declared(thing)} any more"
    if new in names_beside(project, thing):
        return f"there is already {'an' if kind[0] in 'aeo' else 'a'} {kind} {new}"
    if thing.section == "components" and project.interface(new) is not None:
        return f"there is already a component {new}"
    return ""


def _refuse_code(project: Project, thing: Declared, new: str) -> str:
    """Whether code of the design already says `self.NEW`, or `this->NEW`: it would mean something else then."""
    design, said = project.design(thing.component), Said(way=Way.OWN, old=new, new=f"{new}_")
    if design is None or thing.section == "arguments":
        return ""
    for language, says, me in (("python", says_in_python, "self."), ("cpp", says_in_cpp, "this->")):
        texts = ((placed.code.in_language(language) or "", placed.role) for placed in walk_code(design))
        if any(says(text, role, said) for text, role in texts):
            return f"the code of {thing.component} says {me}{new} already, and means something else"
    return ""


def refuse_outcome(project: Project, renamed: Project, components: Collection[str] | None) -> str:
    """What errors a change would bring to the project or to designs of it (None: to all), in words."""
    before, after = (errors_of(each, components) for each in (project, renamed))
    grown = Counter(each.rule.code for each in after) - Counter(each.rule.code for each in before)
    known = {each.message for each in before}
    found = next((each for each in after if each.rule.code in grown and each.message not in known), None)
    if found is None:
        return ""
    where = found.thing.component if found.thing and components is None else ""
    return f"{found.message}{f', in {where}' if where else ''}"


def errors_of(project: Project, components: Collection[str] | None = None) -> list[Finding]:
    """The errors of a project and all its designs, or those of `components`."""
    found = [each for each in check_project(project, components) if each.severity is Severity.ERROR]
    # What is wrong with a name itself comes first: it says most.
    return sorted(found, key=lambda each: each.rule.code not in ("D404", "D405", "D406", "D407"))


def _refuse_project_file(project: Project, file: Path | None) -> str:
    if file is None:
        return ""
    if is_read_only(file):
        return f"{file.name} cannot be changed: read-only"
    read = read_project_file(_read(file), str(file)).project
    if read is None or any(getattr(read, section) != getattr(project, section) for section in _OF_THE_PROJECT):
        return f"{file.name} was just changed by another program, or cannot be read: look again"
    return ""


def _design_change(workspace: Workspace, design: Design) -> Change:
    file = workspace.files[design.component]
    text = _read(file)
    new = save_design(design, text)
    return Change(file=file, old=text, new=new, words=f"{design.component}: {_count_lines(text, new)}")


def _project_change(file: Path, renamed: Project) -> Change:
    text = _read(file)
    read = read_project_file(text, str(file)).project
    assert read is not None
    changed = replace(
        read,
        enumerations=renamed.enumerations,
        constants=renamed.constants,
        components=renamed.components,
        agents=renamed.agents,
    )
    new = save_project_file(changed, text)
    return Change(file=file, old=text, new=new, words=f"the project: {_count_lines(text, new)}")


def _changed_lines(old: str, new: str) -> int:
    blocks = SequenceMatcher(None, old.splitlines(), new.splitlines(), autojunk=False).get_opcodes()
    return sum(max(block[2] - block[1], block[4] - block[3]) for block in blocks if block[0] != "equal")


def _count_lines(old: str, new: str) -> str:
    count = _changed_lines(old, new)
    return "1 line" if count == 1 else f"{count} lines"


def _left_in_code(project: Project, renamed: Project, thing: Declared) -> Iterator[str]:
    """Where C++ and XABSL still say the old name: there a person must look."""
    words = new_words(project, renamed).old
    in_xabsl = {*words, thing.name} if words else set()
    for design in renamed.designs:
        used = [use.component for use in design.uses]
        if thing.component and thing.component not in (design.component, *used):
            continue
        for placed in walk_code(design):
            for language, text in placed.code.texts:
                name, count = {
                    "cpp": ("C++", count_in_cpp(text, thing.name)),
                    "xabsl": ("XABSL", count_in_xabsl(text, in_xabsl)),
                }.get(language, ("", 0))
                if count:
                    often = f", {count} times" if count > 1 else ""
                    yield f"{design.component}: {words_of_path(placed.path[:-1] or placed.path)}, {name}{often}"


def _note(project: Project, thing: Declared) -> str:
    """What stays to be done by hand: a class that somebody wrote has the name, too."""
    interface = project.interface(thing.component or thing.name)
    if interface is None or ":" not in interface.implementation:
        return ""
    if thing.section == "components":
        return f"{interface.implementation} keeps its name: it is the class, and written by hand."
    return f"Rename it in {interface.implementation}, too: that class is written by hand."


def _read(file: Path) -> str:
    return file.read_bytes().decode("utf-8")
