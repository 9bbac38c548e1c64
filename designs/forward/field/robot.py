"""The body of the robot, which walks, turns its head, kicks, falls and stands up."""

from dataclasses import dataclass, field
from random import Random

from field import pitch
from field.geometry import ORIGIN, Point, Pose, approached, limited
from field.kicks import CONTACT_S, DURATION_S, KickMotion

MAX_FORWARD_MM_S = 220.0
MAX_LATERAL_MM_S = 100.0
MAX_TURN_DEG_S = 50.0
MAX_PAN_DEG = 119.0
MIN_TILT_DEG = -38.0
MAX_TILT_DEG = 29.0
MAX_HEAD_DEG_S = 90.0
STAND_UP_S = 3.0

# A command expires after this time, so that the joints of a component that is no longer stepped come to rest.
_COMMAND_S = 0.25
_WALK_ACCELERATION_MM_S2 = 500.0
_TURN_ACCELERATION_DEG_S2 = 150.0
_FALLS_PER_SECOND = 0.004
_FALLS_PER_KICK = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class Gait:
    """Speeds of a walk: mm/s ahead and to the left, degrees/s to the left."""

    forward: float = 0.0
    lateral: float = 0.0
    turn: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Swing:
    """A kick in progress."""

    motion: KickMotion
    is_left: bool
    began_s: float


STANDING = Gait()


@dataclass(slots=True, kw_only=True)
class Robot:
    """State of the body; `odometry` is its pose estimated from its steps."""

    pose: Pose
    noise: Random
    odometry: Pose = field(default_factory=lambda: Pose(x=0.0, y=0.0, heading=0.0))
    pan: float = 0.0
    tilt: float = 0.0
    gait: Gait = STANDING
    is_fallen: bool = False
    swing: Swing | None = None
    time_s: float = 0.0
    _wanted: Gait = STANDING
    _wanted_until_s: float = 0.0
    _head_speed: Point = ORIGIN
    _head_until_s: float = 0.0
    _up_again_s: float | None = None
    _has_struck: bool = False
    _slip: Gait = STANDING

    def __post_init__(self) -> None:
        """Draw the calibration errors of the legs."""
        draw = self.noise.gauss
        self._slip = Gait(forward=draw(0.97, 0.03), lateral=draw(0.95, 0.05), turn=draw(0.0, 1.5))

    def walk(self, gait: Gait) -> None:
        """Command a walk, limited to the maximum speeds; ignored while the robot lies or kicks."""
        self._wanted = Gait(
            forward=limited(gait.forward, MAX_FORWARD_MM_S),
            lateral=limited(gait.lateral, MAX_LATERAL_MM_S),
            turn=limited(gait.turn, MAX_TURN_DEG_S),
        )
        self._wanted_until_s = self.time_s + _COMMAND_S

    def turn_head(self, pan_speed: float, tilt_speed: float) -> None:
        """Command neck speeds in degrees/s: to the left, downwards."""
        self._head_speed = Point(limited(pan_speed, MAX_HEAD_DEG_S), limited(tilt_speed, MAX_HEAD_DEG_S))
        self._head_until_s = self.time_s + _COMMAND_S

    def kick(self, motion: KickMotion, *, is_left: bool) -> bool:
        """Start a kick; return False if the robot lies or already kicks."""
        if self.is_fallen or self.swing is not None:
            return False
        self.swing = Swing(motion=motion, is_left=is_left, began_s=self.time_s)
        self._has_struck = False
        return True

    def stand_up(self) -> None:
        """Start to stand up if the robot lies."""
        if self.is_fallen and self._up_again_s is None:
            self._up_again_s = self.time_s + STAND_UP_S

    def move(self, seconds: float) -> Swing | None:
        """Advance the simulation; return the swing whose foot hits the ball in this step."""
        self.time_s += seconds
        self._move_head(seconds)
        self._move_legs(seconds)
        if self._up_again_s is not None and self.time_s >= self._up_again_s:
            self.is_fallen, self._up_again_s = False, None
        return self._move_swing()

    def _move_head(self, seconds: float) -> None:
        if self.time_s > self._head_until_s or self.is_fallen:
            return
        self.pan = limited(self.pan + self._head_speed.x * seconds, MAX_PAN_DEG)
        self.tilt = max(MIN_TILT_DEG, min(MAX_TILT_DEG, self.tilt + self._head_speed.y * seconds))

    def _move_legs(self, seconds: float) -> None:
        is_free = self.time_s <= self._wanted_until_s and not self.is_fallen and self.swing is None
        wanted = self._wanted if is_free else STANDING
        change, turn_change = _WALK_ACCELERATION_MM_S2 * seconds, _TURN_ACCELERATION_DEG_S2 * seconds
        self.gait = gait = Gait(
            forward=approached(self.gait.forward, wanted.forward, change),
            lateral=approached(self.gait.lateral, wanted.lateral, change),
            turn=approached(self.gait.turn, wanted.turn, turn_change),
        )
        if gait == STANDING:
            return
        ahead, left, turn = gait.forward * seconds, gait.lateral * seconds, gait.turn * seconds
        self.odometry = self.odometry.moved(ahead, left, turn)
        drift = (self._slip.turn + self.noise.gauss(0.0, 8.0)) * seconds
        self.pose = _on_field(
            self.pose.moved(ahead * self._slip.forward, left * self._slip.lateral, turn + drift),
        )
        if self.noise.random() < _FALLS_PER_SECOND * seconds:
            self._fall()

    def _move_swing(self) -> Swing | None:
        swing = self.swing
        if swing is None:
            return None
        if self.time_s >= swing.began_s + DURATION_S:
            self.swing = None
            if self.noise.random() < _FALLS_PER_KICK:
                self._fall()
        if self._has_struck or self.time_s < swing.began_s + CONTACT_S:
            return None
        self._has_struck = True
        return swing

    def _fall(self) -> None:
        self.is_fallen, self.swing, self.gait = True, None, STANDING


def _on_field(pose: Pose) -> Pose:
    """Limit the position to the carpet."""
    x = limited(pose.x, pitch.HALF_LENGTH_MM + pitch.BORDER_MM)
    y = limited(pose.y, pitch.HALF_WIDTH_MM + pitch.BORDER_MM)
    return pose if (x, y) == (pose.x, pose.y) else Pose(x=x, y=y, heading=pose.heading)
