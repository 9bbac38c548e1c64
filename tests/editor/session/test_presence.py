"""People have names and colours; a company knows what each window is at; keystrokes of two people come together."""

from dataclasses import dataclass, field

from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session import DISK_USER, Presence, PresenceRoom, UserDirectory
from vicode.editor.session.descriptions import describe_path, describe_presence, describe_value
from vicode.editor.session.field_merge import FieldMerge, SentValues
from vicode.editor.view import ItemRef
from vicode.model.design import Transition


def test_people_are_guests_until_they_choose_a_name() -> None:
    people = UserDirectory()
    first, second = people.get_or_create_user("1"), people.get_or_create_user("2", "  Ana\n<b>  ")
    assert (first.name, second.name) == ("Guest 1", "Ana <b>")
    assert first.colour != second.colour
    assert people.get_or_create_user("1", "Ben") == people.get_or_create_user("1")
    assert len(people.get_or_create_user("3", "x" * 99).name) == 24
    assert people.get_or_create_user("2", "\x07").name == "Ana <b>"
    assert people.name_of("1") == "Ben"
    assert people.name_of(DISK_USER) == "another program"
    assert people.name_of("nobody") == "someone"


def test_a_company_knows_who_is_here_and_tells_changes() -> None:
    people, company = UserDirectory(), PresenceRoom()
    heard: list[int] = []
    unwatch = company.subscribe(lambda: heard.append(len(company.presences)))
    company.join("a", people.get_or_create_user("1", "Ana"))
    company.join("b", people.get_or_create_user("2", "Ben"))
    company.update("b", selected=(ItemRef(kind="states", id="Kick"),))
    company.update("b", selected=(ItemRef(kind="states", id="Kick"),))
    company.update("gone", pointer=(1.0, 2.0))
    assert heard == [1, 2, 2]
    assert [describe_presence(other) for other in company.others("a")] == ["state Kick"]
    company.update("b", editing_path=("states", "Kick", "doc"))
    assert company.names_editing(("states", "Kick", "doc"), "a") == ("Ben",)
    assert company.names_editing(("states", "Kick", "doc"), "b") == ()
    assert [describe_presence(other) for other in company.others("a")] == ["edits doc of state Kick"]
    company.leave("b")
    assert company.others("a") == ()
    unwatch()
    company.leave("a")
    assert heard[-1] == 1


def test_paths_and_values_are_said_in_words() -> None:
    assert describe_path(()) == "the design"
    assert describe_path(("doc",)) == "doc of the design"
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


def test_what_is_typed_meets_what_others_typed() -> None:
    keys = FieldMerge()
    keys.set_shown("ball")
    assert keys.merge_typed("the ball", "ball") == "the ball"
    keys.record_sent("the ball", "the ball")
    assert keys.merge_typed("the red ball", "the ball rolls") == "the red ball rolls"
    keys.record_sent("the red ball", "the red ball")
    # What they typed stays in the design, though it is not shown to who types on.
    assert keys.merge_typed("the red ball!", "the red ball rolls") == "the red ball! rolls"
    keys.record_sent("the red ball!", "the red ball!")
    assert keys.merge_typed("the red ball!!", "the red ball!") == "the red ball!!"


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 12), st.integers(0, 3)), max_size=20))
def test_whoever_types_and_rests_no_keystroke_is_lost(presses: list[tuple[bool, int, int]]) -> None:
    """Each press: who, where, and how many letters come before the next is sent."""
    design, shown, keys, left = "ball", ["ball", "ball"], [FieldMerge(), FieldMerge()], ["ABCDEFGH" * 8, "01234567" * 8]
    typed = ["", ""]
    for each in keys:
        each.set_shown(design)
    for who, where, count in [*presses, (False, 0, 1), (True, 0, 1)]:
        letters, left[who] = left[who][:count], left[who][count:]
        typed[who] += letters
        at = min(where, len(shown[who]))
        shown[who] = shown[who][:at] + letters + shown[who][at:]
        design = keys[who].merge_typed(shown[who], design)
        keys[who].record_sent(shown[who], shown[who])
    assert sorted(design) == sorted("ball" + "".join(typed))


