"""Writes the changes between two versions of a program into its original files.

Three trees are walked in parallel. `before` and `after` are generated, so that they have one form and each difference
is an edit; `original` is the program of `before` as people wrote it, and gives the tokens to change. Where the parts of
`original` and `before` do not correspond, the smallest part around them is replaced. Renamed items are renamed in
`original` and `before` first, so that everything else is compared by name. The caller compiles and compares the result.
"""

import posixpath
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from vicode.matching import Match
from vicode.xabsl import tree
from vicode.xabsl.compiler import CompileResult
from vicode.xabsl.lexer import Comment
from vicode.xabsl.parser import ParsedFile, parse
from vicode.xabsl.patching.declaration_edits import edit_agent, edit_declarations, edit_doc
from vicode.xabsl.patching.list_edits import ListStyle, edit_list
from vicode.xabsl.patching.option_edits import OptionVersion, edit_option
from vicode.xabsl.patching.program_items import DeclaredItem, Key, agents, declarations, iter_items, namespaces, options
from vicode.xabsl.patching.renames import Renames, find_renames, rename
from vicode.xabsl.patching.source_edits import PatchError, SourceEdits
from vicode.xabsl.printer import print_file, print_node
from vicode.xabsl.source_loader import ProgramSource


@dataclass(frozen=True, slots=True)
class ProgramVersion:
    """A version of a program, as a compiled source.

    Attributes:
        state_orders: The order of states by option, if it differs from that of the source.
        folders: The folders of new options relative to the main file, by option.
        moves: The new paths of the files of options, relative to the folder of the main file and without suffix.
    """

    source: ProgramSource
    compiled: CompileResult
    state_orders: Mapping[str, Sequence[str]] = field(default_factory=dict)
    folders: Mapping[str, str] = field(default_factory=dict)
    moves: Mapping[str, str] = field(default_factory=dict)


FileTexts = dict[Path, str | None]
"""Texts of files by path; None for a removed file."""


def patch_program(original: ProgramVersion, before: ProgramVersion, after: ProgramVersion) -> FileTexts:
    """Change the files of a program; returns the changed, added and removed files.

    Args:
        original: The files to change.
        before: The same program in the form of `after`, for example generated from an import of `original`.
        after: The changed program.

    Raises:
        PatchError: A change cannot be written into the files.
    """
    renames = find_renames(before.compiled, after.compiled)
    renamed = rename(original.source, original.compiled, renames)
    texts: FileTexts = dict(renamed)
    old, base = _with_texts(original.source, renamed), before.source
    if renames:
        base = _with_texts(base, rename(base, before.compiled, renames))
    texts |= _ProgramPatch(old, base, after, _moved_files(old, renames, after.moves)).run()
    return {path: text for path, text in texts.items() if text is None or text != _original_text(original, path)}


def _original_text(original: ProgramVersion, path: Path) -> str | None:
    parsed = original.source.files.get(path)
    return parsed.tokens.text if parsed else None


def _with_texts(source: ProgramSource, texts: Mapping[Path, str]) -> ProgramSource:
    files = {path: parse(texts[path], str(path)) if path in texts else old for path, old in source.files.items()}
    return ProgramSource(source.main, files, source.encodings, source.findings)


