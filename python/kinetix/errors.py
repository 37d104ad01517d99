"""The one exception for bad input."""

from __future__ import annotations

from typing import Tuple, Type


class InvalidInput(ValueError):
    """A file, a dict or an argument that cannot be used.

    Its text reads ``file:line:column: key.path: what is wrong, what is allowed``, as the program prints it. Unknown
    parts are left out, such as the lines of a dict.
    """

    reason: str
    """The text without the place."""
    file: str
    """Path as the caller gave it; empty if there is none."""
    line: int
    """From 1; 0 if it is not known."""
    column: int
    """From 1; 0 if it is not known."""
    key: str
    """Dotted path, such as ``variables.beta.range_deg``; empty outside a document."""

    def __init__(self, message: str, reason: str = "", file: str = "", line: int = 0, column: int = 0,
                 key: str = "") -> None:
        super().__init__(message)
        self.reason = reason or message
        self.file, self.line, self.column, self.key = file, line, column, key

    def __reduce__(self) -> Tuple[Type[InvalidInput], Tuple[str, str, str, int, int, str]]:
        return (InvalidInput, (str(self), self.reason, self.file, self.line, self.column, self.key))
