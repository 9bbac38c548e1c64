"""The languages of code in designs and of generated files: one record each."""

import keyword
from dataclasses import KW_ONLY, dataclass
from typing import Literal

_CPP = """
alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t class compl const
constexpr const_cast continue decltype default delete do double dynamic_cast else enum explicit export extern false
float for friend goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private
protected public register reinterpret_cast return short signed sizeof static static_assert static_cast struct switch
template this thread_local throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t
while xor xor_eq
"""

# `function` is reserved and has no meaning; "enumeration", which the manual shows, is no keyword.
_XABSL = """
true false option action initial target state common decision goto stay if else state_time option_time action_done
agent function enum input output internal bool float const namespace behavior include capacity synchronized conflict
"""


@dataclass(frozen=True, slots=True)
class Language:
    """A language; code blocks in Markdown have the info string `fence`, `comment` is a regular expression."""

    name: str
    title: str
    keywords: frozenset[str]
    _: KW_ONLY
    editor_mode: Literal["Python", "C++", "C", "JavaScript"]
    fence: str = ""
    comment: str = r"//.*|/\*(?s:.*?)\*/"
    is_generated: bool = False


_PYTHON = frozenset(keyword.kwlist)
_LANGUAGES = (
    Language("python", "Python", _PYTHON, editor_mode="Python", fence="python", comment=r"#.*", is_generated=True),
    # C++17 with its alternative tokens.
    Language("cpp", "C++", frozenset(_CPP.split()), editor_mode="C++", fence="cpp", is_generated=True),
    Language("xabsl", "XABSL", frozenset(_XABSL.split()), editor_mode="C", is_generated=True),
    # The generator renames reserved words.
    Language("javascript", "JavaScript", frozenset(), editor_mode="JavaScript", is_generated=True),
)
LANGUAGES = {each.name: each for each in _LANGUAGES}
"""The languages by name; code in a design may be written in each of them."""

GENERATED_LANGUAGES = tuple(each.name for each in LANGUAGES.values() if each.is_generated)


def language_title(name: str) -> str:
    """The title of a language; an unknown one keeps its name."""
    return LANGUAGES[name].title if name in LANGUAGES else name
