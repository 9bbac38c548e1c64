"""A repository whose configuration names a program for each key that git documents.

The keys are those of `git help --config`, with names for their placeholders, and a few that it leaves out. A key is
dropped if git's own commands refuse a path as its value: then it is a number, a truth value or a choice. Each of the
others is the path of a script that leaves a file with the name of its key.
"""

import os
import re
import stat
import subprocess
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.cli.git_folder import ENVIRONMENT, commit, git, init

# `filter.<driver>.process` is documented with the attributes only.
OTHER_KEYS = (
    "filter.x.process",
    "gpg.ssh.program",
    "gpg.openpgp.program",
    "diff.x.command",
    "uploadpack.packObjectsHook",
)
PLACEHOLDERS = {"<cmd>": ("diff", "log", "ls-tree", "show", "status"), "<command>": ("amend",)}
# They say where files are or how they are stored.
LOCATIONS = re.compile(
    r"core\.(worktree|hookspath|bare|repositoryformatversion)|extensions\..*|include(if)?\..*", re.IGNORECASE
)
# All of them are truth values and colors.
PLAIN_SECTIONS = ("advice.", "color.")
ENABLING = {
    "commit.gpgSign": "true",
    "core.repositoryFormatVersion": "1",
    "diff.external.trustExitCode": "true",
    "extensions.partialClone": "x",
    "extensions.worktreeConfig": "true",
    "log.showSignature": "true",
    "remote.x.promisor": "true",
    "remote.x.url": "ssh://example.invalid/x",
    "submodule.recurse": "true",
    "status.submoduleSummary": "true",
    "tag.gpgSign": "true",
}
READING = (
    ("status",),
    ("diff",),
    ("log", "-p", "-1"),
    ("config", "--list"),
    ("show", "HEAD"),
    ("diff", "HEAD", "--stat"),
)
OTHERS = (("fetch", "x"), ("commit", "--allow-empty", "-m", "x"))
HOOKS = ("pre-commit", "post-index-change", "reference-transaction", "fsmonitor-watchman", "post-checkout")
HOOKS += ("commit-msg", "post-commit", "prepare-commit-msg", "post-merge", "pre-merge-commit", "post-rewrite")
SIGNER = '#!/bin/sh\ncat >/dev/null\necho "[GNUPG:] SIG_CREATED " >&2\necho "-----BEGIN PGP SIGNATURE-----"\n'


@dataclass(frozen=True, slots=True, kw_only=True)
class HostileRepository:
    """A repository, and the folder in which its programs leave files.

    Attributes:
        root: The work tree; it contains the project `lamps`, which differs from the last commit.
        witnesses: A file for each program that ran.
        missing: A commit whose `lamps/lamp.yaml` is not in the repository.
        keys: The keys of programs.
    """

    root: Path
    witnesses: Path
    missing: str
    keys: tuple[str, ...]

    def take_witnesses(self) -> set[str]:
        """The names of the programs that ran since the last call."""
        found = {file.name for file in self.witnesses.iterdir()}
        for name in found:
            (self.witnesses / name).unlink()
        return found


def documented_keys() -> list[str]:
    listed = [line for line in git(Path(), "help", "--config").splitlines() if re.fullmatch(r"\w+\.\S+", line)]
    assert len(listed) > 500
    keys = [*OTHER_KEYS]
    for key in listed:
        placeholder = next((each for each in PLACEHOLDERS if each in key), "")
        names = PLACEHOLDERS.get(placeholder, ("",))
        named = [key.replace(placeholder, name) if placeholder else key for name in names]
        keys += [re.sub(r"<[^>]*>|\*", "x", each) for each in named]
    return list(dict.fromkeys(key for key in keys if not LOCATIONS.fullmatch(key) and "_" not in key))


