"""What the functions of this package raise.

Every exception has ``hint``: what may help, or None where the message says it all.
"""

from __future__ import annotations

__all__ = [
    "FileError",
    "ImpossibleError",
    "InputError",
    "NoPlanError",
    "NotReadyError",
    "RightingError",
    "VerificationError",
]


class RightingError(Exception):
    """Anything that this package raises of its own."""

    def __init__(self, message: str, *, hint: str | None = None) -> None:
        super().__init__(message)
        self.hint = hint
        if hint is not None:
            self.add_note(f"hint: {hint}")


class InputError(RightingError, ValueError):
    """An input is wrong.

    ``field`` is the JSON path of the field, such as ``links[3].mass_kg``, or the name of the argument; ``file`` is
    where it stands (``scenario`` or ``system`` for a dictionary). ``found`` and ``expected`` say what stands there
    and what should, where that can be said.
    """

    def __init__(
        self,
        message: str,
        *,
        file: str | None = None,
        field: str | None = None,
        found: str | None = None,
        expected: str | None = None,
        hint: str | None = None,
    ) -> None:
        super().__init__(message, hint=hint)
        self.file = file
        self.field = field
        self.found = found
        self.expected = expected


class FileError(RightingError, OSError):
    """A file, ``file``, cannot be read or written."""

    def __init__(self, message: str, *, file: str | None = None, hint: str | None = None) -> None:
        super().__init__(message, hint=hint)
        self.file = file


class ImpossibleError(RightingError):
    """No motion of the arm makes the maneuver: that follows from mechanics, and nothing was solved."""


class NoPlanError(RightingError):
    """The optimizer ended without a plan. ``status`` says how, where it began at all."""

    def __init__(self, message: str, *, status: str | None = None, hint: str | None = None) -> None:
        super().__init__(message, hint=hint)
        self.status = status


class VerificationError(RightingError):
    """A plan does not do what it claims. ``check`` is the name of the first check that failed."""

    def __init__(self, message: str, *, check: str | None = None, hint: str | None = None) -> None:
        super().__init__(message, hint=hint)
        self.check = check


class NotReadyError(RightingError, RuntimeError):
    """There is no optimizer, or this is no place to solve: a callback of a solve, or a forked process."""
