"""YAML that holds data and nothing else: no objects, no aliases that multiply, no nesting without end."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

MOST_BYTES = 1 << 20  # of settings, or of what describes a map: a larger file is something else


def read_yaml(path: Path) -> Any:
    """The data of a file. Raises OSError, and ValueError (one line) for what is no such data."""
    with path.open("rb") as handle:
        data = handle.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise ValueError(f"it is larger than {MOST_BYTES:,} bytes")
    return parse_yaml(data.decode("utf-8-sig"))


def parse_yaml(text: str) -> Any:
    """The data of ``text``; ValueError (one line) for what is none."""
    try:
        # Aliases of aliases are small in memory and endless as soon as anything prints or copies them.
        if any(isinstance(token, yaml.AliasToken) for token in yaml.scan(text)):
            raise ValueError("it refers to parts of itself (*name), which is refused")
        return yaml.safe_load(text)
    except RecursionError as error:
        raise ValueError("it is nested too deeply") from error
    except yaml.YAMLError as error:
        raise ValueError(str(error).splitlines()[0]) from error
