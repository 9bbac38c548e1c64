"""Users, presences, and concurrent typing in one field."""

from dataclasses import dataclass, field

from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session import DISK_USER, Presence, PresenceRoom, UserDirectory
from vicode.editor.session.descriptions import describe_presence, describe_value
from vicode.editor.session.field_merge import FieldMerge, SentValues
from vicode.editor.view import ItemRef
from vicode.model.design import Transition
from vicode.model.paths import describe_path


def test_users_are_guests_until_they_choose_a_name() -> None:
    users = UserDirectory()
    first, second = users.get_or_create_user("1"), users.get_or_create_user("2", "  Ana\n<b>  ")
    assert (first.name, second.name) == ("Guest 1", "Ana <b>")
    assert first.colour != second.colour
    assert users.get_or_create_user("1", "Ben") == users.get_or_create_user("1")
    assert len(users.get_or_create_user("3", "x" * 99).name) == 24
    assert users.get_or_create_user("2", "\x07").name == "Ana <b>"
    assert users.name_of("1") == "Ben"
    assert users.name_of(DISK_USER) == "another program"
    assert users.name_of("nobody") == "someone"


def test_two_guests_have_two_names() -> None:
    users = UserDirectory()
    for id_, name in (("1", ""), ("2", "Guest 3"), ("3", "")):
        users.get_or_create_user(id_, name)
    users.get_or_create_user("1", "Ada")
    users.get_or_create_user("4")
    names = [users.name_of(id_) for id_ in "1234"]
    assert names == ["Ada", "Guest 3", "Guest 2", "Guest 1"]
    for number in range(1200):
        users.get_or_create_user(f"many {number}")
    recent = [users.name_of(f"many {number}") for number in range(300, 1200)]
    assert len(set(recent)) == len(recent)


def test_presences_are_listed_and_changes_are_notified() -> None:
    users, room = UserDirectory(), PresenceRoom()
    counts: list[int] = []
    unsubscribe = room.changes.subscribe(lambda: counts.append(len(room.presences)))
    room.join("a", users.get_or_create_user("1", "Ana"))
    room.join("b", users.get_or_create_user("2", "Ben"))
    room.update("b", selected=(ItemRef(kind="states", id="Kick"),))
    room.update("b", selected=(ItemRef(kind="states", id="Kick"),))
    room.update("closed", pointer=(1.0, 2.0))
    assert counts == [1, 2, 2]
    assert [describe_presence(other) for other in room.others("a")] == ["state Kick"]
    room.update("b", editing_path=("states", "Kick", "doc"))
    assert room.names_editing(("states", "Kick", "doc"), "a") == ("Ben",)
    assert room.names_editing(("states", "Kick", "doc"), "b") == ()
    assert [describe_presence(other) for other in room.others("a")] == ["edits description of state Kick"]
    room.leave("b")
    assert room.others("a") == ()
    unsubscribe()
    room.leave("a")
    assert counts[-1] == 1


def test_paths_and_values_are_described() -> None:
    assert describe_path(()) == "the design"
    assert describe_path(("doc",)) == "description of the design"
    assert describe_path(("variables", "n", "type")) == "type of variable n"
    assert describe_path(("states", "Kick", "transitions", 1, "when")) == "transition 2 of state Kick, when"
    assert describe_path(("common", "transitions", 0)) == "transition 1 of the common section"
    assert describe_value(None) == "(removed)"
    assert describe_value("") == "(empty)"
    assert describe_value((10.0, 20.5)) == "10, 20.5"
    assert describe_value(Transition(to="Kick", doc="now")) == "to: Kick\ndoc: now"
    presence = Presence(
        window="a", user=UserDirectory().get_or_create_user("1"), selected=(ItemRef(kind="transitions", id="Kick/0"),)
    )
    assert describe_presence(presence) == "transition 1 of state Kick"


def test_typed_text_is_merged_with_edits_of_others() -> None:
    merge = FieldMerge()
    merge.set_shown("ball")
    assert merge.merge_typed("the ball", "ball") == "the ball"
    merge.record_sent("the ball", "the ball")
    assert merge.merge_typed("the red ball", "the ball rolls") == "the red ball rolls"
    merge.record_sent("the red ball", "the red ball")
    # Text of others stays in the design, although the field does not show it while its user types.
    assert merge.merge_typed("the red ball!", "the red ball rolls") == "the red ball! rolls"
    merge.record_sent("the red ball!", "the red ball!")
    assert merge.merge_typed("the red ball!!", "the red ball!") == "the red ball!!"


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 12), st.integers(0, 3)), max_size=20))
def test_concurrent_typing_loses_no_keystroke(presses: list[tuple[bool, int, int]]) -> None:
    """Each press: the user, the position, and the number of letters typed before they are sent."""
    design, shown, merges, left = (
        "ball",
        ["ball", "ball"],
        [FieldMerge(), FieldMerge()],
        ["ABCDEFGH" * 8, "01234567" * 8],
    )
    typed = ["", ""]
    for merge in merges:
        merge.set_shown(design)
    for user, position, count in [*presses, (False, 0, 1), (True, 0, 1)]:
        letters, left[user] = left[user][:count], left[user][count:]
        typed[user] += letters
        at = min(position, len(shown[user]))
        shown[user] = shown[user][:at] + letters + shown[user][at:]
        design = merges[user].merge_typed(shown[user], design)
        merges[user].record_sent(shown[user], shown[user])
    assert sorted(design) == sorted("ball" + "".join(typed))


