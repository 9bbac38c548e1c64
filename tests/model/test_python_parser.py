"""Concurrent use of the Python parser."""

import ast
import gc
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest

from vicode.model.python_parser import parse_module, serialize_calls

SOURCE = "def f(x):\n" + "    if x and (1 + (2 + (3 + (4 + x)))):\n        return [g(y, [y]) for y in x]\n" * 60


def pause(_phase: str, _info: dict[str, int]) -> None:
    time.sleep(0)


@pytest.fixture(autouse=True)
def restless_threads() -> Iterator[None]:
    """Whatever Python code runs while garbage is collected, in the middle of a tree, lets another thread on."""
    interval, thresholds = sys.getswitchinterval(), gc.get_threshold()
    sys.setswitchinterval(1e-6)
    # What other tests left is not collected again and again.
    gc.freeze()
    gc.set_threshold(50)
    gc.callbacks.append(pause)
    yield
    gc.callbacks.remove(pause)
    sys.setswitchinterval(interval)
    gc.set_threshold(*thresholds)
    gc.unfreeze()


def test_threads_parse_concurrently() -> None:
    with ThreadPoolExecutor(4) as threads:
        trees = list(threads.map(parse_module, [SOURCE] * 40))
    assert all(len(tree.body) == 1 for tree in trees)


def test_literal_parsing_uses_the_parser_lock() -> None:
    read = serialize_calls(ast.literal_eval)
    with ThreadPoolExecutor(4) as threads:
        trees = [threads.submit(parse_module, SOURCE) for _ in range(40)]
        values = [read(f"[{number}, ['a', 'b']]") for number in range(4000)]
    assert all(len(tree.result().body) == 1 for tree in trees)
    assert values[-1] == [3999, ["a", "b"]]
