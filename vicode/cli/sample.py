"""Copy a sample project to a new folder."""

import argparse
from pathlib import Path

from vicode.samples import DEFAULT_SAMPLE, copy_sample, sample_names


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "folder", metavar="DIR", nargs="?", help="new or empty folder (default: the name of the sample)"
    )
    parser.add_argument(
        "--name", choices=sample_names(), default=DEFAULT_SAMPLE, help="sample to copy (default: %(default)s)"
    )


def run(args: argparse.Namespace) -> int:
    folder = Path(args.folder or args.name)
    copy_sample(args.name, folder)
    print(f"Copied the sample '{args.name}' to {folder.as_posix()}. Open it with: vicode edit {folder.as_posix()}")
    return 0
