"""The ball in 3D by a genetic algorithm (BICA paper, section VI.B).

Images are not searched for the ball. A population of hypotheses, balls on the ground, is projected into the images;
a hypothesis is fit if the pixels inside its window have the ball's color and those around the window do not. Two
images from different angles judge a hypothesis, so that a patch of color in one of them is not taken for the ball.
"""

from random import Random

from field.geometry import Point
from field.simulated_images import HEIGHT, WIDTH, BallImage

POPULATION = 30
GENERATIONS = 4
CONFIRMED = 0.35

_ALPHA = 1.0
_BETA = 2.0
_OUTER = 2.0
_ELITE = 6
_IMAGES = 4
_SCAN_LINE_PX = 3
_TRACKED_IMAGES = 8
_JUMP_MM = 400.0


class GeneticBallTracker:
    """Estimates the position of the ball in the frame of the images' optics."""

    def __init__(self, noise: Random) -> None:
        self._noise = noise
        self._images: list[BallImage] = []
        self._population: list[Point] = []
        self._found: Point | None = None
        self._unseen = _TRACKED_IMAGES

    def update(self, image: BallImage) -> Point | None:
        """Evolve the population with a new image; return the position of the ball, or None if it is not there."""
        self._images = [image, *self._images[: _IMAGES - 1]]
        is_lost = self._unseen >= _TRACKED_IMAGES
        population = [*self._population, *_from_scan_lines(image)] if is_lost else self._population
        ranked = self._ranked(population)
        for _ in range(GENERATIONS):
            ranked = self._ranked(self._next_generation(ranked))
        self._population = [place for _, place in ranked]
        found = _estimate(ranked)
        self._unseen += 1
        if found is None or not self._is_confirmed(found, image, is_lost=is_lost):
            return None
        self._found, self._unseen = found, 0
        return found

    def _is_confirmed(self, found: Point, image: BallImage, *, is_lost: bool) -> bool:
        """Whether the image shows the ball there; a ball that appears must be in a second image, too."""
        if (density(found, image) or 0.0) < CONFIRMED:
            return False
        if not is_lost and self._found is not None and found.minus(self._found).length < _JUMP_MM:
            return True
        return any((density(found, earlier) or 0.0) >= CONFIRMED for earlier in self._images[1:])

    def _ranked(self, population: list[Point]) -> list[tuple[float, Point]]:
        scored = [(self._fitness(place), place) for place in population]
        scored.sort(key=lambda entry: -entry[0])
        return scored[:POPULATION]

    def _fitness(self, place: Point) -> float:
        """Equation 1 of the paper, as a mean over the latest image and the one before it that has the place in view."""
        latest = density(place, self._images[0])
        earlier = next((value for image in self._images[1:] if (value := density(place, image)) is not None), None)
        if latest is None:
            return 1 / POPULATION
        return 1 / POPULATION + (latest if earlier is None else 0.6 * latest + 0.4 * earlier)

    def _next_generation(self, ranked: list[tuple[float, Point]]) -> list[Point]:
        """Keep the elite; children are weighted means of two parents, mutated."""
        elite = [place for _, place in ranked[:_ELITE]]
        immigrant = self._random_place()
        if not elite:
            return [] if immigrant is None else [immigrant]
        weights = [fitness for fitness, _ in ranked]
        parents = self._noise.choices([place for _, place in ranked], weights, k=2 * (POPULATION - _ELITE))
        children = [self._child(*pair) for pair in zip(parents[::2], parents[1::2], strict=True)]
        return [*elite, *children[1:], children[0] if immigrant is None else immigrant]

    def _child(self, mother: Point, father: Point) -> Point:
        """Mutation is along and across the line of sight; depth is less certain than direction."""
        share, draw, optics = self._noise.random(), self._noise.gauss, self._images[0].optics
        x, y = mother.x + share * (father.x - mother.x), mother.y + share * (father.y - mother.y)
        if mother.minus(father).length > _JUMP_MM:
            x, y = mother
        sight = Point(x - optics.x, y - optics.y)
        distance = max(sight.length, 1.0)
        along, across = draw(0.0, 10.0 + 2e-5 * distance**2), draw(0.0, 5.0 + 0.005 * distance)
        return Point(
            x + (sight.x * along - sight.y * across) / distance, y + (sight.y * along + sight.x * across) / distance
        )

    def _random_place(self) -> Point | None:
        return self._images[0].optics.place(self._noise.uniform(0, WIDTH), self._noise.uniform(0, HEIGHT))


def _from_scan_lines(image: BallImage) -> list[Point]:
    """Return places of positive pixels on every third row, the first hypotheses about a ball that is not tracked."""
    rows = [row for row in range(0, HEIGHT, _SCAN_LINE_PX) if image.rows[row]]
    pixels = [(column, row) for row in rows for column in range(WIDTH) if image.rows[row] >> column & 1]
    places = (image.optics.place(column + 0.5, row + 0.5) for column, row in pixels)
    return [place for place in places if place is not None]


def density(place: Point, image: BallImage) -> float | None:
    """Return how well a hypothesis fits an image: 0 to 1; None if it is outside.

    The windows are those of two cubes around the ball with faces parallel to the image, the outer one twice as large.
    """
    projection = image.optics.project(place)
    if projection is None:
        return None
    column, row, radius = projection
    if not (0.0 <= column < WIDTH and 0.0 <= row < HEIGHT):
        return None
    inner, inner_area = _count(image, column, row, radius)
    outer, outer_area = _count(image, column, row, max(_OUTER * radius, radius + 1.0))
    ring = (outer - inner) / max(outer_area - inner_area, 1)
    return max(0.0, _ALPHA * inner / inner_area - _BETA * ring)


def _count(image: BallImage, column: float, row: float, radius: float) -> tuple[int, int]:
    left, top = round(column - radius), round(row - radius)
    right, bottom = max(round(column + radius), left + 1), max(round(row + radius), top + 1)
    return image.count(left, top, right, bottom), (right - left) * (bottom - top)


def _estimate(ranked: list[tuple[float, Point]]) -> Point | None:
    """Return the mean of the hypotheses that are about as fit as the best one and near it."""
    if not ranked:
        return None
    best, place = ranked[0]
    near = [other for fitness, other in ranked if fitness >= 0.9 * best and other.minus(place).length < _JUMP_MM]
    return Point(sum(other.x for other in near) / len(near), sum(other.y for other in near) / len(near))
