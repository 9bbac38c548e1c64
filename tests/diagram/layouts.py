"""Layouts of single designs."""

from collections.abc import Collection

from vicode.diagram.layout import LayoutResult, LayoutService
from vicode.model.design import Design


def compute_layout(design: Design, *, only: Collection[str] | None = None, timeout_s: float = 60.0) -> LayoutResult:
    with LayoutService() as service:
        return service.compute(design, only=only, timeout_s=timeout_s)
