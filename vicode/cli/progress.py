"""A progress bar for builds."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from vicode.services.docs.builder import ProgressCallback


@contextmanager
def progress_bar() -> "Iterator[ProgressCallback]":
    """Yield a progress callback; without a terminal, it does nothing."""
    if not sys.stderr.isatty():
        yield lambda _name, _done, _all: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("Reading", total=None)

        def step(name: str, done: int, of: int) -> None:
            bar.update(task, description=name.replace("[", "\\["), completed=done, total=of or None)

        yield step
