"""Pictures in notebooks."""

from __future__ import annotations

import html

HEIGHT = 640  # px: the thing folded and the sheet, without scrolling, on a usual screen


def framed(page: str, title: str) -> str:
    """A page within a page, which can neither reach the notebook nor be changed by its styles."""
    return (f'<iframe title="{html.escape(title)}" sandbox="allow-scripts" width="100%" height="{HEIGHT}" '
            f'style="border: 0" srcdoc="{html.escape(page)}"></iframe>')
