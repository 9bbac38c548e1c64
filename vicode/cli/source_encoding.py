"""The option --encoding: the encoding of XABSL files that are not UTF-8."""

import argparse


def add_encoding_argument(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--encoding",
        metavar="NAME",
        type=_encoding,
        default="",
        help="encoding of XABSL files that are not UTF-8, such as gbk, shift_jis or koi8-r "
        "(default: xabsl_encoding in the project.yaml of their folder or one above it, else cp1252)",
    )


def _encoding(name: str) -> str:
    from vicode.xabsl.source_text import ENCODINGS, find_codec

    found = find_codec(name)
    if found is None and name:
        raise argparse.ArgumentTypeError(f"unknown encoding '{name}'; choose from {', '.join(ENCODINGS)}")
    return found or ""
