"""Readers: from a file or folder to a :class:`~floorplan_core.model.Reconstruction`."""

from floorplan_core.readers.opening import builtin_readers, open_survey

__all__ = ["builtin_readers", "open_survey"]
