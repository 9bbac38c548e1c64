"""`vicode sync --watch`: syncs after every change of a design or of generated code."""

import argparse
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from vicode.cli.gen import for_each_project
from vicode.services.file_changes import iter_changes
from vicode.services.generation.project_output import output_folder
from vicode.services.project_loader import DESIGN_SUFFIXES, XABSL_SUFFIXES, LoadedProject, load_projects


def watch_projects(args: argparse.Namespace, sync: Callable[[LoadedProject, argparse.Namespace], int]) -> int:
    """Sync until interrupted."""
    suffixes = (".py", ".cpp", ".hpp", *DESIGN_SUFFIXES, *XABSL_SUFFIXES)
    print("Watching; press Ctrl-C to stop.", flush=True)
    with suppress(KeyboardInterrupt):
        while True:
            for_each_project(args, sync)
            for _change in iter_changes(_folders(args), suffixes):
                for_each_project(args, sync)
    return 0


def _folders(args: argparse.Namespace) -> tuple[Path, ...]:
    projects = load_projects(args.paths)
    folders = [project.open_project.folder for project in projects]
    folders += [folder for project in projects if (folder := output_folder(project, args.out)).is_dir()]
    return tuple(folder.resolve() for folder in folders)
