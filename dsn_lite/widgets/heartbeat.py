"""A sign of life: shows that the page draws widgets and that the kernel answers them."""

import platform

import anywidget
import traitlets

from .guard import hear_while_busy

SCRIPT = """
function render({ model, el }) {
  const say = (text, colour) => { el.textContent = text; el.style.color = colour; };
  el.setAttribute("role", "status");
  el.style.font = "19px sans-serif";
  say("The page draws widgets, waiting for the kernel ...", "#222222");
  const late = setTimeout(() => say(
    "The page draws widgets, the kernel does not answer. It may be busy with another cell; if this is not green once " +
    "that has ended, choose Kernel > Restart Kernel and run this cell again.", "#B00020"), 15000);
  model.on("change:answer", () => { clearTimeout(late); say(model.get("answer"), "#00664A"); });
  model.set("beat", model.get("beat") + 1);
  model.save_changes();
}
export default { render };
"""
NOTHING = (
    "If there is no green sentence below after ten seconds, or it reads 'Error displaying widget', reload this page in "
    "the browser; if that does not help, close JupyterLab and open the course with start.py, which repairs it."
)


class Heartbeat(anywidget.AnyWidget):
    """The page sends a beat when it draws this; the kernel answers with a sentence that the page shows."""

    _esm = SCRIPT
    beat = traitlets.Int(0).tag(sync=True)
    answer = traitlets.Unicode("").tag(sync=True)

    @traitlets.observe("beat")
    def _reply(self, change: dict) -> None:
        python = f"Python {platform.python_version()} on {platform.system()}"
        self.answer = f"Connected: the page draws widgets and the kernel answers ({python}, beat {change['new']})."


def heartbeat() -> Heartbeat:
    """A widget that turns green once page and kernel have talked; prints what to do where it does not."""
    print(NOTHING)
    beating = Heartbeat()
    hear_while_busy(beating)
    return beating
