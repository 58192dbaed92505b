"""Viewports of the workbench."""
