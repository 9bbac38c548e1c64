"""People have names and colours; a company knows what each window is at; keystrokes of two people come together."""

from dataclasses import dataclass, field

from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session import DISK, Company, People, Presence
from vicode.editor.session.keystrokes import Keystrokes, Shown
from vicode.editor.session.wording import words_of_path, words_of_presence, words_of_value
from vicode.editor.view import Selected
from vicode.model.design import Transition


def test_people_are_guests_until_they_choose_a_name() -> None:
    people = People()
    first, second = people.greet("1"), people.greet("2", "  Ana\n<b>  ")
    assert (first.name, second.name) == ("Guest 1", "Ana <b>")
    assert first.colour != second.colour
    assert people.greet("1", "Ben") == people.greet("1")
    assert len(people.greet("3", "x" * 99).name) == 24
    assert people.greet("2", "\x07").name == "Ana <b>"
    assert people.name_of("1") == "Ben"
    assert people.name_of(DISK) == "another program"
    assert people.name_of("nobody") == "somebody"


def test_a_company_knows_who_is_here_and_tells_changes() -> None:
    people, company = People(), Company()
    heard: list[int] = []
    unwatch = company.watch(lambda: heard.append(len(company.all)))
    company.enter("a", people.greet("1", "Ana"))
    company.enter("b", people.greet("2", "Ben"))
    company.turn("b", selected=(Selected(of="states", id="Kick"),))
    company.turn("b", selected=(Selected(of="states", id="Kick"),))
    company.turn("gone", pointer=(1.0, 2.0))
    assert heard == [1, 2, 2]
    assert [words_of_presence(each) for each in company.others("a")] == ["state Kick"]
    company.turn("b", typing_in=("states", "Kick", "doc"))
    assert company.typing_at(("states", "Kick", "doc"), "a") == ("Ben",)
    assert company.typing_at(("states", "Kick", "doc"), "b") == ()
    assert [words_of_presence(each) for each in company.others("a")] == ["types doc of state Kick"]
    company.leave("b")
    assert company.others("a") == ()
    unwatch()
    company.leave("a")
    assert heard[-1] == 1


def test_paths_and_values_are_said_in_words() -> None:
    assert words_of_path(()) == "the design"
    assert words_of_path(("doc",)) == "doc of the design"
    assert words_of_path(("variables", "n", "type")) == "type of variable n"
    assert words_of_path(("states", "Kick", "transitions", 1, "when")) == "transition 2 of state Kick, when"
    assert words_of_path(("common", "transitions", 0)) == "transition 1 of the common ones"
    assert words_of_value(None) == "(removed)"
    assert words_of_value("") == "(empty)"
    assert words_of_value((10.0, 20.5)) == "10, 20.5"
    assert words_of_value(Transition(to="Kick", doc="now")) == "to: Kick\ndoc: now"
    presence = Presence(window="a", person=People().greet("1"), selected=(Selected(of="transitions", id="Kick/0"),))
    assert words_of_presence(presence) == "transition 1 of state Kick"


def test_what_is_typed_meets_what_others_typed() -> None:
    keys = Keystrokes()
    keys.show("ball")
    assert keys.bring_in("the ball", "ball") == "the ball"
    keys.sent("the ball", "the ball")
    assert keys.bring_in("the red ball", "the ball rolls") == "the red ball rolls"
    keys.sent("the red ball", "the red ball")
    # What they typed stays in the design, though it is not shown to who types on.
    assert keys.bring_in("the red ball!", "the red ball rolls") == "the red ball! rolls"
    keys.sent("the red ball!", "the red ball!")
    assert keys.bring_in("the red ball!!", "the red ball!") == "the red ball!!"


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 12), st.integers(0, 3)), max_size=20))
def test_whoever_types_and_rests_no_keystroke_is_lost(presses: list[tuple[bool, int, int]]) -> None:
    """Each press: who, where, and how many letters come before the next is sent."""
    design, shown, keys, left = "ball", ["ball", "ball"], [Keystrokes(), Keystrokes()], ["ABCDEFGH" * 8, "01234567" * 8]
    typed = ["", ""]
    for each in keys:
        each.show(design)
    for who, where, count in [*presses, (False, 0, 1), (True, 0, 1)]:
        letters, left[who] = left[who][:count], left[who][count:]
        typed[who] += letters
        at = min(where, len(shown[who]))
        shown[who] = shown[who][:at] + letters + shown[who][at:]
        design = keys[who].bring_in(shown[who], design)
        keys[who].sent(shown[who], shown[who])
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
    shown: Shown = field(default_factory=Shown)

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
        self.shown.show(design, self.number)

    def hear(self, design: str) -> str:
        """The design after the next message."""
        what, text, on, told = self.up.pop(0)
        self.has_focus = what != "blur"
        if what == "text":
            self.heard = told
            self.shown.typed_on(on)
            if text != design:
                design = self.shown.keystrokes.bring_in(text, design)
            self.value = text
            self.shown.keystrokes.sent(text, text)
        return design


class Server:
    """A text of a design that two windows show."""

    def __init__(self) -> None:
        self.design, self.windows = "ball", (Window("ABCDEFGH" * 20), Window("01234567" * 20))
        self.tell_all()

    def tell_all(self) -> None:
        for each in self.windows:
            each.refresh(self.design)

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
    assert sorted(server.design) == sorted("ball" + "".join(each.typed for each in server.windows))
    assert [each.text for each in server.windows] == [server.design, server.design]


def test_a_spelling_of_the_design_is_nobodys_change() -> None:
    keys = Keystrokes()
    keys.show("")
    keys.sent("x=1\ny", "x = 1\ny = ")
    assert keys.bring_in("x=1\ny=2", "x = 1\ny = ") == "x=1\ny=2"
    assert keys.bring_in("x=1\ny=2", "x = 1\nz = 3\ny = ").replace(" ", "") == "x=1\nz=3\ny=2"


def test_choices_of_two_people_come_together() -> None:
    keys = Keystrokes()
    keys.show(["a", "b"])
    assert keys.bring_in(["a", "c"], ["a", "b", "d"]) == ["a", "d", "c"]
    keys.sent(["a", "c"], ["a", "c"])
    assert keys.bring_in(["a", "c", "e"], ["a", "d", "c"]) == ["a", "d", "c", "e"]
    assert keys.bring_in(True, False) is True