class _ProgramPatch:
    def __init__(
        self, old: ProgramSource, before: ProgramSource, after: ProgramVersion, moved: Mapping[Path, Path]
    ) -> None:
        self.old, self.before, self.after, self.moved = old, before, after, moved
        self.files = {path: SourceEdits(parsed) for path, parsed in old.files.items()}
        self.added: dict[Path, str] = {}
        self.removed: list[Path] = []

    def run(self) -> FileTexts:
        self._edit_header()
        self._edit_agents()
        self._edit_options()
        self._edit_declarations()
        self._edit_includes()
        texts: FileTexts = {path: file.result() for path, file in self.files.items() if file.edits}
        for path, new in self.moved.items():
            texts |= {new: self.files[path].result(), path: None}
        return {**texts, **self.added, **dict.fromkeys(self.removed)}

    # Main file

    def _edit_header(self) -> None:
        before = self.before.files[self.before.main].file.header
        after = self.after.source.files[self.after.source.main].file.header
        if before == after:
            return
        file = self.files[self.old.main]
        comment = f"/***\n{after}\n*/"
        if file.parsed.file.header:
            file.replace(file.start(0), file.end(0), comment)
        else:
            file.insert(len(file.text) - len(file.text.lstrip("\ufeff")), comment + "\n")

    def _edit_agents(self) -> None:
        olds, befores, afters = ([*agents(source)] for source in (self.old, self.before, self.after.source))
        path = next(path for path, _file, item in iter_items(self.old) if isinstance(item, tree.AgentNode))
        known = {agent.name.text: agent for agent in befores}
        names = [agent.name.text for agent in olds]
        matches, added = [], []
        for agent in afters:
            name = agent.name.text
            matches.append(names.index(name) if name in names else None)
            added.append("" if name in names else print_node(agent))
            if name in names:
                edit_agent(self.files[path], olds[names.index(name)], known[name], agent)
        if matches != list(range(len(olds))):
            edit_list(self.files[path], olds, matches, added, ListStyle(opening=olds[0].first_token - 1, indent=""))

    # Options

    def _edit_options(self) -> None:
        olds = {
            item.name.text: (path, item)
            for path, _file, item in iter_items(self.old)
            if isinstance(item, tree.OptionNode)
        }
        befores, afters = options(self.before), options(self.after.source)
        for name, (option, parsed) in afters.items():
            states = _ordered(option.states, self.after.state_orders.get(name, ()))
            version = OptionVersion(option, parsed, states)
            if name not in olds:
                self._add_option(name, version)
                continue
            path, old = olds[name]
            was, was_in = befores[name]
            order = [state.name.text for state in old.states]
            before = OptionVersion(was, was_in, _ordered(was.states, order))
            edit_option(self.files[path], old, before, version)
            _check_overlaps(self.files[path], name)
        self.removed += [olds[name][0] for name in olds if name not in afters]

    def _add_option(self, name: str, version: OptionVersion) -> None:
        folder = self.old.main.parent / self._folder(name)
        first = version.option.first_token
        # The comment above an option is the header of the generated file.
        comments = {at: list(each) for at, each in version.comments.items() if at != first}
        option = tree.OptionNode(
            version.option.name,
            version.option.parameters,
            [*version.option.states],
            version.option.common_decision,
            version.option.common_actions,
            version.option.doc,
        )
        self._add_file(
            folder / f"{name}.xabsl", print_file(tree.FileNode(body=[option], comments=_shifted(comments, first)))
        )

    def _folder(self, name: str) -> str:
        """The folder of a new option: that of its design, or else that of most options."""
        folder = self.after.folders.get(name, "")
        if folder:
            return folder
        counts = Counter(path.parent for path, _file, item in iter_items(self.old) if _is_option(item))
        main = self.old.main.parent
        found = counts.most_common(1)[0][0] if counts else main
        return posixpath.relpath(found.as_posix(), main.as_posix())

    def _add_file(self, path: Path, text: str) -> None:
        path = Path(posixpath.normpath(path.as_posix()))
        if path in self.files or path in self.added or path.exists():
            raise PatchError(f"{path} already exists; rename it or the design", path.stem)
        newline = self.files[self.old.main].newline
        self.added[path] = text.replace("\n", newline)

    # Declarations

    def _edit_declarations(self) -> None:
        olds, befores, afters = (declarations(source) for source in (self.old, self.before, self.after.source))
        places = {key: each.place for key, each in olds.items()}
        for key in afters:
            if key not in places:
                places[key] = _find_place(key, afters, places)
        for path, _file, namespace in iter_items(self.old):
            if not isinstance(namespace, tree.NamespaceNode):
                continue
            indices = {key: each.index for key, each in olds.items() if each.namespace is namespace}
            kept = {key: index for key, index in indices.items() if key in afters}
            added = [key for key in afters if key not in olds and places[key] == id(namespace)]
            if indices and not kept and not added:
                self.removed.append(path)
                continue
            known = {index: (befores[key].node, afters[key].node) for key, index in kept.items()}
            new = _arranged(list(afters), kept, added)
            nodes = [item if isinstance(item, int) else afters[item].node for item in new]
            edit_declarations(self.files[path], namespace, known, nodes)
        self._edit_namespaces()
        self._add_namespaces([key for key in afters if places[key] == id(afters[key].namespace)], afters)

    def _edit_namespaces(self) -> None:
        """Change titles and descriptions."""
        befores, afters = namespaces(self.before), namespaces(self.after.source)
        for path, _file, old in iter_items(self.old):
            name = old.name.text if isinstance(old, tree.NamespaceNode) else ""
            if not isinstance(old, tree.NamespaceNode) or name not in befores or name not in afters:
                continue
            file, was, now = self.files[path], befores[name], afters[name]
            edit_doc(file, old, was.doc, now.doc)
            if was.title != now.title:
                title = old.name.last_token + 2
                file.replace(file.start(title), file.end(title), f'"{now.title}"')

    def _add_namespaces(self, keys: Sequence[Key], afters: Mapping[Key, DeclaredItem]) -> None:
        folders = Counter(path.parent for path, _file, item in iter_items(self.old) if _is_namespace(item))
        folder = folders.most_common(1)[0][0] if folders else self.old.main.parent / "Symbols"
        for namespace in {id(afters[key].namespace): afters[key].namespace for key in keys}.values():
            mine = [afters[key].node for key in keys if afters[key].namespace is namespace]
            node = tree.NamespaceNode(namespace.name, namespace.title, mine, namespace.doc)
            self._add_file(folder / f"{namespace.name.text}.xabsl", print_file(tree.FileNode(body=[node])))

    # Includes

    def _edit_includes(self) -> None:
        for path in self.removed:
            if self.old.files[path].file.includes:
                raise PatchError(f"{path} includes other files: move its includes before the last of it is removed")
        host = {path: self._including_file(path) for path in self.added}
        for path, parsed in self.old.files.items():
            targets = [_target(path, include) for include in parsed.file.includes]
            for include, target in zip(parsed.file.includes, targets, strict=True):
                written = self._moved_include(path, include, target)
                if written != include.path:
                    string = include.first_token + 1
                    self.files[path].replace(
                        self.files[path].start(string), self.files[path].end(string), f'"{written}"'
                    )
            kept = [index for index, target in enumerate(targets) if target not in self.removed]
            rows: list[tuple[Match, str]] = [(index, "") for index in kept]
            for added in (added for added, including in host.items() if including == path):
                beside = [at for at, (index, _text) in enumerate(rows) if _is_beside(targets, index, added)]
                written = posixpath.relpath(added.as_posix(), path.parent.as_posix())
                rows.insert(beside[-1] + 1 if beside else len(rows), (None, f'include "{written}";'))
            if [index for index, _text in rows] != list(range(len(targets))):
                self._edit_include_list(path, parsed, rows)

    def _moved_include(self, path: Path, include: tree.IncludeNode, target: Path) -> str:
        """The path in an include after files moved."""
        host, new = self.moved.get(path, path), self.moved.get(target, target)
        if host.parent == path.parent and new.parent == target.parent:
            return include.path if new == target else include.path.removesuffix(target.name) + new.name
        return posixpath.relpath(new.as_posix(), host.parent.as_posix())

    def _edit_include_list(self, path: Path, parsed: ParsedFile, rows: Sequence[tuple[Match, str]]) -> None:
        includes, file = parsed.file.includes, self.files[path]
        if includes:
            style = ListStyle(opening=includes[0].first_token - 1, indent="")
            edit_list(file, includes, [index for index, _text in rows], [text for _index, text in rows], style)
        else:
            start = file.start_with_comments(parsed.file.body[0].first_token)
            file.insert(start, "".join(f"{text}\n" for _index, text in rows) + "\n")

    def _including_file(self, added: Path) -> Path:
        """The file that includes the others of a folder, or else the main file."""
        counts = Counter(
            path
            for path, parsed in self.old.files.items()
            for include in parsed.file.includes
            if _target(path, include).parent == added.parent
        )
        return counts.most_common(1)[0][0] if counts else self.old.main


