"""An interpreter of a part of SCXML, written from its algorithm (SCXML 1.0, appendix D), and random documents for it.

It shares no code with the importer: states, <parallel>, done events, conditions on data and In(), <assign>.
"""

from __future__ import annotations

import random
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass, field

STATES = ("state", "parallel", "final")
MAX_MICROSTEPS = 6


class NotStableError(Exception):
    """A document takes transitions without event for ever."""


@dataclass(eq=False)
class Node:
    element: ET.Element
    parent: Node | None
    order: int
    children: list[Node] = field(default_factory=list)

    @property
    def tag(self) -> str:
        return self.element.tag

    @property
    def name(self) -> str:
        return self.element.get("id", "")

    def ancestors(self) -> list[Node]:
        return [] if self.parent is None else [self.parent, *self.parent.ancestors()]

    def is_inside(self, other: Node) -> bool:
        return other in self.ancestors()


@dataclass(eq=False)
class Edge:
    source: Node
    element: ET.Element
    targets: list[Node]


class Oracle:
    def __init__(self, text: str) -> None:
        self.nodes: dict[str, Node] = {}
        self.root = self._read(ET.fromstring(text), None)
        self.data = {each.get("id", ""): eval(each.get("expr", "0"), {}) for each in self.root.element.iter("data")}
        self.edges = {
            node: [
                Edge(node, each, [self.nodes[name] for name in each.get("target", "").split()])
                for each in node.element.findall("transition")
            ]
            for node in (self.root, *self.nodes.values())
        }
        self.active: set[Node] = set()
        self.queue: list[str] = []
        self.is_running = True
        self._enter_states([Edge(self.root, ET.Element("transition"), [self._initial(self.root)])])
        self._stabilize()

    def send(self, event: str) -> None:
        if self.is_running:
            self._microstep(self._select(event))
            self._stabilize()

    def configuration(self) -> set[str]:
        """The active states without children."""
        return {each.name for each in self.active if not each.children}

    def _read(self, element: ET.Element, parent: Node | None) -> Node:
        node = Node(element, parent, len(self.nodes))
        if parent is not None:
            self.nodes[node.name] = node
        node.children = [self._read(each, node) for each in element if each.tag in STATES]
        return node

    def _initial(self, node: Node) -> Node:
        name = node.element.get("initial")
        return self.nodes[name] if name else node.children[0]

    def _stabilize(self) -> None:
        for _count in range(MAX_MICROSTEPS):
            if not self.is_running:
                return
            enabled = self._select(None)
            if not enabled:
                if not self.queue:
                    return
                enabled = self._select(self.queue.pop(0))
            self._microstep(enabled)
        raise NotStableError

    def _holds(self, edge: Edge) -> bool:
        text = edge.element.get("cond", "true").replace("&&", " and ").replace("true", "True")
        text = re.sub(r"In\('(\w+)'\)", lambda found: str(self.nodes[found[1]] in self.active), text)
        return bool(eval(text, {}, dict(self.data)))

    def _takes(self, edge: Edge, event: str | None) -> bool:
        descriptors = edge.element.get("event", "").split()
        if event is None:
            return not descriptors
        return any(each in ("*", event) or event.startswith(f"{each}.") for each in descriptors)

    def _select(self, event: str | None) -> list[Edge]:
        enabled: list[Edge] = []
        for atomic in sorted((each for each in self.active if not each.children), key=lambda each: each.order):
            found = (
                edge
                for node in (atomic, *atomic.ancestors())
                for edge in self.edges[node]
                if self._takes(edge, event) and self._holds(edge)
            )
            edge = next(found, None)
            if edge is not None and edge not in enabled:
                enabled.append(edge)
        return self._without_conflicts(enabled)

    def _without_conflicts(self, enabled: list[Edge]) -> list[Edge]:
        kept: list[Edge] = []
        for edge in enabled:
            removed, is_preempted = [], False
            for other in kept:
                if self._exit_set([edge]) & self._exit_set([other]):
                    if edge.source.is_inside(other.source):
                        removed.append(other)
                    else:
                        is_preempted = True
                        break
            if not is_preempted:
                kept = [each for each in kept if each not in removed] + [edge]
        return kept

    def _domain(self, edge: Edge) -> Node:
        is_compound = edge.source.tag == "state" and edge.source.children
        is_internal = edge.element.get("type") == "internal"
        if is_internal and is_compound and all(each.is_inside(edge.source) for each in edge.targets):
            return edge.source
        return next(
            each
            for each in (*edge.source.ancestors(), self.root)
            if each.tag in ("state", "scxml") and all(target.is_inside(each) for target in edge.targets)
        )

    def _exit_set(self, edges: list[Edge]) -> set[Node]:
        with_targets = [edge for edge in edges if edge.targets]
        return {each for edge in with_targets for each in self.active if each.is_inside(self._domain(edge))}

    def _microstep(self, edges: list[Edge]) -> None:
        for node in sorted(self._exit_set(edges), key=lambda each: -each.order):
            self._run(node.element.findall("onexit"))
            self.active.remove(node)
        for edge in edges:
            self._run([edge.element])
        self._enter_states([edge for edge in edges if edge.targets])

    def _enter_states(self, edges: list[Edge]) -> None:
        entered: set[Node] = set()
        for edge in edges:
            domain = self._domain(edge) if edge.source is not self.root else self.root
            for target in edge.targets:
                self._add_descendants(target, entered)
                self._add_ancestors(target, domain, entered)
        for node in sorted(entered, key=lambda each: each.order):
            self.active.add(node)
            self._run(node.element.findall("onentry"))
            if node.tag == "final":
                self._finish(node)

    def _add_descendants(self, node: Node, entered: set[Node]) -> None:
        entered.add(node)
        if node.tag == "parallel":
            self._add_regions(node, entered)
        elif node.children:
            first = self._initial(node)
            self._add_descendants(first, entered)
            self._add_ancestors(first, node, entered)

    def _add_ancestors(self, node: Node, domain: Node, entered: set[Node]) -> None:
        for each in node.ancestors():
            if each is domain:
                return
            entered.add(each)
            if each.tag == "parallel":
                self._add_regions(each, entered)

    def _add_regions(self, node: Node, entered: set[Node]) -> None:
        for region in node.children:
            if not any(each is region or each.is_inside(region) for each in entered):
                self._add_descendants(region, entered)

    def _finish(self, node: Node) -> None:
        parent = node.parent
        assert parent is not None
        if parent is self.root:
            self.is_running = False
            return
        self.queue.append(f"done.state.{parent.name}")
        outer = parent.parent
        if outer is not None and outer.tag == "parallel" and all(map(self._is_done, outer.children)):
            self.queue.append(f"done.state.{outer.name}")

    def _is_done(self, node: Node) -> bool:
        if node.tag == "parallel":
            return all(map(self._is_done, node.children))
        return any(each.tag == "final" and each in self.active for each in node.children)

    def _run(self, blocks: list[ET.Element]) -> None:
        for assign in (each for block in blocks for each in block.findall("assign")):
            self.data[assign.get("location", "")] = eval(assign.get("expr", ""), {}, dict(self.data))


