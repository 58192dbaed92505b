"""Correction of a drifting trajectory: simultaneous localization and layout model selection (SL-LMS)."""

from floorplan_core.drift.correction import corrected

__all__ = ["corrected"]
