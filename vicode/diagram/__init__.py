"""Pictures of designs: where things stand when the design does not say it."""

from vicode.diagram.placing import Placement, place

__all__ = ["Placement", "place"]
