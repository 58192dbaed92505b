"""Correction of a drifting trajectory: simultaneous localization and layout model selection (SL-LMS)."""

from floorplan_core.drift.correction import as_configured, corrected

__all__ = ["as_configured", "corrected"]
