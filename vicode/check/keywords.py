"""Keywords of the target languages."""

import keyword

_CPP = """
alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t class compl const
constexpr const_cast continue decltype default delete do double dynamic_cast else enum explicit export extern false
float for friend goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private
protected public register reinterpret_cast return short signed sizeof static static_assert static_cast struct switch
template this thread_local throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t
while xor xor_eq
"""

# The keywords of the XABSL compiler. Its manual also shows "enumeration", which is not a keyword.
_XABSL = """
true false option action initial target state common decision goto stay if else state_time option_time action_done
agent function enum input output internal bool float const namespace behavior include capacity synchronized conflict
"""

KEYWORDS = {
    "python": frozenset(keyword.kwlist),
    "cpp": frozenset(_CPP.split()),
    "xabsl": frozenset(_XABSL.split()),
}
"""Keywords by language; C++ as of C++17 with its alternative tokens."""

LANGUAGE_TITLES = {"python": "Python", "cpp": "C++", "xabsl": "XABSL"}
"""Display names of the languages."""
