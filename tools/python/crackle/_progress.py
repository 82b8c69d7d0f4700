# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows progress and notices: a line on a terminal, a bar in a notebook, nothing elsewhere."""
import html
import os
import sys

from ._errors import printable

_ROOM = " " * 4


def _in_notebook():
    """Whether IPython runs in a notebook; does not import IPython."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and type(shell).__name__ == "ZMQInteractiveShell"


def _tell_notice(text):
    if text.startswith("notice: "):
        print(printable(text), file=sys.stderr)


class _Line:
    """A line on stderr that is overwritten, and removed at the end."""

    def __call__(self, kind, text, share):
        if kind == "stage":
            self.close()
            _tell_notice(text)
            return
        if kind in ("work", "progress"):
            columns = os.get_terminal_size(sys.stderr.fileno()).columns if sys.stderr.isatty() else 0
            sys.stderr.write("\r\x1b[K" + printable(text)[:(columns or 80) - 1])  # 0 for a terminal without a size
            sys.stderr.flush()

    def close(self):
        sys.stderr.write("\r\x1b[K")
        sys.stderr.flush()


class _Bar:
    """A bar in a notebook's output that is removed at the end."""

    def __init__(self):
        from IPython.display import HTML, display

        self._html = HTML
        self._display = display(HTML(""), display_id=True)

    def __call__(self, kind, text, share):
        if kind == "stage":
            _tell_notice(text)
        if kind not in ("work", "progress"):
            return
        bar = f'<progress value="{share:.4f}" max="1" style="width:12em"></progress>{_ROOM}' if share == share else ""
        self._display.update(self._html(f'<div style="font-family:monospace">{bar}{html.escape(text)}</div>'))

    def close(self):
        self._display.update(self._html(""))


class reporting:
    """`with reporting(progress) as report:` gives the callable for the engine: the user's, a line, a bar, or None.

    progress: None shows progress on a terminal or in a notebook, False shows nothing, True shows it on stderr. A callable
    is called with (kind, text, share): kind "stage", "detail", "work" or "progress", share from 0 to 1 or nan.
    """

    def __init__(self, progress):
        self._progress = progress
        self._shown = None

    def __enter__(self):
        if callable(self._progress):
            return self._progress
        if self._progress is None and _in_notebook():
            self._shown = _Bar()
        elif self._progress or (self._progress is None and sys.stderr is not None and sys.stderr.isatty()):
            self._shown = _Line()
        return self._shown

    def __exit__(self, *_):
        if self._shown is not None:
            self._shown.close()
        return False
