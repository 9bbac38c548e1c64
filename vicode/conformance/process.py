"""Compares the languages of an open design in another process: this package, in the sandbox of simulations."""

import asyncio
import base64
import json
import pickle
import shutil
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

import vicode.conformance
from vicode.conformance.result import LANGUAGE_TITLES, LanguageComparison
from vicode.decoding import MalformedEventError, decode
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.runs.process import ProcessTransport, launch_module
from vicode.simulation.isolation import make_temporary

ITERATIONS = 500
LIMIT_S = 300.0


class ComparisonError(Exception):
    """The comparison failed; the message says why."""


@dataclass(eq=False, kw_only=True)
class ComparisonProcess:
    """One comparison with chosen inputs, of the project with the unsaved edits of its designs.

    Attributes:
        folder: The folder of the project.
        seed: The seed of the inputs.
        on_language: Is called before a language runs.
    """

    project: Project
    design: Design
    folder: Path
    seed: int = 0
    on_language: Callable[[str], None] = lambda _language: None
    limit_s: float = LIMIT_S
    _transport: ProcessTransport | None = field(init=False, default=None)
    _is_cancelled: bool = field(init=False, default=False)

    async def run(self) -> LanguageComparison:
        """Run all languages; do not call it twice.

        Raises:
            ComparisonError: It failed, took too long, or was cancelled.
        """
        running = ""
        whole = make_temporary()
        files = str(whole / "files")
        try:
            self._transport = await launch_module(
                vicode.conformance.__name__, whole, (), self.folder, TMPDIR=files, CCACHE_DISABLE="1"
            )
            if self._is_cancelled:
                raise ComparisonError("cancelled")
            async with asyncio.timeout(self.limit_s):
                await self._transport.send(self._encode_request(files))
                # The code of a design shares the sandbox with the process: more lines are not from vicode.
                for _line in range(len(LANGUAGE_TITLES) + 1):
                    answer = _read_object(await self._transport.receive())
                    if "result" in answer:
                        return decode(answer["result"], LanguageComparison, "result")
                    running = LANGUAGE_TITLES.get(str(answer.get("language")), running)
                    if not self._is_cancelled:
                        self.on_language(str(answer.get("language")))
            raise ComparisonError("the process gave no result")
        except TimeoutError:
            raise ComparisonError(f"{running or 'the process'} took longer than {self.limit_s:g} s") from None
        except (OSError, ValueError, RecursionError) as error:
            raise ComparisonError(await self._explain(error)) from error
        finally:
            await self._end(whole)

    def cancel(self) -> None:
        """End the process with everything that it started."""
        self._is_cancelled = True
        if self._transport is not None:
            self._transport.close()

    def _encode_request(self, folder: str) -> bytes:
        designs = (self.design if each.component == self.design.component else each for each in self.project.designs)
        request = {
            "project": replace(self.project, designs=tuple(designs)),
            "root": self.design.component,
            "seed": self.seed,
            "iterations": ITERATIONS,
            "folder": folder,
            "modules": str(self.folder.resolve()),
        }
        return base64.b64encode(pickle.dumps(request)) + b"\n"

    async def _explain(self, error: Exception) -> str:
        if self._is_cancelled:
            return "cancelled"
        if self._transport is None:
            return str(error)
        words, tail = await self._transport.explain_end()
        return "\n".join((words, *tail))

    async def _end(self, whole: Path) -> None:
        if self._transport is None:
            shutil.rmtree(whole, ignore_errors=True)
        else:
            self._transport.close()
            await self._transport.wait_closed()


def _read_object(line: bytes) -> dict[str, object]:
    answer = json.loads(line)
    if not isinstance(answer, dict):
        raise MalformedEventError("an answer must be an object")
    return answer