class RandomDocument:
    """A document whose parallel states mostly keep to what designs express, with some that do not."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.count = 0
        self.data = ["shared"]
        self.events: set[str] = set()
        # Without what takes an iteration of its own.
        self.is_exact = self.random.random() < 0.4

    def write(self) -> str:
        body = self._states(self._plan("scxml", 0), "shared")
        data = "".join(f'<data id="{name}" expr="0"/>' for name in self.data)
        return f'<scxml version="1.0"><datamodel>{data}</datamodel>{body}</scxml>'

    def _plan(self, tag: str, depth: int) -> dict:
        self.count += 1
        plan = {"tag": tag, "id": f"s{self.count}", "depth": depth, "children": []}
        if tag == "scxml":
            kinds = ["state", self._kind(1), self._kind(1), "parallel", *["final"] * (self.random.random() < 0.2)]
        elif tag == "parallel":
            kinds = ["region", "region", *["region"] * (self.random.random() < 0.3)]
        elif tag in ("region", "compound"):
            kinds = [self._kind(depth + 1), "state", *["final"] * (self.random.random() < 0.6)]
        else:
            kinds = []
        plan["children"] = [self._plan(kind, depth + 1) for kind in kinds]
        return plan

    def _kind(self, depth: int) -> str:
        return self.random.choice(["state", "compound", "parallel"] if depth < 4 else ["state"])

    def _inside(self, plan: dict) -> Iterator[dict]:
        """The states of the same design."""
        for child in plan["children"]:
            yield child
            if child["tag"] != "parallel":
                yield from self._inside(child)

    def _states(self, design: dict, item: str) -> str:
        targets = [each["id"] for each in self._inside(design)]
        return "".join(self._state(each, design, targets, item) for each in design["children"])

    def _state(self, plan: dict, design: dict, targets: list[str], item: str) -> str:
        tag = plan["tag"]
        if tag == "final":
            return f'<final id="{plan["id"]}">{self._entry(item, 0.3)}</final>'
        chance = 0.0 if self.is_exact and tag == "compound" else 0.3
        if tag == "parallel":
            inner = "".join(self._region(each) for each in plan["children"])
        else:
            inner = "".join(self._state(each, design, targets, item) for each in plan["children"])
        edges = "".join(self._edge(plan, design, targets, item) for _ in range(self.random.choice([1, 1, 2])))
        exits = f"<onexit>{self._assign(item)}</onexit>" if self.random.random() < 0.01 and chance else ""
        tag = "parallel" if tag == "parallel" else "state"
        return f'<{tag} id="{plan["id"]}">{self._entry(item, chance)}{exits}{edges}{inner}</{tag}>'

    def _region(self, plan: dict) -> str:
        self.data.append(f"x{plan['id']}")
        item = self.data[-1]
        targets = [each["id"] for each in self._inside(plan)]
        edge = ""
        if self.random.random() < 0.3:
            edge = self._edge(plan, plan, targets, item).replace("<transition", '<transition type="internal"')
        return f'<state id="{plan["id"]}">{self._entry(item, 0.3)}{edge}{self._states(plan, item)}</state>'

    def _edge(self, plan: dict, design: dict, targets: list[str], item: str) -> str:
        chance = self.random.random()
        if self.random.random() < 0.005:
            targets = [f"s{self.random.randint(2, self.count)}"]
        level = design["depth"] if chance > 0.01 else 0
        event = f"e{level}.{self.random.choice('abc')}"
        if self.is_exact:
            pass
        elif plan["children"] and self.random.random() < 0.5 and plan is not design:
            event = f"done.state.{plan['id']}"
        elif 0.01 < chance < 0.1 and design["tag"] != "scxml":
            event = ""
        elif chance > 0.9:
            event = f"e{level}"
        if event.startswith("e"):
            self.events.add(event)
        read = item if self.random.random() < 0.95 else self.random.choice(self.data)
        conditions = [f"{read} {self.random.choice(['>', '<'])} 2"]
        conditions += [f"In('{self.random.choice(targets)}')"]
        cond = f' cond="{self.random.choice(conditions)}"'.replace("<", "&lt;") if self.random.random() < 0.25 else ""
        given = f' event="{event}"' if event else ""
        content = self._assign(item) if self.random.random() < 0.2 and not self.is_exact else ""
        return f'<transition{given}{cond} target="{self.random.choice(targets)}">{content}</transition>'

    def _entry(self, item: str, chance: float) -> str:
        return f"<onentry>{self._assign(item)}</onentry>" if self.random.random() < chance else ""

    def _assign(self, item: str) -> str:
        return f'<assign location="{item}" expr="{item} + {self.random.choice([1, 2])}"/>'
