"""Layers of the workbench."""
