"""How a solve is getting on, for someone who waits: one line that keeps changing."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

from righting._righting import Iteration

# What takes less is not shown unless asked for.
SHOWN_AFTER_S = 1.0
SHOWN_EVERY_S = 0.1


class Line:
    """One line: in a notebook an output that is updated, elsewhere a line of stderr."""

    def __init__(self) -> None:
        self._output: Any = None
        self._width = 0

    def show(self, text: str) -> None:
        if in_notebook():
            self._show_in_notebook(text)
        else:
            print("\r" + text.ljust(self._width), end="", file=sys.stderr, flush=True)
        self._width = max(self._width, len(text))

    def close(self) -> None:
        """Removes it, if it was shown."""
        if self._output is not None:
            self._show_in_notebook("")
        elif self._width > 0:
            print("\r" + " " * self._width + "\r", end="", file=sys.stderr, flush=True)

    def _show_in_notebook(self, text: str) -> None:
        from IPython.display import display

        bundle = {"text/plain": text}
        if self._output is None:
            self._output = display(bundle, raw=True, display_id=True)
        else:
            self._output.update(bundle, raw=True)


def shown(stack: ExitStack, progress: bool | None) -> Callable[[Iteration], None] | None:
    """What shows iterations until the stack is closed; None where nobody watches, or nothing shall be shown."""
    if progress is None and not is_watched() or progress is False:
        return None
    line = Line()
    stack.callback(line.close)
    show_next = time.monotonic() + (0.0 if progress else SHOWN_AFTER_S)

    def show(iteration: Iteration) -> None:
        nonlocal show_next
        now = time.monotonic()
        if now >= show_next:
            show_next = now + SHOWN_EVERY_S
            line.show(
                f"iteration {iteration.iteration:>4}  objective {iteration.objective:12.5e}  "
                f"infeasibility {iteration.primal_infeasibility:8.1e}"
            )

    return show


def both(
    first: Callable[[Iteration], object] | None, second: Callable[[Iteration], object] | None
) -> Callable[[Iteration], object] | None:
    """What calls both, where there are both."""
    if first is None or second is None:
        return first or second

    def called(iteration: Iteration) -> None:
        first(iteration)
        second(iteration)

    return called


def is_watched() -> bool:
    """Whether someone sees what is shown."""
    return in_notebook() or (sys.stderr is not None and sys.stderr.isatty())


def in_notebook() -> bool:
    """Whether this is the kernel of a notebook."""
    if "IPython" not in sys.modules:
        return False
    from IPython import get_ipython

    return hasattr(get_ipython(), "kernel")
