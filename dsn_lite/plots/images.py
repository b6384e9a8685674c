"""Pictures that are painted, not plotted."""

from base64 import b64encode
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING

from IPython.display import HTML

if TYPE_CHECKING:
    import PIL.Image


def picture(image: "PIL.Image.Image", said: str) -> HTML:
    """A picture as notebooks show it, with a sentence for those who do not see it."""
    stream = BytesIO()
    image.save(stream, "PNG")
    data = b64encode(stream.getvalue()).decode()
    # not IPython's Image, whose alternative text JupyterLab drops
    return HTML(f'<img src="data:image/png;base64,{data}" alt="{escape(said)}" style="max-width: 100%">')
