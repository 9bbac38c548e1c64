"""Documentation of a definition for hovers and completions, in Markdown with the signature first."""

from vicode.xabsl import tree
from vicode.xabsl.symbol_table import ENUM, KIND_NAMES, Definition

_FENCE = "```"


def signature(declared: Definition) -> str:
    """The declaration of a definition in one line."""
    of = _type(declared)
    match declared.role:
        case "option" | "behavior":
            return f"{declared.role} {declared.name}({_parameters(declared)})"
        case "parameter":
            return f"{of} {declared.name}{_details(declared)}"
        case "enum":
            return f"enum {declared.name} {{ {', '.join(declared.elements)} }}"
        case "element":
            return f"{declared.enum}.{declared.name}"
        case "const":
            assert isinstance(declared.node, tree.ConstantNode)
            unit = f' "{declared.node.unit}"' if declared.node.unit else ""
            return f"float const {declared.name} = {declared.node.number}{unit}"
        case "state":
            assert isinstance(declared.node, tree.StateNode)
            marks = ["initial"] * declared.node.is_initial + ["target"] * declared.node.is_target
            return " ".join([*marks, "state", declared.name])
        case "agent":
            assert isinstance(declared.node, tree.AgentNode)
            return f'agent {declared.name}("{declared.node.title}", {declared.node.root.text})'
    parameters = f"({_parameters(declared)})" if declared.parameters else ""
    return f"{of} {declared.role} {declared.name}{parameters}{_details(declared)}"


def hover_text(declared: Definition) -> str:
    """Signature, description and location of a definition. Descriptions are escaped: they are untrusted."""
    doc = getattr(declared.node, "doc", "")
    lines = [f"{_FENCE}xabsl", signature(declared).replace(_FENCE, ""), _FENCE]
    if doc:
        lines += ["", *(_escape_markdown(line) for line in doc.split("\n"))]
    place = declared.tokens.location(declared.name_node.first_token)
    return "\n".join([*lines, "", f"{_escape_markdown(place.file)}:{place.line}"])


def doc_comment(declared: Definition) -> str:
    """The description of a definition."""
    return str(getattr(declared.node, "doc", ""))


def _escape_markdown(text: str) -> str:
    return "".join(f"\\{each}" if each in "\\`*_{}[]<>()#+!|~$" else each for each in text)


def _type(declared: Definition) -> str:
    return (
        f"enum {declared.enum}"
        if declared.kind == ENUM
        else KIND_NAMES.get(declared.kind, "").replace("decimal", "float")
    )


def _details(declared: Definition) -> str:
    node = declared.node
    if not isinstance(node, tree.SymbolNode | tree.ParameterNode):
        return ""
    return (f" [{node.range}]" if node.range else "") + (f' "{node.unit}"' if node.unit else "")


def _parameters(declared: Definition) -> str:
    return ", ".join(f"{_type(each)} {each.name}" for each in declared.parameters.values())
