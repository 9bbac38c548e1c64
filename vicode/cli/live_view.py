"""Live view of a run in the terminal: state changes scroll above the activation tree and the world."""

from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.text import Text
from rich.tree import Tree

from vicode.traces.descriptions import TraceRecord, describe_world

_LINKS = {"root": "", "requires": "requires ", "modulates": "modulates "}


class LiveTracePrinter:
    """Draws the latest iteration 15 times per second."""

    def __init__(self, console: Console | None = None) -> None:
        """Start drawing on a console; by default, on the terminal."""
        self._console = console or Console(highlight=False)
        self._latest: TraceRecord | None = None
        self._live = Live(get_renderable=self._draw, console=self._console, refresh_per_second=15)
        self._live.start()

    def show_iteration(self, record: TraceRecord, changes: list[str], /) -> None:
        """Print the changes and keep the iteration for the next refresh."""
        self._latest = record
        for change in changes:
            time, component, rest = change[:12], *change[12:].split(":", 1)
            self._console.print(Text.assemble((time, "dim"), (component, "bold"), ":", rest))

    def show_text(self, text: str) -> None:
        self._console.print(Text(text, style="red" if text.startswith("error") else ""))

    def show_notice(self, text: str) -> None:
        self._console.print(Text(text, style="bold"))

    def close(self) -> None:
        """Stop drawing; the last view stays visible."""
        self._live.stop()

    def _draw(self) -> RenderableType:
        return render_iteration(self._latest) if self._latest is not None else Text("starting …", style="dim")


def render_iteration(record: TraceRecord) -> RenderableType:
    """Render the activation tree of an iteration and the world."""
    title = Text(f"{record['time_ns'] / 1e9:8.2f} s  iteration {record['iteration']}", style="bold")
    parts: list[RenderableType] = [title]
    nodes: dict[str, Tree] = {}
    for step in record["tree"]:
        parent = nodes.get(step["by"])
        node = Tree(_label(step)) if parent is None else parent.add(_label(step))
        if parent is None:
            parts.append(node)
        # A component stepped twice gets two branches; its children are added to the latest.
        nodes[step["component"]] = node
    world = describe_world(record.get("world"))
    return Group(*parts, *([Text(world, style="cyan", no_wrap=True, overflow="ellipsis")] if world else []))


def _label(step: TraceRecord) -> Text:
    label = Text.assemble((_LINKS[step["link"]], "dim"), (step["component"], "bold" if step["worked"] else ""))
    if step["state"]:
        label.append(f"  {step['state']}", "green" if step["done"] else "yellow")
        label.append(f" {step['state_time_ns'] / 1e9:.2f} s", "dim")
    if step["parameters"]:
        label.append(f"  {describe_world(step['parameters'])}", "dim")
    return label
