"""Python's parser in several threads at once: the editor checks while it generates."""

import gc
import sys
import time
from concurrent.futures import ThreadPoolExecutor

from vicode.model.parsing import parse_module

SOURCE = "def f(x):\n" + "    if x and (1 + (2 + (3 + (4 + x)))):\n        return [g(y, [y]) for y in x]\n" * 60


def pause(_phase: str, _info: dict[str, int]) -> None:
    time.sleep(0)


def test_threads_do_not_disturb_each_other() -> None:
    interval, thresholds = sys.getswitchinterval(), gc.get_threshold()
    sys.setswitchinterval(1e-6)
    gc.set_threshold(50)
    # Whatever Python code runs while garbage is collected, in the middle of a tree, lets another thread on.
    gc.callbacks.append(pause)
    try:
        with ThreadPoolExecutor(4) as threads:
            trees = list(threads.map(parse_module, [SOURCE] * 40))
    finally:
        gc.callbacks.remove(pause)
        sys.setswitchinterval(interval)
        gc.set_threshold(*thresholds)
    assert all(len(tree.body) == 1 for tree in trees)