@dataclass
class Window:
    """A field in a browser, its state on the server, and the messages in transit."""

    letters: str
    text: str = "ball"
    sent_text: str = "ball"
    base_number: int = 0
    sent_count: int = 0
    typed: str = ""
    to_server: list[tuple[str, str, int, int]] = field(default_factory=list)
    to_browser: list[tuple[str, int, int]] = field(default_factory=list)
    value: str = "ball"
    number: int = 0
    received_count: int = 0
    has_focus: bool = False
    shown: SentValues = field(default_factory=SentValues)

    def type(self, position: int, count: int) -> None:
        now, self.letters = self.letters[:count], self.letters[count:]
        at = min(position, len(self.text))
        self.text, self.typed = self.text[:at] + now + self.text[at:], self.typed + now
        self.to_server.append(("focus", "", 0, 0))

    def send(self) -> None:
        if self.text != self.sent_text:
            self.sent_count, self.sent_text = self.sent_count + 1, self.text
            self.to_server.append(("text", self.text, self.base_number, self.sent_count))

    def leave(self) -> None:
        self.send()
        self.to_server.append(("blur", "", 0, 0))

    def show(self) -> None:
        text, number, received_count = self.to_browser.pop(0)
        if received_count >= self.sent_count and self.text == self.sent_text:
            self.text, self.sent_text, self.base_number = text, text, number

    def refresh(self, design: str) -> None:
        if self.has_focus:
            return
        if self.value != design:
            self.value, self.number = design, self.number + 1
            self.to_browser.append((design, self.number, self.received_count))
        self.shown.record_shown(design, self.number)

    def receive(self, design: str) -> str:
        """Process the next message; returns the new design."""
        kind, text, base_number, sent_count = self.to_server.pop(0)
        self.has_focus = kind != "blur"
        if kind == "text":
            self.received_count = sent_count
            self.shown.select_base(base_number)
            if text != design:
                design = self.shown.field_merge.merge_typed(text, design)
            self.value = text
            self.shown.field_merge.record_sent(text, text)
        return design


class Server:
    """A text of a design that two windows show."""

    def __init__(self) -> None:
        self.design, self.windows = "ball", (Window("ABCDEFGH" * 20), Window("01234567" * 20))
        self.refresh_all()

    def refresh_all(self) -> None:
        for window in self.windows:
            window.refresh(self.design)

    def apply(self, window: Window, kind: str, position: int) -> None:
        """Apply an action of a user, or deliver a message."""
        match kind:
            case "type":
                window.type(position, 1 + position % 2)
            case "send":
                window.send()
            case "leave":
                window.leave()
            case "receive" if window.to_server:
                self.design = window.receive(self.design)
                self.refresh_all()
            case "show" if window.to_browser:
                window.show()


EVENTS = st.tuples(st.booleans(), st.sampled_from(["type", "send", "leave", "receive", "show"]), st.integers(0, 12))


@given(st.lists(EVENTS))
def test_a_slow_connection_loses_no_keystroke(events: list[tuple[bool, str, int]]) -> None:
    server = Server()
    for is_first, kind, position in events:
        server.apply(server.windows[is_first], kind, position)
    final_events = [(window, kind) for kind in ("leave", "receive", "show") for window in server.windows]
    for window, kind in final_events:
        for _ in range(3 * len(events) + 3):
            server.apply(window, kind, 0)
    assert sorted(server.design) == sorted("ball" + "".join(window.typed for window in server.windows))
    assert [window.text for window in server.windows] == [server.design, server.design]


def test_normalization_by_the_design_is_not_an_edit() -> None:
    merge = FieldMerge()
    merge.set_shown("")
    merge.record_sent("x=1\ny", "x = 1\ny = ")
    assert merge.merge_typed("x=1\ny=2", "x = 1\ny = ") == "x=1\ny=2"
    assert merge.merge_typed("x=1\ny=2", "x = 1\nz = 3\ny = ").replace(" ", "") == "x=1\nz=3\ny=2"


def test_choices_of_two_users_are_merged() -> None:
    merge = FieldMerge()
    merge.set_shown(["a", "b"])
    assert merge.merge_typed(["a", "c"], ["a", "b", "d"]) == ["a", "d", "c"]
    merge.record_sent(["a", "c"], ["a", "c"])
    assert merge.merge_typed(["a", "c", "e"], ["a", "d", "c"]) == ["a", "d", "c", "e"]
    assert merge.merge_typed(True, False) is True
