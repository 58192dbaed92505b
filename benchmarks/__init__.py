"""Benchmarks: ``python -m benchmarks [stages|growth|optimum] ...``; see :mod:`benchmarks.__main__`."""
