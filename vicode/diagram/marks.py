"""Marks of elements of a diagram, by color and by a sign, such as those of added and removed states."""

from dataclasses import dataclass, replace

from vicode.diagram.palettes import ColorPalette
from vicode.diagram.primitives import PathShape, ShapeGroup, TextShape, circle_path, polyline_path, rounded_rect_path
from vicode.diagram.spatial_index import Rect
from vicode.diagram.text_metrics import Font
from vicode.model.design import Point

SIGN_RADIUS = 8.0
_SIGN_FONT = Font(size=13, bold=True)
_MARKED_PARTS = (
    ("box_line", "edge", "plate_line", "component_line", "requires", "modulates", "common"),
    ("box_line", "edge", "plate_line", "component_line", "requires", "modulates", "common", "text", "component_text"),
)
_MIN_SHIFT = 4.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """How an element is marked.

    Attributes:
        color: Of its lines, and of the disk behind the sign.
        sign: One character.
        title: Words that are added to the tooltip.
        is_removed: Dashed lines and struck-through texts.
        moved_from: The former center of a node, which is outlined.
    """

    color: str
    sign: str
    title: str
    is_removed: bool = False
    moved_from: Point | None = None

    def tint(self, palette: ColorPalette) -> ColorPalette:
        """The colors of the marked element."""
        return replace(palette, **dict.fromkeys(_MARKED_PARTS[self.is_removed], self.color))

    def emphasize(self, group: ShapeGroup) -> ShapeGroup:
        """The element with stronger lines and a longer tooltip."""
        shapes = tuple(self._path(each) if isinstance(each, PathShape) else self._text(each) for each in group.shapes)
        return replace(group, shapes=shapes, title="\n".join(part for part in (group.title, self.title) if part))

    def sign_group(self, at: Point, palette: ColorPalette) -> ShapeGroup:
        """The sign on a disk."""
        disk = PathShape(commands=circle_path(at, SIGN_RADIUS), fill=self.color, stroke=palette.box, width=1.5)
        text = TextShape(x=at[0], y=at[1], text=self.sign, fill=palette.box, font=_SIGN_FONT, is_centered=True)
        return ShapeGroup(title=self.title, css_class="mark", shapes=(disk, text))

    def outline_group(self, rect: Rect) -> ShapeGroup | None:
        """The outline of a moved node at its former place, with a line to the new one; None if it is near."""
        center = ((rect.left + rect.right) / 2, (rect.top + rect.bottom) / 2)
        if (
            self.moved_from is None
            or sum(abs(a - b) for a, b in zip(center, self.moved_from, strict=True)) < _MIN_SHIFT
        ):
            return None
        width, height = rect.right - rect.left, rect.bottom - rect.top
        outline = rounded_rect_path(self.moved_from, width, height, 12)
        shapes = (
            PathShape(commands=outline, stroke=self.color, width=1, dash=(2, 4)),
            PathShape(commands=polyline_path((self.moved_from, center)), stroke=self.color, width=1, dash=(2, 4)),
        )
        return ShapeGroup(title=self.title, css_class="mark", shapes=shapes)

    def _path(self, path: PathShape) -> PathShape:
        if not path.stroke:
            return path
        return replace(path, width=path.width + 0.9, dash=(6, 4) if self.is_removed else path.dash)

    def _text(self, text: TextShape) -> TextShape:
        return replace(text, is_struck_through=True) if self.is_removed else text
