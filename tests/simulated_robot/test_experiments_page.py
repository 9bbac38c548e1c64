"""docs/experiments.md: its map is valid, and it lists all experiments, maps and options."""

import argparse
import re
from pathlib import Path

import pytest

from vicode.cli import experiment, sim
from vicode.experiments.definitions import EXPERIMENTS
from vicode.simulated_robot.map_file import map_names, read_world_map

PAGE = (Path(__file__).parents[2] / "docs/experiments.md").read_text(encoding="utf-8")


def test_the_map_is_valid() -> None:
    (text,) = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
    result = read_world_map(text)
    assert result.world_map is not None, result.findings
    assert len(result.world_map.starts) == 2


def test_experiments_and_maps_are_listed() -> None:
    assert [name for name in (*EXPERIMENTS, *map_names()) if f"`{name}`" not in PAGE] == []


@pytest.mark.parametrize("command", [experiment, sim])
def test_options_are_listed(command) -> None:
    parser = argparse.ArgumentParser(add_help=False)
    command.add_arguments(parser)
    names = [name for action in parser._actions for name in action.option_strings]
    assert [name for name in names if f"`{name}" not in PAGE] == []


def test_the_names_in_the_help_are_those_that_exist() -> None:
    parser = argparse.ArgumentParser(add_help=False)
    experiment.add_arguments(parser)
    sim.add_arguments(parser)
    names, maps = (action for action in parser._actions if not action.option_strings)
    assert tuple(names.choices) == tuple(EXPERIMENTS)
    assert ", ".join(map_names()) in maps.help
