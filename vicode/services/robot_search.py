"""Finds the addresses of robots that are connected over a network (docs/network.md)."""

import socket

from vicode.bica.errors import NetworkError
from vicode.bica.net_session import check_name, find_watched


def find_address(text: str) -> str:
    """The address of a robot that is given by its name; another text is returned as it is.

    Raises:
        OSError: There is no such robot or several, it is watched on its machine only, or there is no network.
    """
    if ":" in text or text.isdecimal():
        return text
    try:
        robots = find_watched() if check_name(text) else []
    except NetworkError as error:
        raise OSError(f"'{text}' is no address (PORT, HOST:PORT or unix:PATH), and by name: {error}") from error
    found = [(host, address) for robot, host, address in robots if robot == text]
    if len(found) != 1:
        names = ", ".join(sorted({robot for robot, _host, _address in robots}))
        remedy = f"the robots are {names}" if robots else "write PORT, HOST:PORT or unix:PATH"
        reason = f"{len(found)} robots have the name '{text}'; attach to an address" if found else ""
        raise OSError(reason or f"there is no robot '{text}'; {remedy}")
    host, address = found[0]
    if not is_reachable(host, address):
        port = address.rpartition(":")[2]
        raise OSError(f"{text} listens on {host} only: ssh -L {port}:{address} {host}, then attach to {port}")
    return address


def is_reachable(host: str, address: str) -> bool:
    """Whether an address is here, or one that other machines reach."""
    return host == socket.gethostname() or not address.startswith(("127.", "localhost:", "unix:"))
