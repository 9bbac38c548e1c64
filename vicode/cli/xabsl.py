"""Check, compile, run and format XABSL behaviors."""

import argparse
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli import xabsl_diff, xabsl_update
from vicode.cli.console import add_format_arguments, describe_os_error, print_findings, print_formatted
from vicode.cli.source_encoding import add_encoding_argument
from vicode.cli.xabsl_behavior import print_behavior_findings
from vicode.findings import count_findings
from vicode.services.display_paths import with_display_paths
from vicode.services.xabsl_encoding import find_encoding

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from vicode.xabsl.compiler import CompileResult

_STRICT_CODES = {"X651", "X652"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the commands of `vicode xabsl`."""
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, add, act in (
        ("check", _add_check, _check),
        ("compile", _add_compile, _compile),
        ("run", _add_run, _run),
        ("format", _add_format, _format),
        ("update", xabsl_update.add_arguments, _update),
        ("diff", xabsl_diff.add_arguments, _diff),
        ("lsp", _add_lsp, _lsp),
    ):
        summary = (act.__doc__ or "").split("\n")[0]
        command = commands.add_parser(name, help=summary, description=summary)
        add(command)
        command.set_defaults(act=act)


def run(args: argparse.Namespace) -> int:
    act: Callable[[argparse.Namespace], int] = args.act
    return act(args)


def _add_check(parser: argparse.ArgumentParser) -> None:
    _add_behavior(parser)
    add_format_arguments(parser)
    parser.add_argument(
        "--deep",
        action="store_true",
        help="also report decisions that are never taken, states that alternate, and more",
    )


def _add_behavior(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("agents", metavar="AGENTS.xabsl", type=Path, help="XABSL file with the agents")
    parser.add_argument(
        "--strict", action="store_true", help="reject constructs that the original compiler or its engines cannot read"
    )
    add_encoding_argument(parser)


def _check(args: argparse.Namespace) -> int:
    """Check an XABSL behavior and report all problems at once."""
    from vicode.xabsl.behavior_loader import load_behavior
    from vicode.xabsl.compiler import compile_source

    encoding = find_encoding(args.agents, args.encoding)
    source = load_behavior(args.agents, encoding)
    compiled = compile_source(source)
    findings = compiled.findings
    if args.deep:
        from vicode.services.imported_behavior.behavior_check import find_in_behavior

        findings = (*findings, *find_in_behavior(source, compiled))
    if not print_formatted(with_display_paths(findings, args.agents), args):
        print_behavior_findings(findings, args.agents, encoding, to_stderr=False)
        print(count_findings(findings))
    return _exit_code(compiled, strict=args.strict)


def _add_compile(parser: argparse.ArgumentParser) -> None:
    _add_behavior(parser)
    parser.add_argument("--output", "-o", metavar="FILE", type=Path, help="write the intermediate code to FILE")
    parser.add_argument("--symbols", metavar="FILE", type=Path, help="write the list of all symbols to FILE")


def _compile(args: argparse.Namespace) -> int:
    """Compile a behavior to the intermediate code of the original compiler."""
    from vicode.findings import Severity
    from vicode.output import write_atomically
    from vicode.xabsl.behavior_loader import compile_behavior
    from vicode.xabsl.compiler import declared_symbols
    from vicode.xabsl.engine.code_writer import write_code
    from vicode.xabsl.engine.symbols import write_symbols

    encoding = find_encoding(args.agents, args.encoding)
    compiled = compile_behavior(args.agents, encoding)
    # Only `check` prints notes: here they would hide errors and warnings.
    print_behavior_findings(
        [finding for finding in compiled.findings if args.strict or finding.severity is not Severity.NOTE],
        args.agents,
        encoding,
    )
    code = _exit_code(compiled, strict=args.strict)
    if code or compiled.program is None:
        print(f"nothing written: {count_findings(compiled.findings)}", file=sys.stderr)
        return code
    text = write_code(compiled.program)
    if args.output is None:
        print(text, end="")
    else:
        write_atomically(args.output, text)
    if args.symbols is not None:
        write_atomically(args.symbols, write_symbols(declared_symbols(compiled.table)))
    return 0


def _add_run(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("code", metavar="CODE", type=Path, help="intermediate code")
    parser.add_argument("--symbols", metavar="FILE", type=Path, required=True, help="the list of all symbols")
    parser.add_argument("--inputs", metavar="CSV", type=Path, required=True, help="inputs, one row per cycle")
    parser.add_argument("--trace", metavar="JSONL", type=Path, help="write the trace to JSONL (docs/traces.md)")
    parser.add_argument(
        "--strict", action="store_true", help="apply the rules of the second version of the original engine"
    )
    parser.add_argument(
        "--team",
        metavar="N",
        type=options.count,
        default=0,
        help="run N robots; prefix columns with the number of the robot, such as 0:",
    )
    parser.add_argument("--ticks", metavar="T", type=int, default=0, help="with --team: cycles to wait for answers")
    parser.add_argument(
        "--bench",
        metavar="N",
        type=options.count,
        default=0,
        help="run all inputs N times and print the cycles per second",
    )


def _run(args: argparse.Namespace) -> int:
    """Run a compiled XABSL behavior on recorded inputs."""
    from vicode.output import write_atomically
    from vicode.xabsl.engine import CodeError, LoadError, ReplayError, SymbolListError
    from vicode.xabsl.engine.code_reader import read_code
    from vicode.xabsl.engine.replay import measure_cycles_per_second, read_rows, replay, replay_team
    from vicode.xabsl.engine.symbols import read_symbols

    file = args.code
    try:
        program = read_code(_read_lines(args.code))
        file = args.symbols
        symbols = read_symbols(_read_lines(args.symbols))
        file = args.inputs
        rows = read_rows(_read_lines(args.inputs).splitlines())
        if args.bench:
            cycles_per_second = measure_cycles_per_second(program, symbols, rows, args.bench, strict=args.strict)
            print(f"{cycles_per_second:.0f} cycles per second of CPU time")
            return 0
        if args.team:
            lines = replay_team(program, symbols, rows, args.team, args.ticks, strict=args.strict)
        else:
            lines = replay(program, symbols, rows, strict=args.strict)
        text = "".join(f"{line}\n" for line in lines)
    except LoadError as error:
        for problem in error.problems:
            print(f"{args.code}: {problem}", file=sys.stderr)
        return 1
    except (CodeError, SymbolListError, ReplayError) as error:
        print(f"{file}: {error}", file=sys.stderr)
        return 1
    if args.trace is None:
        print(text, end="")
    else:
        write_atomically(args.trace, text)
    return 0


def _read_lines(path: Path) -> str:
    """The text of a compiled file; its first comment is the title of the behavior, in the encoding of the behavior."""
    from vicode.xabsl.lexer import plain_line_ends
    from vicode.xabsl.source_text import read_source

    return plain_line_ends(read_source(path).text)


def _add_format(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("paths", metavar="PATH", nargs="+", type=Path, help="a file or a folder")
    parser.add_argument("--check", action="store_true", help="write nothing; list the files that would change")
    add_encoding_argument(parser)


def _format(args: argparse.Namespace) -> int:
    """Format XABSL files; comments and encodings are kept."""
    code = 0
    for path in _files(args.paths):
        try:
            code = max(code, _format_file(path, find_encoding(path, args.encoding), is_check=args.check))
        except OSError as error:
            print(f"vicode: {describe_os_error(error)}", file=sys.stderr)
            code = 2
    return code


def _format_file(path: Path, encoding: str, *, is_check: bool) -> int:
    """Format a file; return 1 if it has errors or, with `is_check`, would change."""
    from vicode.findings import Severity
    from vicode.output import write_atomically
    from vicode.xabsl.source_loader import format_file
    from vicode.xabsl.source_text import SourceEncodingError, encode_source, read_source

    result = format_file(path, partial(read_source, encoding=encoding))
    print_findings(result.findings, to_stderr=True, encoding=encoding)
    if any(finding.severity is Severity.ERROR for finding in result.findings):
        print(f"{path}: not formatted because of errors", file=sys.stderr)
        return 1
    if result.formatted == result.original.text:
        return 0
    if not is_check:
        try:
            content = encode_source(result.formatted, result.original.encoding, path.read_bytes())
        except SourceEncodingError as error:
            print(f"{path}: not formatted: it {error}", file=sys.stderr)
            return 1
        write_atomically(path, content)
    print(f"{path}: {'would change' if is_check else 'formatted'}")
    return int(is_check)


def _update(args: argparse.Namespace) -> int:
    """Write the edits of imported designs back to the files of the behavior; everything else stays as it is."""
    return xabsl_update.run(args)


def _diff(args: argparse.Namespace) -> int:
    """Run two versions of a behavior on the same inputs and show the first difference."""
    return xabsl_diff.run(args)


def _add_lsp(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--grammar", action="store_true", help="print a TextMate grammar for VS Code and other editors instead"
    )
    add_encoding_argument(parser)


def _lsp(args: argparse.Namespace) -> int:
    """Run a language server on standard input and output."""
    if args.grammar:
        from vicode.xabsl.server.grammar import grammar_text

        print(grammar_text(), end="")
        return 0
    from vicode.xabsl.server.server import create_server

    create_server(lambda path: find_encoding(path, args.encoding)).start_io()
    return 0


def _files(paths: "Iterable[Path]") -> "list[Path]":
    files: list[Path] = []
    for path in paths:
        files += sorted(path.rglob("*.xabsl")) if path.is_dir() else [path]
    return files


def _exit_code(compiled: "CompileResult", *, strict: bool) -> int:
    is_rejected = strict and any(finding.rule.code in _STRICT_CODES for finding in compiled.findings)
    return int(compiled.program is None or is_rejected)