def _moved_files(source: ProgramSource, renames: Renames, moves: Mapping[str, str]) -> dict[Path, Path]:
    """The new paths of files whose design moved, and of those that are named like a renamed option."""
    old_names = {new: key[1] for key, new in renames.items() if key[0] == "option"}
    folder = source.main.parent
    moved: dict[Path, Path] = {}
    for path, _file, item in iter_items(source):
        name = item.name.text if isinstance(item, tree.OptionNode) else ""
        new = path
        if name in moves:
            if not path.is_relative_to(folder):
                raise PatchError(f"{path} is not in the folder of {source.main.name}: move it yourself", name)
            new = Path(posixpath.normpath((folder / f"{moves[name]}{path.suffix}").as_posix()))
        if old_names.get(name) == path.stem and new.stem == path.stem:
            renamed = new.with_name(f"{name}{path.suffix}")
            new = new if renamed in source.files or renamed.exists() else renamed
        if new != path and (new in source.files or new.exists() or new in moved.values()):
            raise PatchError(f"{new} already exists; rename it or the design", name)
        if new != path:
            moved[path] = new
    return moved


def _check_overlaps(file: SourceEdits, option: str) -> None:
    """Raise the error of edits that exclude each other while the option is known.

    Raises:
        PatchError: Two edits overlap.
    """
    try:
        file.result()
    except PatchError as error:
        raise PatchError(str(error), option) from error


