"""Plots as the timeline draws them."""

from collections.abc import Sequence

from vicode.editor.view.plot import PlotSeries, add_cursor, render_series


def draw_plot(curves: Sequence[PlotSeries], states: Sequence[str], cursor: int) -> str:
    return add_cursor(render_series(curves, states), curves, states, cursor)
