"""Documentation of a definition for hovers and completions, in Markdown with the signature first."""

from vicode.xabsl import tree
from vicode.xabsl.symbol_table import ENUM, KIND_NAMES, Definition

_FENCE = "```"


def signature(definition: Definition) -> str:
    """The declaration of a definition in one line."""
    type_name = _type(definition)
    match definition.role:
        case "option" | "behavior":
            return f"{definition.role} {definition.name}({_parameters(definition)})"
        case "parameter":
            return f"{type_name} {definition.name}{_details(definition)}"
        case "enum":
            return f"enum {definition.name} {{ {', '.join(definition.elements)} }}"
        case "element":
            return f"{definition.enum}.{definition.name}"
        case "const":
            assert isinstance(definition.node, tree.ConstantNode)
            unit = f' "{definition.node.unit}"' if definition.node.unit else ""
            return f"float const {definition.name} = {definition.node.number}{unit}"
        case "state":
            assert isinstance(definition.node, tree.StateNode)
            marks = ["initial"] * definition.node.is_initial + ["target"] * definition.node.is_target
            return " ".join([*marks, "state", definition.name])
        case "agent":
            assert isinstance(definition.node, tree.AgentNode)
            return f'agent {definition.name}("{definition.node.title}", {definition.node.root.text})'
    parameters = f"({_parameters(definition)})" if definition.parameters else ""
    return f"{type_name} {definition.role} {definition.name}{parameters}{_details(definition)}"


def hover_text(definition: Definition) -> str:
    """Signature, description and location of a definition. Descriptions are escaped: they are untrusted."""
    doc = getattr(definition.node, "doc", "")
    lines = [f"{_FENCE}xabsl", signature(definition).replace(_FENCE, ""), _FENCE]
    if doc:
        lines += ["", *(_escape_markdown(line) for line in doc.split("\n"))]
    location = definition.tokens.location(definition.name_node.first_token)
    return "\n".join([*lines, "", f"{_escape_markdown(location.file)}:{location.line}"])


def doc_comment(definition: Definition) -> str:
    return str(getattr(definition.node, "doc", ""))


def _escape_markdown(text: str) -> str:
    return "".join(f"\\{character}" if character in "\\`*_{}[]<>()#+!|~$" else character for character in text)


def _type(definition: Definition) -> str:
    return (
        f"enum {definition.enum}"
        if definition.kind == ENUM
        else KIND_NAMES.get(definition.kind, "").replace("decimal", "float")
    )


def _details(definition: Definition) -> str:
    node = definition.node
    if not isinstance(node, tree.SymbolNode | tree.ParameterNode):
        return ""
    return (f" [{node.range}]" if node.range else "") + (f' "{node.unit}"' if node.unit else "")


def _parameters(definition: Definition) -> str:
    return ", ".join(f"{_type(parameter)} {parameter.name}" for parameter in definition.parameters.values())
