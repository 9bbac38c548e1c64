"""Names of designs in JavaScript."""

_RESERVED_NAMES = """
arguments await bica break case catch class const continue debugger declarations default delete do else enum eval
export extends false finally for function if implements import in instanceof interface let new null package private
protected public return static super switch this throw true try typeof var void while with yield __proto__
constructor undefined NaN Infinity Object
"""
_RESERVED = frozenset(_RESERVED_NAMES.split())


def escape(name: str) -> str:
    """Return a name that is neither reserved nor used by the generated module."""
    return f"{name}_" if {name, name.rstrip("_")} & _RESERVED else name
