"""Callbacks that are heard: their errors shown in one line under the widget, and their events while a cell runs."""

import logging
from collections.abc import Callable
from functools import wraps
from html import escape
from typing import Any

import ipywidgets

log = logging.getLogger(__name__)


class Notice(ipywidgets.HTML):
    """One line under a widget, read out by screen readers; empty while all is well."""

    def say(self, text: str) -> None:
        """Shows a sentence."""
        self.value = f"<div role='status' aria-live='polite'>{escape(text)}</div>"

    def warn(self, text: str) -> None:
        """Shows what went wrong."""
        self.value = f"<div role='alert' style='color:#B00020'>{escape(text)}</div>"

    def guard(self, callback: Callable[..., None]) -> Callable[..., None]:
        """The callback, whose errors are shown here; the last good picture stays."""

        @wraps(callback)
        def guarded(*arguments: Any) -> None:
            try:
                callback(*arguments)
            except Exception as error:
                self.warn(f"{type(error).__name__}: {str(error).splitlines()[0] if str(error) else 'no message'}")
                log.exception("in a widget's callback")
            else:
                self.value = ""

        return guarded


def hear_while_busy(widget: ipywidgets.Widget) -> None:
    """Lets a widget's events in while a cell runs, in a subshell, where kernel and page have them.

    From ipykernel 7.4 on, events go to the shell that wrote to the widget last, which is the busy one; without its note
    of that they go where the page sends them. Call it again after Python has changed the widget.
    """
    vars(widget.comm).pop("_reply_subshell_id", None)
