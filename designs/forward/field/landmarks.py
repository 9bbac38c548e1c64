"""Landmarks of the field, and what the simulated cameras detect of them: bearings and distances, with noise.

Goals have colors, so their posts tell the two halves of the field apart. Crossings of lines look the same in both.
"""

import math
from dataclasses import dataclass
from enum import StrEnum
from random import Random

from field import pitch
from field.camera import CAMERA_HEIGHT_MM, NET_RANGE_MM, Direction, View
from field.geometry import Point, Pose
from field.simulated_images import JOINT_NOISE_DEG

PENALTY_AREA_LENGTH_MM = 600.0
PENALTY_AREA_HALF_WIDTH_MM = 1100.0
CIRCLE_RADIUS_MM = 600.0
CROSSING_RANGE_MM = 3000.0

_MISSED = 0.15
_FALSE = 0.05
_CONFUSED = 0.05
_DETECTION_NOISE_DEG = 0.5


class Kind(StrEnum):
    """What a detector can distinguish."""

    OWN_POST = "post of the own goal"
    NET_POST = "post of the opponent's goal"
    CORNER = "corner of two lines"
    JUNCTION = "line that ends at another"
    CROSSING = "crossing of two lines"


@dataclass(frozen=True, slots=True, kw_only=True)
class Sighting:
    """A detected landmark: degrees to the left of ahead, and mm; a post whose foot is not in view has no distance."""

    kind: Kind
    bearing: float
    distance: float | None


def _corners(x: float, y: float) -> tuple[Point, ...]:
    return Point(x, y), Point(x, -y), Point(-x, y), Point(-x, -y)


_INNER_X = pitch.HALF_LENGTH_MM - PENALTY_AREA_LENGTH_MM
LANDMARKS: dict[Kind, tuple[Point, ...]] = {
    Kind.OWN_POST: pitch.POSTS[:2],
    Kind.NET_POST: pitch.POSTS[2:],
    Kind.CORNER: (
        *_corners(pitch.HALF_LENGTH_MM, pitch.HALF_WIDTH_MM),
        *_corners(_INNER_X, PENALTY_AREA_HALF_WIDTH_MM),
    ),
    Kind.JUNCTION: (
        *_corners(pitch.HALF_LENGTH_MM, PENALTY_AREA_HALF_WIDTH_MM),
        Point(0.0, pitch.HALF_WIDTH_MM),
        Point(0.0, -pitch.HALF_WIDTH_MM),
    ),
    Kind.CROSSING: (Point(0.0, CIRCLE_RADIUS_MM), Point(0.0, -CIRCLE_RADIUS_MM)),
}
_POSTS = (Kind.OWN_POST, Kind.NET_POST)
_CONFUSIONS = {Kind.CORNER: Kind.JUNCTION, Kind.JUNCTION: Kind.CORNER, Kind.CROSSING: Kind.JUNCTION}


def detect_landmarks(robot: Pose, view: View, noise: Random) -> list[Sighting]:
    """Return what a detector finds in an image: some landmarks are missed, confused or false."""
    draw = noise.gauss
    off = Direction(bearing=draw(0.0, JOINT_NOISE_DEG), down=draw(0.0, JOINT_NOISE_DEG))
    sightings = []
    for kind, places in LANDMARKS.items():
        for place in places:
            seen = _see(kind, robot.to_local(place), view)
            if seen is None or noise.random() < _MISSED:
                continue
            reported = _CONFUSIONS.get(kind, kind) if noise.random() < _CONFUSED else kind
            sightings.append(_measure(reported, seen, off, noise))
    if noise.random() < _FALSE:
        bearing = view.pan + noise.uniform(-20.0, 20.0)
        sightings.append(
            Sighting(kind=noise.choice(list(Kind)), bearing=bearing, distance=noise.uniform(500.0, 3000.0))
        )
    return sightings


def _see(kind: Kind, local: Point, view: View) -> tuple[float, float | None] | None:
    """Return bearing and angle down to the foot of a landmark; no angle if only the upper part of a post is in view."""
    down = math.degrees(math.atan2(CAMERA_HEIGHT_MM, local.length))
    if view.holds(Direction(bearing=local.bearing, down=down)):
        in_range = local.length <= (NET_RANGE_MM if kind in _POSTS else CROSSING_RANGE_MM)
        return (local.bearing, down) if in_range else None
    if kind not in _POSTS or local.length > NET_RANGE_MM:
        return None
    top = math.degrees(math.atan2(CAMERA_HEIGHT_MM - pitch.GOAL_HEIGHT_MM, local.length))
    nearest = max(top, min(down, view.down))
    return (local.bearing, None) if view.holds(Direction(bearing=local.bearing, down=nearest)) else None


def _measure(kind: Kind, seen: tuple[float, float | None], off: Direction, noise: Random) -> Sighting:
    bearing = seen[0] + off.bearing + noise.gauss(0.0, _DETECTION_NOISE_DEG)
    distance = None
    if seen[1] is not None:
        down = seen[1] + off.down + noise.gauss(0.0, _DETECTION_NOISE_DEG)
        distance = CAMERA_HEIGHT_MM / math.tan(math.radians(max(down, 2.0)))
    return Sighting(kind=kind, bearing=bearing, distance=distance)
