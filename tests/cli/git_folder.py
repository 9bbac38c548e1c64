"""Runs git in a folder, independent of the configuration of the user."""

import os
import subprocess
from pathlib import Path

ENVIRONMENT = {
    "GIT_CONFIG_GLOBAL": os.devnull,
    "GIT_CONFIG_NOSYSTEM": "1",
    "GIT_AUTHOR_NAME": "Ana",
    "GIT_AUTHOR_EMAIL": "ana@example.org",
    "GIT_COMMITTER_NAME": "Ana",
    "GIT_COMMITTER_EMAIL": "ana@example.org",
    # A driver of a merge is a new process, which has to find this package.
    "PYTHONPATH": str(Path(__file__).parents[2]),
}


def git(folder: Path, *arguments: str, check: bool = True) -> str:
    """The standard output of git."""
    command = ["git", "-C", str(folder), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **ENVIRONMENT}, check=False)
    assert not check or done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout


def init(folder: Path) -> None:
    git(folder, "init", "-q", "-b", "main")
    commit(folder, "begin")


def commit(folder: Path, subject: str) -> str:
    """Commit all changes; return the hash."""
    git(folder, "add", "--all")
    git(folder, "commit", "-q", "--allow-empty", "-m", subject)
    return git(folder, "rev-parse", "HEAD").strip()