def _is_beside(targets: Sequence[Path], index: Match, added: Path) -> bool:
    return index is not None and targets[index].parent == added.parent


def _target(path: Path, include: tree.IncludeNode) -> Path:
    return (path.parent / include.path.replace("\\", "/")).resolve()


def _is_option(item: tree.SyntaxNode) -> bool:
    return isinstance(item, tree.OptionNode)


def _is_namespace(item: tree.SyntaxNode) -> bool:
    return isinstance(item, tree.NamespaceNode)


def _ordered(states: Sequence[tree.StateNode], names: Sequence[str]) -> tuple[tree.StateNode, ...]:
    places = {name: place for place, name in enumerate(names)}
    return tuple(sorted(states, key=lambda state: places.get(state.name.text, len(places))))


def _shifted(comments: Mapping[int, list[Comment]], first: int) -> dict[int, list[Comment]]:
    return {at - first: each for at, each in comments.items() if at > first}


def _find_place(key: Key, afters: Mapping[Key, DeclaredItem], places: Mapping[Key, int]) -> int:
    """The namespace of a new declaration: that of the declarations beside it, or else its own one."""
    namespace = afters[key].namespace
    beside = [other for other, each in afters.items() if each.namespace is namespace and other in places]
    near = [other for other in beside if other[0] == key[0]] or beside
    keys = list(afters)
    nearest = min(near, key=lambda other: abs(keys.index(other) - keys.index(key)), default=None)
    return places[nearest] if nearest is not None else id(namespace)


def _arranged(keys: Sequence[Key], kept: Mapping[Key, int], added: Sequence[Key]) -> list[int | Key]:
    """The remaining declarations of a namespace in their order, each added one after the one that precedes it."""
    arranged: list[int | Key] = list(kept.values())
    for key in added:
        before = [other for other in keys[: keys.index(key)] if other in kept or other in arranged]
        near = [other for other in before if other[0] == key[0]] or before
        last = near[-1] if near else None
        arranged.insert(0 if last is None else arranged.index(kept.get(last, last)) + 1, key)
    return arranged
