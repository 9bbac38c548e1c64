"""Test scenes: a player with every kind of element, and large generated machines."""

from typing import Any


def player() -> dict[str, Any]:
    """Eight states, a self loop, both directions, parallel edges, components, links and findings."""
    return {
        "rev": 1, "component": "Player", "doc": "Forward player.", "theme": "auto",
        "states": _player_states(), "transitions": _player_transitions(),
        "components": _player_components(), "links": _player_links(),
        "common": {"x": -160, "y": 530, "transitions": 1, "actions": False},
    }  # fmt: skip


def machine(count: int) -> dict[str, Any]:
    """Generated machine: `count` states on a grid with three transitions each, some self loops and parallel edges."""
    columns = max(2, round((count * 0.6) ** 0.5 * 1.3))
    states = [
        _state(
            f"State{n}", (n % columns) * 240, (n // columns) * 150, initial=n == 0, actions=n % 2 == 0, requires=n % 3
        )
        for n in range(count)
    ]
    transitions = []
    for n in range(count):
        targets = [
            (n + 1) % count,
            (n + columns) % count,
            n if n % 7 == 0 else (n * 31 + 17) % count if n % 5 == 0 else (n + 1) % count,
        ]
        for order, target in enumerate(targets):
            transitions.append(
                _transition(f"State{n}", order, f"State{target}", f"signal_{(n * 3 + order) % 97} > 0.5", order + 1, 3)
            )
    return {
        "rev": 1, "component": f"Machine{count}", "doc": "", "theme": "auto",
        "states": states, "transitions": transitions, "components": [], "links": [], "common": None,
    }  # fmt: skip


def _state(name: str, x: float, y: float, **more: Any) -> dict[str, Any]:
    plain = {
        "initial": False, "final": False, "disabled": False, "enter": False, "actions": False, "leave": False,
        "requires": 0, "modulates": 0, "doc": "", "severity": None, "messages": [],
    }  # fmt: skip
    return {"id": name, "name": name, "x": x, "y": y, **plain, **more}


def _transition(source: str, index: int, target: str, label: str, order: int, of: int, **more: Any) -> dict[str, Any]:
    plain = {"kind": "guard", "guard": label, "doc": "", "severity": None, "messages": []}
    return {
        "id": f"{source}/{index}",
        "source": source,
        "target": target,
        "label": label,
        "order": order,
        "of": of,
        **plain,
        **more,
    }


def _link(kind: str, state: str, component: str) -> dict[str, Any]:
    return {"id": f"{kind}/{state}/{component}", "kind": kind, "state": state, "component": component}


def _player_states() -> list[dict[str, Any]]:
    return [
        _state(
            "LookForBall",
            80,
            120,
            initial=True,
            enter=True,
            actions=True,
            requires=1,
            modulates=1,
            doc="Look around until the ball is seen.",
        ),
        _state("FollowBall", 420, 120, actions=True, requires=1, modulates=1),
        _state("SearchNet", 760, 120, requires=1, leave=True),
        _state(
            "Fixmove",
            760,
            330,
            enter=True,
            actions=True,
            leave=True,
            severity="warning",
            messages=["tested after an unconditional transition"],
        ),
        _state("KickLeft", 480, 470, final=True),
        _state("KickRight", 760, 530, final=True),
        _state("GiveUp", 80, 330, disabled=True),
        _state("GetUp", 80, 530, actions=True, severity="error", messages=["no way out", "unknown name 'bodi'"]),
    ]


def _player_transitions() -> list[dict[str, Any]]:
    return [
        _transition(
            "LookForBall",
            0,
            "FollowBall",
            "perception.ball_seen and perception.ball_distance < 4000",
            1,
            3,
            doc="Only near balls.",
        ),
        _transition("LookForBall", 1, "LookForBall", "5 s", 2, 3, kind="timer"),
        _transition("LookForBall", 2, "GiveUp", "tries > 3", 3, 3),
        _transition("FollowBall", 0, "LookForBall", "not ball_seen", 1, 3),
        _transition("FollowBall", 1, "SearchNet", "ball_near", 2, 3),
        _transition("FollowBall", 2, "SearchNet", "8 s", 3, 3, kind="timer", severity="note", messages=["hidden by 2"]),
        _transition("SearchNet", 0, "Fixmove", "net_seen", 1, 2),
        _transition("SearchNet", 1, "FollowBall", "ball lost", 2, 2, kind="code"),
        _transition("Fixmove", 0, "KickLeft", "net_x > 0", 1, 2, kind="tree"),
        _transition("Fixmove", 1, "KickRight", "net_x <= 0", 2, 2, kind="tree"),
        _transition("GetUp", 0, "LookForBall", "", 1, 1, kind="always"),
        _transition("@common", 0, "GetUp", "body.fallen", 1, 1),
    ]


def _player_components() -> list[dict[str, Any]]:
    return [
        {
            "id": "perception",
            "name": "Perception",
            "x": 420,
            "y": -60,
            "design": False,
            "severity": None,
            "messages": [],
        },
        {
            "id": "search_ball",
            "name": "SearchBall",
            "x": 80,
            "y": -60,
            "design": True,
            "severity": None,
            "messages": [],
        },
        {
            "id": "follow_ball",
            "name": "FollowBall",
            "x": 420,
            "y": 320,
            "design": True,
            "severity": None,
            "messages": [],
        },
    ]


def _player_links() -> list[dict[str, Any]]:
    return [
        _link("requires", "LookForBall", "perception"),
        _link("requires", "FollowBall", "perception"),
        _link("requires", "SearchNet", "perception"),
        _link("modulates", "LookForBall", "search_ball"),
        _link("modulates", "FollowBall", "follow_ball"),
    ]
