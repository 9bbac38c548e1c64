"""The ports of the command line."""

import argparse


def port_number(text: str) -> int:
    """Parse the port of a server; 0 is any free port.

    Raises:
        argparse.ArgumentTypeError: There is no such port.
    """
    if not text.isdecimal() or int(text) >= 2**16:
        raise argparse.ArgumentTypeError(f"{text} is not a port; use a number from 0 to 65535")
    return int(text)
