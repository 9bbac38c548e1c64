"""Colors of diagrams, light and dark: those of the canvas (a test compares them)."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class ColorPalette:
    """One color per part, named as in the canvas style sheet, with underscores."""

    paper: str
    text: str
    muted: str
    box: str
    box_line: str
    faint: str
    edge: str
    plate: str
    plate_line: str
    start: str
    component: str
    component_line: str
    component_text: str
    requires: str
    modulates: str
    common: str
    common_fill: str
    color_blue: str
    color_green: str
    color_yellow: str
    color_orange: str
    color_red: str
    color_purple: str

    def frame_fill(self, color: str) -> str:
        """The fill of a frame: half of the color of a state, so that states stand out."""
        fill = getattr(self, f"color_{color}") if color else self.faint
        if not (fill.startswith("#") and self.paper.startswith("#")):
            return f"color-mix(in srgb, {fill} 55%, {self.paper})"
        pairs = ((int(fill[at : at + 2], 16), int(self.paper[at : at + 2], 16)) for at in (1, 3, 5))
        return "#" + "".join(f"{round(0.55 * own + 0.45 * paper):02x}" for own, paper in pairs)


def css_variable_palette() -> ColorPalette:
    """Colors defined by the style sheet of the page that contains the diagram."""
    return ColorPalette(
        **{name: f"var(--drawn-{name.replace('_', '-')})" for name in ColorPalette.__dataclass_fields__}
    )


def palette_variables(palette: ColorPalette) -> dict[str, str]:
    """The values of the variables of `css_variable_palette`, without the leading dashes."""
    return {f"drawn-{name.replace('_', '-')}": getattr(palette, name) for name in ColorPalette.__dataclass_fields__}


LIGHT = ColorPalette(
    paper="#f8fafc",
    text="#18212f",
    muted="#526075",
    box="#ffffff",
    box_line="#64748b",
    faint="#e3e9f1",
    edge="#5d6b80",
    plate="#ffffff",
    plate_line="#cbd5e1",
    start="#18212f",
    component="#eaf3ff",
    component_line="#1f6fb8",
    component_text="#134a80",
    requires="#1f6fb8",
    modulates="#0f766e",
    common="#7c3aed",
    common_fill="#f5f0ff",
    color_blue="#e0edff",
    color_green="#e2f5d3",
    color_yellow="#fef6c0",
    color_orange="#ffe6cc",
    color_red="#fee0e0",
    color_purple="#f1e4ff",
)
DARK = ColorPalette(
    paper="#11161e",
    text="#e6ecf5",
    muted="#a4b1c4",
    box="#1c2431",
    box_line="#8797ae",
    faint="#232c39",
    edge="#94a3b8",
    plate="#1a212d",
    plate_line="#3a475b",
    start="#e6ecf5",
    component="#12253c",
    component_line="#64a8ee",
    component_text="#bcdcff",
    requires="#64a8ee",
    modulates="#4fd1c0",
    common="#b794ff",
    common_fill="#241c38",
    color_blue="#1a3560",
    color_green="#24421b",
    color_yellow="#443a0f",
    color_orange="#4d2c12",
    color_red="#4d1d26",
    color_purple="#3a2460",
)
