"""Fields for hand-written code: one, or with several languages a tab for each."""

from dataclasses import replace

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.code_field import code_field
from vicode.editor.panels.fields import Attribute, FieldBinding, attribute_binding
from vicode.editor.panels.form import Form, Rows
from vicode.editor.session.forms.decision_form import CODE_HINTS
from vicode.editor.session.forms.fields import replace_text
from vicode.editor.session.item_paths import TrackedItem
from vicode.languages import LANGUAGES, language_title


def code_fields(form: Form, item: TrackedItem, name: str, label: str) -> None:
    """Build the fields of an attribute that is code.

    Args:
        form: The form.
        item: The owner of the code.
        name: The attribute.
        label: The label. With several languages, the others are named in the labels.
    """
    context = form.context

    def list_languages() -> tuple[str, ...]:
        code = getattr(item.get(), name, None) if item.path is not None else None
        written = [language for language, _text in code.texts] if code else []
        wanted = [language for language in context.workspace.project.languages if language in LANGUAGES]
        return tuple(dict.fromkeys([*wanted, *written])) or ("python",)

    def build(row: Form, languages: tuple[str, ...]) -> None:
        if len(languages) == 1:
            build_field(row, languages[0])
            return
        shown = context.code_language if context.code_language in languages else languages[0]

        def show(language: str) -> None:
            nonlocal shown
            shown = context.code_language = language
            fields.refresh()

        with ui.tabs() as tabs:
            tabs.props("dense no-caps align=left").classes("code-tabs")
            tabs.props["aria-label"] = texts.code_languages(label)
            for language in languages:
                ui.tab(language, language_title(language))
        tabs.set_value(shown)
        fields = Rows(row, lambda: [shown], build_field)
        tabs.on_value_change(lambda event: show(str(event.value)))

    def build_field(row: Form, language: str) -> None:
        code_field(row, _binding(item, name, label, language), language)

    Rows(form, lambda: [list_languages()], build)


def _binding(item: TrackedItem, name: str, label: str, language: str) -> FieldBinding:
    title = language_title(language)
    attribute = Attribute(
        label=label if language == "python" else f"{label} in {title}",
        name=name,
        format=lambda code: (code.in_language(language) if code else "") or "",
        parse=lambda text: replace_text(getattr(item.get(), name), language, text),
    )
    return replace(attribute_binding(item, attribute), hint=CODE_HINTS.get(language, ""))
