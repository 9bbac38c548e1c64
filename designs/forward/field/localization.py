"""Self-localization by an evolutionary algorithm (BICA paper, section VI.C).

Several races, groups of similar poses, compete. Explorers look for poses that explain the landmarks and are not near a
race; the best one founds a race. The exploiters of a race refine its pose. The pose of the robot is that of the race
that has been the best one most often, so symmetric places of the field stay alive until a landmark distinguishes them.
The paper only outlines the algorithm; population sizes, operators and rules of the races are chosen here.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from random import Random

from field import pitch
from field.camera import CAMERA_HEIGHT_MM
from field.geometry import ORIGIN, Point, Pose, normalized
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
class Clue:
    """A remembered landmark in the frame of the robot: place of the camera, direction, and distance in mm."""

    kind: Kind
    camera: Point
    ray: Point
    distance: float | None
    seen_s: float
    sightings: int = 1

    @property
    def place(self) -> Point:
        """Where the landmark is; for one without distance, a place in its direction."""
        distance = self.distance or 3000.0
        return Point(self.camera.x + self.ray.x * distance, self.camera.y + self.ray.y * distance)


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
    _clues: list[Clue] = field(default_factory=list)
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
        self._explore()
        for race in self.races:
            self._evolve(race)
        self._merge()
        self._select()

    def _move(self, odometry: Pose) -> None:
        step = self.odometry.to_local(Point(odometry.x, odometry.y))
        turn = normalized(odometry.heading - self.odometry.heading)
        self.odometry = odometry
        if step == ORIGIN and turn == 0.0:
            return
        for race in self.races:
            race.exploiters = [pose.moved(step.x, step.y, turn) for pose in race.exploiters]
        for clue in self._clues:
            clue.camera, clue.ray = clue.camera.minus(step).turned(-turn), clue.ray.turned(-turn)

    def _remember(self, sightings: Sequence[Sighting], now_s: float) -> None:
        """Keep the latest landmarks; one that is seen again is replaced."""
        for seen in sightings:
            ray = Point(1.0, 0.0).turned(seen.bearing)
            new = Clue(kind=seen.kind, camera=ORIGIN, ray=ray, distance=seen.distance, seen_s=now_s)
            known = next((clue for clue in self._clues if _is_same(clue, new)), None)
            if known is not None:
                new.sightings = min(known.sightings + 1, 4)
                self._clues.remove(known)
            self._clues.append(new)
        self._clues = [clue for clue in self._clues if now_s - clue.seen_s <= MEMORY_S][-_MEMORIES:]

    def _explore(self) -> None:
        """Let the best explorer found a race, in place of the weakest one if there are too many."""
        placed = [clue for clue in self._clues if clue.distance is not None]
        if not placed:
            return
        explorers = [self._explorer(placed) for _ in range(EXPLORERS)]
        taken = [race.pose for race in self.races]
        free = [pose for pose in explorers if _is_on_field(pose) and not any(_is_near(pose, other) for other in taken)]
        if not free:
            return
        best_health, best = max(((health(pose, self._clues), pose) for pose in free), key=lambda entry: entry[0])
        if len(self.races) >= RACES:
            weakest = min(self.races, key=lambda race: (race is self._selected, race.health))
            if best_health * _WEAK < weakest.health:
                return
            self.races.remove(weakest)
        self.races.append(Race(exploiters=[best] * EXPLOITERS, health=best_health * _WEAK))

    def _explorer(self, placed: list[Clue]) -> Pose:
        """Return a pose that explains two landmarks, or one of them if the robot knows no more."""
        chosen = self.noise.sample(placed, min(2, len(placed)))
        local = [clue.place for clue in chosen]
        places = [self.noise.choice(LANDMARKS[clue.kind]) for clue in chosen]
        heading = self.noise.uniform(-180.0, 180.0)
        if len(chosen) == 2:
            heading = normalized(places[1].minus(places[0]).bearing - local[1].minus(local[0]).bearing)
        ray = local[0].turned(heading)
        return Pose(x=places[0].x - ray.x, y=places[0].y - ray.y, heading=heading)

    def _evolve(self, race: Race) -> None:
        """Keep the elite; children are means of two parents, mutated."""
        elite, draw = race.exploiters[:_ELITE], self.noise.gauss
        children = []
        for _ in range(EXPLOITERS - _ELITE):
            mother, father = self.noise.choice(race.exploiters), self.noise.choice(race.exploiters)
            heading = mother.heading + normalized(father.heading - mother.heading) / 2 + draw(0.0, 2.0)
            x, y = (mother.x + father.x) / 2 + draw(0.0, 40.0), (mother.y + father.y) / 2 + draw(0.0, 40.0)
            children.append(Pose(x=x, y=y, heading=normalized(heading)))
        ranked = sorted(
            ((health(pose, self._clues), pose) for pose in (*elite, *children)), key=lambda entry: -entry[0]
        )
        race.exploiters = [pose for _, pose in ranked]
        race.health += _SMOOTHING * (ranked[0][0] - race.health)

    def _merge(self) -> None:
        """Delete each race that is near a healthier one, which takes over its victories."""
        kept: list[Race] = []
        for race in sorted(self.races, key=lambda race: -race.health):
            twin = next((other for other in kept if _is_near(race.pose, other.pose)), None)
            if twin is None:
                kept.append(race)
                continue
            twin.victories = max(twin.victories, race.victories)
            self._selected = twin if race is self._selected else self._selected
        self.races = kept

    def _select(self) -> None:
        if not self.races:
            return
        winner = max(self.races, key=lambda race: race.health)
        for race in self.races:
            race.victories = max(0, min(_MOST_VICTORIES, race.victories + (1 if race is winner else -1)))
        if self._selected is None or winner.victories > self._selected.victories:
            self._selected = winner


def health(pose: Pose, clues: Sequence[Clue]) -> float:
    """Return how well a pose explains the clues, from 0 to 1; a false clue costs only its share."""
    cosine, sine = math.cos(math.radians(pose.heading)), math.sin(math.radians(pose.heading))
    total = weights = 0.0
    for clue in clues:
        least = math.inf
        ray_x, ray_y = clue.ray
        for x, y in LANDMARKS[clue.kind]:
            dx, dy = x - pose.x, y - pose.y
            local_x, local_y = dx * cosine + dy * sine - clue.camera.x, dy * cosine - dx * sine - clue.camera.y
            along, across = local_x * ray_x + local_y * ray_y, local_y * ray_x - local_x * ray_y
            if along > 0.0:
                least = min(least, _squared_error(along, across, clue.distance))
        total += clue.sightings / (1.0 + least / 4.0)
        weights += clue.sightings
    return total / weights if weights else 0.0


def _squared_error(along: float, across: float, distance: float | None) -> float:
    """Errors in units of what a camera measures wrongly; an angle to the ground is a larger error far away."""
    squared = (across / (30.0 + along * _ANGLE_ERROR)) ** 2
    if distance is None:
        return squared
    depth_error = 30.0 + _ANGLE_ERROR * (CAMERA_HEIGHT_MM + distance**2 / CAMERA_HEIGHT_MM)
    return squared + ((along - distance) / depth_error) ** 2


def _is_same(known: Clue, new: Clue) -> bool:
    return known.kind is new.kind and known.place.minus(new.place).length < 150.0 + 0.12 * (new.distance or 3000.0)


def _is_near(one: Pose, other: Pose) -> bool:
    is_there = math.hypot(one.x - other.x, one.y - other.y) < _SAME_MM
    return is_there and abs(normalized(one.heading - other.heading)) < _SAME_DEG


def _is_on_field(pose: Pose) -> bool:
    return abs(pose.x) < pitch.HALF_LENGTH_MM + pitch.BORDER_MM and abs(pose.y) < pitch.HALF_WIDTH_MM + pitch.BORDER_MM
