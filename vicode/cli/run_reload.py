"""`vicode run --reload`: generates again after each change, and asks the running process to exchange its code."""

import argparse
import sys
import threading
from pathlib import Path

from vicode.bica.reload import STAMP
from vicode.cli.console import describe_os_error, print_findings
from vicode.services.file_changes import iter_changes
from vicode.services.project_loader import DESIGN_SUFFIXES, load_projects
from vicode.services.root_component import find_root_component
from vicode.services.run_preparation import generate_for_run


def start_watching(args: argparse.Namespace, folder: Path) -> None:
    """Watch the project in a thread that ends with the process; `folder` has the generated code."""
    threading.Thread(target=_watch, args=(args, folder), daemon=True).start()


def _watch(args: argparse.Namespace, folder: Path) -> None:
    (opened,) = load_projects([args.path], args.profile)
    project_folder = opened.open_project.folder.resolve()
    while project_folder.is_dir():
        changes = iter_changes([project_folder], (".py", *DESIGN_SUFFIXES))
        # The first is no change.
        next(changes, None)
        for _change in changes:
            try:
                _generate_again(args, folder)
            except OSError as error:
                print(f"vicode: {describe_os_error(error)}", file=sys.stderr)


def _generate_again(args: argparse.Namespace, folder: Path) -> None:
    (opened,) = load_projects([args.path], args.profile)
    component = find_root_component(opened)
    errors = opened.errors_for("python")
    if errors or component is None:
        print_findings(errors, to_stderr=True)
        print("vicode: not reloaded; the old code keeps running", file=sys.stderr)
        return
    generate_for_run(opened.open_project, component, folder)
    (folder / "python" / STAMP).touch()