def make_hostile(root: Path, programs: Path, place: str, omitted: Sequence[str] = ()) -> HostileRepository:
    """Make the repository of a folder hostile.

    Args:
        root: A work tree without repository.
        programs: A folder for the programs and their witnesses.
        place: What contains the configuration: `config`, `include` (a file that it includes) or `worktree`.
        omitted: Keys that are not set, so that git runs the programs of others instead.
    """
    witnesses = programs / "witnesses"
    witnesses.mkdir(parents=True)
    signer = _write_script(programs / "signer", SIGNER)
    (root / ".gitattributes").write_text("* filter=x diff=x merge=x\n", encoding="utf-8")
    init(root)
    lamp = root / "lamps" / "lamp.yaml"
    text = lamp.read_text(encoding="utf-8")
    lamp.write_text(text.replace("after: 0.2", "after: 0.3"), encoding="utf-8")
    missing = commit(root, "missing")
    blob = git(root, "rev-parse", "HEAD:lamps/lamp.yaml").strip()
    lamp.write_text(text.replace("after: 0.2", "after: 0.4"), encoding="utf-8")
    git(root, "add", "--all")
    git(root, "-c", f"gpg.program={signer}", "commit", "-q", "-S", "-m", "signed")
    module = root / "lamps" / "module"
    module.mkdir()
    init(module)
    commit(root, "with a module")
    lamp.write_text(text, encoding="utf-8")
    (root / ".git" / "objects" / blob[:2] / blob[2:]).unlink()
    keys = tuple(key for key in program_keys() if key not in omitted)
    settings = {key: str(_write_witness(programs, key)) for key in keys}
    for folder in (root / ".git", module / ".git"):
        hooks = folder / "hooks" if place == "config" else programs / "hooks"
        _configure(folder, {**settings, **ENABLING, "core.hooksPath": str(hooks)}, place)
        for hook in HOOKS:
            _write_witness(programs, f"hook {hook}", hooks / hook)
    return HostileRepository(root=root, witnesses=witnesses, missing=missing, keys=keys)


def _configure(folder: Path, settings: dict[str, str], place: str) -> None:
    file = folder / {"config": "config", "include": "more", "worktree": "config.worktree"}[place]
    with file.open("a", encoding="utf-8") as config:
        config.write(_as_text(settings))
    if place != "config":
        with (folder / "config").open("a", encoding="utf-8") as config:
            config.write(_as_text({**ENABLING, **({"include.path": "more"} if place == "include" else {})}))


def _as_text(settings: dict[str, str]) -> str:
    parts = []
    for key, value in settings.items():
        section, _dot, rest = key.partition(".")
        name, _dot, variable = rest.rpartition(".")
        parts.append(f'[{section} "{name}"]\n' if name else f"[{section}]\n")
        parts.append(f'\t{variable} = "{value}"\n')
    return "".join(parts)


@cache
def program_keys() -> tuple[str, ...]:
    """The documented keys that may have a path as their value."""
    keys = [key for key in documented_keys() if not key.startswith(PLAIN_SECTIONS)]
    with TemporaryDirectory() as name:
        (Path(name) / "root").mkdir()
        init(Path(name) / "root")
        while refused := _refused(Path(name) / "root", keys):
            keys.remove(refused)
    return tuple(keys)


def _refused(root: Path, keys: list[str]) -> str | None:
    """A key whose value git refuses; its message contains the value."""
    paths = {key: str(_write_script(root.parent / "programs" / key, "#!/bin/sh\nexit 1\n")) for key in keys}
    settings = root.parent / "settings"
    settings.write_text(_as_text(paths), encoding="utf-8")
    for arguments in (*READING, *OTHERS):
        command = ["git", "-C", str(root), "-c", f"include.path={settings}", "--no-pager", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **ENVIRONMENT}, check=False)
        found = [key for key, path in paths.items() if path in done.stderr or key.lower() in done.stderr.lower()]
        if done.returncode and found:
            return max(found, key=len)
        assert not done.returncode or arguments in OTHERS, f"{command}: {done.stderr}"
    return None


def _write_witness(programs: Path, name: str, file: Path | None = None) -> Path:
    script = f"#!/bin/sh\n: > '{programs}/witnesses/{name.replace('/', '_')}'\nexit 1\n"
    return _write_script(file or programs / name.replace("/", "_"), script)


def _write_script(file: Path, text: str) -> Path:
    if file.exists():
        return file
    file.parent.mkdir(exist_ok=True)
    file.write_text(text, encoding="utf-8")
    file.chmod(file.stat().st_mode | stat.S_IXUSR)
    return file


def run_plain_git(root: Path, commands: Iterable[tuple[str, ...]]) -> None:
    for arguments in commands:
        git(root, *arguments, check=False)
