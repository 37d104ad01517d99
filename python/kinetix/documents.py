"""Files and dicts as the documents that the program reads."""

from __future__ import annotations

import json
import math
import os
from typing import Any, Mapping, Union

from .errors import InvalidInput

Source = Union[str, "os.PathLike[str]", Mapping[str, Any]]
"""A file's path, or a dict with the keys that such a file has (formats.md)."""


def _text(key: str, fault_text: str) -> InvalidInput:
    return InvalidInput(f"{key}: {fault_text}" if key else fault_text, fault_text, key=key)


def _number(value: float, key: str) -> str:
    if not math.isfinite(value):
        raise _text(key, f"is {value}; numbers must be finite")
    return repr(value)


def yaml_text(value: Any, key: str = "") -> str:
    """A value as YAML in one line. Tuples and arrays are lists, a ``Path`` is its text.

    :param key: where it stands, for messages
    :raises InvalidInput: for what no file can hold, such as ``None`` or NaN
    """
    if isinstance(value, Mapping):
        return "{" + ", ".join(_pair(name, inner, key) for name, inner in value.items()) + "}"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _number(float(value), key)
    if hasattr(value, "tolist"):
        return yaml_text(value.tolist(), key)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(yaml_text(inner, f"{key}[{k}]") for k, inner in enumerate(value)) + "]"
    raise _text(key, f"is {value!r}; give a number, a text, a truth value, a list or a dict")


def _pair(name: Any, value: Any, key: str) -> str:
    if not isinstance(name, str) or not name.replace("_", "").isalnum() or not name.isascii():
        raise _text(key, f"has the key {name!r}; keys are plain words")
    return f"{name}: {yaml_text(value, f'{key}.{name}' if key else name)}"
