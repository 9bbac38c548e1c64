"""Entry point of the command line: parses arguments, runs the command, returns the exit code."""

import argparse
import codecs
import errno
import gc
import io
import os
import sys
from collections.abc import Sequence
from importlib import import_module

from vicode import __version__
from vicode.cli.console import describe_os_error

COMMANDS = (
    "edit",
    "attach",
    "gen",
    "sync",
    "check",
    "conform",
    "test",
    "docs",
    "run",
    "bridge",
    "sim",
    "experiment",
    "sweep",
    "tournament",
    "deploy",
    "replay",
    "trace",
    "diff",
    "merge",
    "hook",
    "rename",
    "show",
    "sample",
    "export",
    "import",
    "schema",
    "mcp",
    "xabsl",
)
_BATCH_COMMANDS = ("gen", "sync", "check")
EXIT_OK, EXIT_FINDINGS, EXIT_FAILED, EXIT_OUTPUT_LOST, EXIT_INTERRUPTED, EXIT_PIPE_CLOSED = 0, 1, 2, 3, 130, 141
_FULL_DISK = frozenset((errno.ENOSPC, errno.EDQUOT, errno.EFBIG))
_RECURSION_LIMIT = 10_000
_ASCII = {"→": "->", "…": "...", "×": "x", "–": "-", "·": "-"}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code."""
    _make_streams_lenient()
    words = sys.argv[1:] if arguments is None else arguments
    if arguments is None:
        # Decisions and expressions are read and written recursively; their depth is limited where they are read.
        sys.setrecursionlimit(max(_RECURSION_LIMIT, sys.getrecursionlimit()))
    if not words:
        make_command_parser().print_help(sys.stderr)
        return EXIT_FAILED
    if words[0] not in COMMANDS and not words[0].startswith("-"):
        return _report_unknown_command(words[0])
    # A command is parsed without the modules of the others, which are slow to import.
    parsed = make_command_parser(words[:1] if words[0] in COMMANDS else COMMANDS).parse_args(words)
    if arguments is None and words[0] in _BATCH_COMMANDS:
        # The process ends after one pass over the designs; collections would only scan the live trees repeatedly.
        gc.disable()
    try:
        code: int = parsed.run(parsed)
        # The language server closes stdout itself.
        if not sys.stdout.closed:
            sys.stdout.flush()
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED
    except BrokenPipeError:
        # The reader closed the pipe.
        _discard_output()
        return EXIT_PIPE_CLOSED
    except OSError as error:
        print(f"vicode: {describe_os_error(error)}", file=sys.stderr)
        if error.errno in _FULL_DISK:
            _discard_output()
            return EXIT_OUTPUT_LOST
        return EXIT_FAILED
    return code


def _discard_output() -> None:
    """Keep the final flush of the interpreter from failing, too."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _report_unknown_command(name: str) -> int:
    from vicode.findings.nearest import did_you_mean

    fix = did_you_mean(name, COMMANDS, "'vicode --help' lists all commands")
    print(f"vicode: there is no command '{name}'; {fix}", file=sys.stderr)
    return EXIT_FAILED


def _make_streams_lenient() -> None:
    """Replace closed streams by the null device, and characters that their encoding does not have."""
    if None in (sys.stdin, sys.stdout, sys.stderr):
        from vicode.bica.run import open_missing_streams

        open_missing_streams()
    codecs.register_error("vicode", _replace_unencodable)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper) and stream.errors == "strict":
            stream.reconfigure(errors="vicode")


def _replace_unencodable(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    text = error.object[error.start : error.end]
    return "".join(_ASCII.get(char) or char.encode("ascii", "backslashreplace").decode() for char in text), error.end


def make_command_parser(names: Sequence[str] = COMMANDS) -> argparse.ArgumentParser:
    """Make the parser of some commands; the modules of the others are not imported."""
    parser = argparse.ArgumentParser(
        prog="vicode",
        description="Edit, check, and run state machines for robots, and generate code from them.",
        epilog="Exit codes: 0 success, 1 findings or outdated files, 2 the command could not run, "
        "3 an output could not be written, 141 the output was closed, as by head.",
    )
    parser.add_argument("--version", action="version", version=f"vicode {__version__}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name in names:
        module = import_module("vicode.cli." + {"import": "import_command"}.get(name, name))
        summary = (module.__doc__ or "").strip().split("\n")[0]
        command = commands.add_parser(name, help=summary, description=summary)
        module.add_arguments(command)
        command.set_defaults(run=module.run)
    return parser
