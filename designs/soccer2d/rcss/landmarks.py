"""The landmarks of the field, and the position of a player who sees some of them.

A place is a complex number: x from the center to the right goal, y towards the bottom line, in m.
"""

import cmath
import math
from collections.abc import Iterable


def _place_landmarks() -> dict[str, complex]:
    places = {"f c": 0j, "f c t": -34j, "f c b": 34j, "f t 0": -39j, "f b 0": 39j}
    for side, x in (("l", -1), ("r", 1)):
        places |= {f"g {side}": 52.5 * x, f"f {side} 0": 57.5 * x, f"f p {side} c": 36 * x}
        for edge, y in (("t", -1j), ("b", 1j)):
            places |= {f"f {side} {edge}": 52.5 * x + 34 * y, f"f g {side} {edge}": 52.5 * x + 7.01 * y}
            places |= {f"f p {side} {edge}": 36 * x + 20.16 * y}
            places |= {f"f {side} {edge} {meters}": 57.5 * x + meters * y for meters in (10, 20, 30)}
            places |= {f"f {edge} {side} {meters}": meters * x + 39 * y for meters in (10, 20, 30, 40, 50)}
    return {name: complex(place) for name, place in places.items()}


LANDMARKS = _place_landmarks()
"""Flags and goals by name."""


def relative(distance: float, degrees: float) -> complex:
    """Return a place relative to the player: straight ahead is the real axis."""
    return cmath.rect(distance, math.radians(degrees))


def locate(sightings: Iterable[tuple[complex, complex]]) -> tuple[complex, float] | None:
    """Return the place of the player and the direction of its view in degrees, or None.

    It is the rotation and shift that map what is seen onto the known places, by weighted least squares. Two landmarks
    are enough. Near ones count more, because the noise grows with the distance.

    Args:
        sightings: Known places, and the same landmarks as seen relative to the player.
    """
    weighted = [(place, seen, 1 / (1 + abs(seen)) ** 2) for place, seen in sightings]
    if len(weighted) < 2:
        return None
    total = sum(weight for _place, _seen, weight in weighted)
    center = sum(place * weight for place, _seen, weight in weighted) / total
    seen_center = sum(seen * weight for _place, seen, weight in weighted) / total
    turned = sum((place - center) * (seen - seen_center).conjugate() * weight for place, seen, weight in weighted)
    if not turned:
        return None
    return center - seen_center * turned / abs(turned), math.degrees(cmath.phase(turned))
