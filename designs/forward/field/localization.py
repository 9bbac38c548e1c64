"""Self-localization by an evolutionary algorithm (BICA paper, section VI.C).

Several races, groups of similar poses, compete. Explorers look for poses that explain the landmarks and are not near a
race; the best one founds a race. The exploiters of a race refine its pose. The pose of the robot is that of the race that
has been the best one most often, so symmetric places of the field stay alive until a landmark distinguishes them.
The paper outlines the algorithm only; population sizes, operators and rules of the races are chosen here.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from random import Random

from field import pitch
from field.camera import CAMERA_HEIGHT_MM
from field.geometry import Point, Pose, normalized
from field.landmarks import LANDMARKS, Kind, Sighting

RACES = 6
EXPLOITERS = 12
EXPLORERS = 16
MEMORY_S = 4.0

_ELITE = 4
_MEMORIES = 10
_ANGLE_ERROR = math.radians(1.5)
_SAME_MM = 350.0
_SAME_DEG = 25.0
_SMOOTHING = 0.05
_MOST_VICTORIES = 30
_WEAK = 0.6


@dataclass(slots=True, kw_only=True)
class Memory:
    """A landmark in the odometry frame: where the camera was, the direction to it in degrees, and the distance in mm."""

    kind: Kind
    camera: Point
    direction: float
    distance: float | None
    seen_s: float
    sightings: int = 1

    @property
    def place(self) -> Point:
        """Where the landmark is; for one without distance, a place in its direction."""
        ray = Point(self.distance or 1000.0, 0.0).turned(self.direction)
        return Point(self.camera.x + ray.x, self.camera.y + ray.y)


@dataclass(frozen=True, slots=True, kw_only=True)
class Clue:
    """A memory in the frame of the robot, with the possible landmarks."""

    landmarks: tuple[Point, ...]
    camera: Point
    ray: Point
    distance: float | None
    weight: float


@dataclass(slots=True, kw_only=True)
class Race:
    """Similar poses, best first; `health` is a moving average from 0 to 1."""

    exploiters: list[Pose]
    health: float
    victories: int = 0

    @property
    def pose(self) -> Pose:
        """The mean of the elite."""
        best = self.exploiters[0]
        elite = self.exploiters[:_ELITE]
        x, y = (sum(values) / len(elite) for values in ((pose.x for pose in elite), (pose.y for pose in elite)))
        turn = sum(normalized(pose.heading - best.heading) for pose in elite) / len(elite)
        return Pose(x=x, y=y, heading=normalized(best.heading + turn))


@dataclass(slots=True)
class EvolutionaryLocalization:
    """Estimates the pose of the robot on the field from odometry and landmarks."""

    noise: Random
    odometry: Pose
    races: list[Race] = field(default_factory=list)
    _memories: list[Memory] = field(default_factory=list)
    _selected: Race | None = None

    @property
    def pose(self) -> Pose | None:
        """The pose of the selected race; None before the first landmark."""
        return None if self._selected is None else self._selected.pose

    def update(self, odometry: Pose, sightings: Sequence[Sighting], now_s: float) -> None:
        """Move all races as the robot has moved; evolve them if there are new sightings."""
        self._move(odometry)
        self._remember(sightings, now_s)
        if not sightings:
            return
        clues = [self._clue(memory) for memory in self._memories]
        self._explore(clues)
        for race in self.races:
            self._evolve(race, clues)
        self._merge()
        self._select()

    def _move(self, odometry: Pose) -> None:
        step = self.odometry.to_local(Point(odometry.x, odometry.y))
        turn = normalized(odometry.heading - self.odometry.heading)
        self.odometry = odometry
        if step.length > 0.0 or turn != 0.0:
            for race in self.races:
                race.exploiters = [pose.moved(step.x, step.y, turn) for pose in race.exploiters]

    def _remember(self, sightings: Sequence[Sighting], now_s: float) -> None:
        """Keep the latest landmarks; one that is seen again is replaced."""
        camera = Point(self.odometry.x, self.odometry.y)
        for sighting in sightings:
            direction = self.odometry.heading + sighting.bearing
            new = Memory(
                kind=sighting.kind, camera=camera, direction=direction, distance=sighting.distance, seen_s=now_s
            )
            known = next((memory for memory in self._memories if _is_same(memory, new)), None)
            if known is not None:
                new.sightings = min(known.sightings + 1, 4)
                self._memories.remove(known)
            self._memories.append(new)
        self._memories = [memory for memory in self._memories if now_s - memory.seen_s <= MEMORY_S][-_MEMORIES:]

    def _clue(self, memory: Memory) -> Clue:
        return Clue(
            landmarks=LANDMARKS[memory.kind],
            camera=self.odometry.to_local(memory.camera),
            ray=Point(1.0, 0.0).turned(memory.direction - self.odometry.heading),
            distance=memory.distance,
            weight=memory.sightings,
        )

    def _explore(self, clues: list[Clue]) -> None:
        """Let the best explorer found a race, in place of the weakest one if there are too many."""
        explorers = [self._explorer(clues) for _ in range(EXPLORERS)]
        free = [pose for pose in explorers if not any(_is_near(pose, race.pose) for race in self.races)]
        if not free:
            return
        best_health, best = max(((health(pose, clues), pose) for pose in free), key=lambda entry: entry[0])
        if len(self.races) >= RACES:
            weakest = min(self.races, key=lambda race: (race is self._selected, race.health))
            if best_health * _WEAK < weakest.health:
                return
            self.races.remove(weakest)
        self.races.append(Race(exploiters=[best] * EXPLOITERS, health=best_health * _WEAK))

    def _explorer(self, clues: list[Clue]) -> Pose:
        """Return a pose that explains one landmark, or two if both have a distance; without any, a random pose."""
        draw = self.noise.uniform
        heading = draw(-180.0, 180.0)
        placed = [clue for clue in clues if clue.distance is not None]
        if not placed:
            x, y = pitch.HALF_LENGTH_MM, pitch.HALF_WIDTH_MM
            return Pose(x=draw(-x, x), y=draw(-y, y), heading=heading)
        chosen = self.noise.sample(placed, min(2, len(placed)))
        local = [_local(clue) for clue in chosen]
        places = [self.noise.choice(clue.landmarks) for clue in chosen]
        if len(chosen) == 2:
            heading = normalized(places[1].minus(places[0]).bearing - local[1].minus(local[0]).bearing)
        ray = local[0].turned(heading)
        return Pose(x=places[0].x - ray.x, y=places[0].y - ray.y, heading=heading)

    def _evolve(self, race: Race, clues: list[Clue]) -> None:
        """Keep the elite; children are means of two parents, mutated."""
        elite, draw = race.exploiters[:_ELITE], self.noise.gauss
        children = []
        for _ in range(EXPLOITERS - _ELITE):
            mother, father = self.noise.choice(race.exploiters), self.noise.choice(race.exploiters)
            heading = mother.heading + normalized(father.heading - mother.heading) / 2 + draw(0.0, 2.0)
            x, y = (mother.x + father.x) / 2 + draw(0.0, 40.0), (mother.y + father.y) / 2 + draw(0.0, 40.0)
            children.append(Pose(x=x, y=y, heading=normalized(heading)))
        ranked = sorted(((health(pose, clues), pose) for pose in (*elite, *children)), key=lambda entry: -entry[0])
        race.exploiters = [pose for _, pose in ranked]
        race.health += _SMOOTHING * (ranked[0][0] - race.health)

    def _merge(self) -> None:
        """Delete each race that is near a healthier one, and those outside the field; a selected race passes on its place."""
        kept: list[Race] = []
        for race in sorted(self.races, key=lambda race: -race.health):
            twin = next((other for other in kept if _is_near(race.pose, other.pose)), None)
            if twin is None and _is_on_field(race.pose):
                kept.append(race)
            elif twin is not None:
                twin.victories = max(twin.victories, race.victories)
                self._selected = twin if race is self._selected else self._selected
        self.races = kept

    def _select(self) -> None:
        if not self.races:
            return
        winner = max(self.races, key=lambda race: race.health)
        for race in self.races:
            change = 1 if race is winner else -1
            race.victories = max(0, min(_MOST_VICTORIES, race.victories + change))
        if self._selected not in self.races or winner.victories > self._selected.victories:
            self._selected = winner


def health(pose: Pose, clues: Sequence[Clue]) -> float:
    """Return how well a pose explains the clues, from 0 to 1; a false clue costs only its share."""
    cosine, sine = math.cos(math.radians(pose.heading)), math.sin(math.radians(pose.heading))
    total = weights = 0.0
    for clue in clues:
        least = math.inf
        ray_x, ray_y = clue.ray
        for x, y in clue.landmarks:
            dx, dy = x - pose.x, y - pose.y
            local_x, local_y = dx * cosine + dy * sine - clue.camera.x, dy * cosine - dx * sine - clue.camera.y
            along, across = local_x * ray_x + local_y * ray_y, local_y * ray_x - local_x * ray_y
            if along > 0.0:
                least = min(least, _squared_error(along, across, clue.distance))
        total += clue.weight / (1.0 + least / 4.0)
        weights += clue.weight
    return total / weights if weights else 0.0


def _squared_error(along: float, across: float, distance: float | None) -> float:
    """Errors in units of what a camera measures wrongly; an angle to the ground is a larger error far away."""
    squared = (across / (30.0 + along * _ANGLE_ERROR)) ** 2
    if distance is None:
        return squared
    depth_error = 30.0 + _ANGLE_ERROR * (CAMERA_HEIGHT_MM + distance**2 / CAMERA_HEIGHT_MM)
    return squared + ((along - distance) / depth_error) ** 2


def _local(clue: Clue) -> Point:
    distance = clue.distance or 0.0
    return Point(clue.camera.x + clue.ray.x * distance, clue.camera.y + clue.ray.y * distance)


def _is_same(known: Memory, new: Memory) -> bool:
    if known.kind is not new.kind or (known.distance is None) is not (new.distance is None):
        return False
    if new.distance is None:
        return abs(normalized(known.direction - new.direction)) < 8.0
    return known.place.minus(new.place).length < 150.0 + 0.15 * new.distance


def _is_near(one: Pose, other: Pose) -> bool:
    is_there = math.hypot(one.x - other.x, one.y - other.y) < _SAME_MM
    return is_there and abs(normalized(one.heading - other.heading)) < _SAME_DEG


def _is_on_field(pose: Pose) -> bool:
    border = pitch.BORDER_MM + 200.0
    return abs(pose.x) < pitch.HALF_LENGTH_MM + border and abs(pose.y) < pitch.HALF_WIDTH_MM + border
