"""Reads maps of simulated worlds from YAML."""

from dataclasses import dataclass
from pathlib import PurePath
from typing import cast

from vicode.findings import Finding, sort_findings
from vicode.simulated_robot.world_map import MAPS_FOLDER, Circle, StartPose, WorldMap
from vicode.store.codec import decode_record
from vicode.store.documents import read_record
from vicode.store.format_values import DOC_KEY, FLOW_WIDTH, NAME, VERSION_KEY
from vicode.store.schema_types import KeySchema, ListSchema, PairSchema, RecordSchema, ScalarSchema, ScalarType

_POINT = PairSchema(description="a point [x, y] in m")
_LENGTH = ScalarSchema(scalar_type=ScalarType.NUMBER)
_WALL = ListSchema(description="a list of points", item_schema=lambda: _POINT, flow_width=FLOW_WIDTH)
_CIRCLE = RecordSchema(
    name="circle",
    description="a circle {at: [x, y], radius: r}",
    model=Circle,
    keys=(
        KeySchema("at", _POINT, "center", required=True),
        KeySchema("radius", _LENGTH, "radius in m", required=True),
    ),
)
_START = RecordSchema(
    name="start",
    description="a start pose {at: [x, y], towards: [x, y]}",
    model=StartPose,
    keys=(
        KeySchema("at", _POINT, "position of the robot", required=True),
        KeySchema("towards", _POINT, "point that the robot faces", required=True),
        KeySchema("spread", _LENGTH, "how far off x and y are, at most; drawn from the seed"),
    ),
)
_MAP = RecordSchema(
    name="map",
    description="a map",
    model=WorldMap,
    synonyms={"name": "map", "description": "doc"},
    keys=(
        VERSION_KEY,
        KeySchema("map", NAME, "name; default: the name of the file", field="name"),
        DOC_KEY,
        KeySchema("walls", ListSchema(description="a list of walls", item_schema=lambda: _WALL), "polylines"),
        KeySchema("circles", ListSchema(description="a list of circles", item_schema=lambda: _CIRCLE), "round walls"),
        KeySchema("starts", ListSchema(description="a list of poses", item_schema=lambda: _START), "one per robot"),
        KeySchema("goals", ListSchema(description="a list of circles", item_schema=lambda: _CIRCLE), "where to arrive"),
    ),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class MapReadResult:
    """The map of a file, None if it has errors, and all findings."""

    world_map: WorldMap | None
    findings: tuple[Finding, ...]


def read_world_map(text: str | bytes, file: str = "map.yaml") -> MapReadResult:
    """Read a map and report all errors."""
    report, root = read_record(text, file, _MAP)
    findings = sort_findings(report.findings)
    if root is None or root.value is None or findings:
        return MapReadResult(world_map=None, findings=findings)
    found = cast("WorldMap", decode_record(_MAP, root.value, {"name": PurePath(file).stem}))
    return MapReadResult(world_map=found, findings=findings)


def load_world_map(name: str) -> WorldMap:
    """Load a map that is part of vicode.

    Raises:
        KeyError: There is no map with this name.
    """
    path = MAPS_FOLDER / f"{name}.yaml"
    if name not in map_names():
        raise KeyError(name)
    found = read_world_map(path.read_bytes(), path.name).world_map
    assert found is not None, f"the map {name} has errors"
    return found


def map_names() -> tuple[str, ...]:
    """The maps that are part of vicode."""
    return tuple(sorted(path.stem for path in MAPS_FOLDER.glob("*.yaml")))
