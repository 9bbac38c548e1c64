"""A robot that records itself until it is killed: `python recording_robot.py FILE`; prints what was flushed."""

import sys
import time
from types import SimpleNamespace

from tests.bica.sample_player import Player
from vicode.bica import Root

if __name__ == "__main__":
    root = Root(Player, world=SimpleNamespace(ball_seen=False, ball_distance=9.0, fallen=False, log=[]))
    recorder = root.record(sys.argv[1], minutes=0.02)
    while True:
        root.step()
        sys.stdout.write(f"{recorder.written}\n")
        sys.stdout.flush()
        time.sleep(0.0005)
