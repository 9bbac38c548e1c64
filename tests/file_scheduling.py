"""How pytest-xdist hands test files to its processes: also after one of them died."""

import os
from typing import Any

import pytest
from xdist.remote import Producer
from xdist.scheduler import LoadFileScheduling
from xdist.workermanage import WorkerController


class FileScheduling(LoadFileScheduling):
    """Whole files, as with `--dist loadfile`, and a second try for the test during which a process died.

    xdist 3.8 queues the finished files of a dead process again. A process that is given one of them has no test to
    report, so it gets no further file, and the run never ends. The same happens to a new process whose first file has
    one test: a process starts a test only when it knows the next one.
    """

    def __init__(self, config: pytest.Config, log: Producer | None = None) -> None:
        super().__init__(config, log)
        self._crashed: set[str] = set()

    def remove_node(self, node: WorkerController) -> str | None:
        """Take a process out; queue its unfinished files. Returns the test that failed by ending it, if any."""
        files = self.assigned_work[node]
        self.assigned_work[node] = {name: tests for name, tests in files.items() if not all(tests.values())}
        crashed = super().remove_node(node)
        if crashed is None or crashed in self._crashed or "VICODE_ONE_TRY" in os.environ:
            return crashed
        self._crashed.add(crashed)
        reporter: Any = self.config.pluginmanager.get_plugin("terminalreporter")
        reporter.write_line(f"\n{crashed} ended its process and is tried again")
        return None

    def _reschedule(self, node: WorkerController) -> None:
        super()._reschedule(node)
        while self.workqueue and not node.shutting_down and self._pending_of(self.assigned_work[node]) < 2:
            self._assign_work_unit(node)
        if not self.workqueue and not node.shutting_down and self._pending_of(self.assigned_work[node]) < 2:
            node.shutdown()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Producer) -> FileScheduling:
    return FileScheduling(config, log)
