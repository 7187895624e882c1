"""The interactive page of a plan or a comparison: inline in a notebook, in a browser elsewhere."""

from __future__ import annotations

import html
import tempfile
import webbrowser
from pathlib import Path
from typing import Any

from righting._progress import in_notebook
from righting._righting import Comparison, Plan


def show(shown: Plan | Comparison, height: int) -> Any:
    """The page as an output of a notebook; elsewhere it is opened in a browser, and its file is returned."""
    page = shown.page()
    if not in_notebook():
        with tempfile.NamedTemporaryFile("w", encoding="utf-8", suffix=".html", delete=False) as file:
            file.write(page)
        webbrowser.open(Path(file.name).as_uri())
        return Path(file.name)
    from IPython.display import HTML

    # The page is a document of its own, so it gets a frame of its own. IPython warns of an output that begins with one.
    frame = f'<iframe srcdoc="{html.escape(page)}" width="100%" height="{height}" style="border: 0"></iframe>'
    return HTML(f"<div>{frame}</div>")
