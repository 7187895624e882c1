"""Dictionaries of Python as the text of a file."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any


def text(mapping: Mapping[str, Any]) -> str:
    """The JSON of a mapping, whose values may be arrays and numbers of NumPy, paths, mappings and objects with
    ``to_dict``."""
    return json.dumps(mapping, default=_plain)


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    for method in ("to_dict", "tolist"):
        if hasattr(value, method):
            return getattr(value, method)()
    raise TypeError(f"{value!r} cannot stand in a file: expected numbers, text, lists, arrays or dictionaries")