@dataclass
class Window:
    """A field in a browser, what the server knows of it, and what is on the way between them."""

    letters: str
    text: str = "ball"
    plain: str = "ball"
    on: int = 0
    told: int = 0
    typed: str = ""
    up: list[tuple[str, str, int, int]] = field(default_factory=list)
    down: list[tuple[str, int, int]] = field(default_factory=list)
    value: str = "ball"
    number: int = 0
    heard: int = 0
    has_focus: bool = False
    shown: SentValues = field(default_factory=SentValues)

    def type(self, where: int, count: int) -> None:
        now, self.letters = self.letters[:count], self.letters[count:]
        at = min(where, len(self.text))
        self.text, self.typed = self.text[:at] + now + self.text[at:], self.typed + now
        self.up.append(("focus", "", 0, 0))

    def tell(self) -> None:
        if self.text != self.plain:
            self.told, self.plain = self.told + 1, self.text
            self.up.append(("text", self.text, self.on, self.told))

    def leave(self) -> None:
        self.tell()
        self.up.append(("blur", "", 0, 0))

    def show(self) -> None:
        text, number, heard = self.down.pop(0)
        if heard >= self.told and self.text == self.plain:
            self.text, self.plain, self.on = text, text, number

    def refresh(self, design: str) -> None:
        if self.has_focus:
            return
        if self.value != design:
            self.value, self.number = design, self.number + 1
            self.down.append((design, self.number, self.heard))
        self.shown.record_shown(design, self.number)

    def hear(self, design: str) -> str:
        """The design after the next message."""
        what, text, on, told = self.up.pop(0)
        self.has_focus = what != "blur"
        if what == "text":
            self.heard = told
            self.shown.select_base(on)
            if text != design:
                design = self.shown.field_merge.merge_typed(text, design)
            self.value = text
            self.shown.field_merge.record_sent(text, text)
        return design


class Server:
    """A text of a design that two windows show."""

    def __init__(self) -> None:
        self.design, self.windows = "ball", (Window("ABCDEFGH" * 20), Window("01234567" * 20))
        self.tell_all()

    def tell_all(self) -> None:
        for window in self.windows:
            window.refresh(self.design)

    def happen(self, window: Window, what: str, where: int) -> None:
        """Somebody does something, or a message arrives."""
        match what:
            case "type":
                window.type(where, 1 + where % 2)
            case "tell":
                window.tell()
            case "leave":
                window.leave()
            case "hear" if window.up:
                self.design = window.hear(self.design)
                self.tell_all()
            case "show" if window.down:
                window.show()


WHAT_HAPPENS = st.tuples(st.booleans(), st.sampled_from(["type", "tell", "leave", "hear", "show"]), st.integers(0, 12))


@given(st.lists(WHAT_HAPPENS))
def test_however_slow_the_line_no_keystroke_is_lost(happenings: list[tuple[bool, str, int]]) -> None:
    server = Server()
    for is_first, what, where in happenings:
        server.happen(server.windows[is_first], what, where)
    at_last = [(window, what) for what in ("leave", "hear", "show") for window in server.windows]
    for window, what in at_last:
        for _ in range(3 * len(happenings) + 3):
            server.happen(window, what, 0)
    assert sorted(server.design) == sorted("ball" + "".join(window.typed for window in server.windows))
    assert [window.text for window in server.windows] == [server.design, server.design]


def test_a_spelling_of_the_design_is_nobodys_change() -> None:
    keys = FieldMerge()
    keys.set_shown("")
    keys.record_sent("x=1\ny", "x = 1\ny = ")
    assert keys.merge_typed("x=1\ny=2", "x = 1\ny = ") == "x=1\ny=2"
    assert keys.merge_typed("x=1\ny=2", "x = 1\nz = 3\ny = ").replace(" ", "") == "x=1\nz=3\ny=2"


def test_choices_of_two_people_come_together() -> None:
    keys = FieldMerge()
    keys.set_shown(["a", "b"])
    assert keys.merge_typed(["a", "c"], ["a", "b", "d"]) == ["a", "d", "c"]
    keys.record_sent(["a", "c"], ["a", "c"])
    assert keys.merge_typed(["a", "c", "e"], ["a", "d", "c"]) == ["a", "d", "c", "e"]
    assert keys.merge_typed(True, False) is True
