"""Accuracy over simulated and real surveys: ``python -m benchmarks.accuracy [--quick] [--only NAME]``."""
