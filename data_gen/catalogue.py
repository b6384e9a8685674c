"""All contact sheets in a folder: a picture and a page a family, a page that leads to them, and one picture of all."""

import html
import itertools
from pathlib import Path

from PIL import Image, ImageDraw
from plotly.offline import get_plotlyjs
from tqdm import tqdm

from data_gen.families import categories, families
from data_gen.families import family as rig_of
from data_gen.files import beside, check_folder
from data_gen.gallery import write_page
from data_gen.make import checked_seed
from data_gen.sheet import GREY, INK, PAPER, font, painted, sheet, window

COLUMNS, CELL, HEAD = 17, 84, 24
ROW = HEAD + CELL + 22
INDEX = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>Families</title>
<style>
body {{ font: 16px/1.5 Helvetica, Arial, sans-serif; color: #222; background: white; margin: 0 auto; max-width: 1200px;
  padding: 1em 1.5em 3em; }}
h1, h2 {{ font-weight: 500; }} nav {{ display: flex; flex-wrap: wrap; gap: 1em; }}
a {{ color: inherit; text-decoration: none; }} a:hover, a:focus {{ outline: 2px solid #0072b2; }}
img {{ display: block; width: 160px; }}
</style></head><body><h1>{count} families of shapes</h1>{rows}</body></html>
"""


def write_sheets(names, folder, seed=0):
    """Write picture, page and thumbnail of every family, index.html and overview.png to a folder, made if missing.

    Raises ValueError for an unknown family, a bad seed or a file in the folder's place, before anything is written.
    """
    for name in names:
        rig_of(name)
    folder, seed = Path(folder), checked_seed(seed, "sheet")
    check_folder(folder, "sheet")
    folder.mkdir(parents=True, exist_ok=True)
    for name in tqdm(names, desc="contact sheets", unit="family"):
        write_picture(name, folder / f"{file_name(name)}.png", seed)
        write_page(name, folder / f"{file_name(name)}.html", seed, alone=False)
        _save(_thumbnail(name, 2 * CELL), folder / f"{file_name(name)}_small.png")
    _save(overview(names), folder / "overview.png")
    for name, text in (("plotly.min.js", get_plotlyjs()), ("index.html", _index(names))):
        with beside(folder / name) as part:
            part.write_text(text, encoding="utf-8")


def write_picture(name, path, seed=0):
    """Write the contact sheet of a family as a PNG."""
    _save(sheet(name, seed), path)


def file_name(family):
    """A family's name as part of a file's name."""
    return family.replace("/", "_")


def overview(names):
    """One picture with the middle shape of every family, by category, a PIL image."""
    corners, rows = _laid_out([rig_of(name).category for name in names])
    whole = Image.new("RGB", (COLUMNS * CELL, rows * ROW), PAPER)
    draw, told = ImageDraw.Draw(whole), set()
    for name, (column, row) in zip(names, corners, strict=True):
        category, label = (word.replace("_", " ") for word in name.split("/"))
        x, y = column * CELL, row * ROW
        if category not in told:
            draw.text((x + 6, y), category, INK, font(17))
        told.add(category)
        whole.paste(_thumbnail(name, CELL), (x, y + HEAD))
        draw.text((x + (CELL - font(12).getlength(label)) / 2, y + HEAD + CELL), label, GREY, font(12))
    return whole


def _laid_out(categories):
    """Column and row of each family, a category in one row where it fits; and the number of rows."""
    found, column, row = [], 0, 0
    for count in (len(list(own)) for _, own in itertools.groupby(categories)):
        if column and column + count > COLUMNS:
            column, row = 0, row + 1
        found += [((column + i) % COLUMNS, row + (column + i) // COLUMNS) for i in range(count)]
        column, row = (column + count) % COLUMNS, row + (column + count) // COLUMNS
    return found, row + bool(column)


def _thumbnail(name, size):
    rig = rig_of(name)
    return painted(rig, rig.middle, size, window(rig, rig.middle), cut=False)[0]


def _index(names):
    rows = []
    for category in dict.fromkeys(rig_of(name).category for name in names):
        own = [name for name in names if rig_of(name).category == category]
        rows.append(f"<h2>{category}</h2><nav>{''.join(map(_link, own))}</nav>")
    return INDEX.format(count=len(names), rows="".join(rows))


def _link(name):
    label = html.escape(name.split("/")[1].replace("_", " "))
    return f'<a href="{file_name(name)}.html"><img src="{file_name(name)}_small.png" alt="">{label}</a>'


def _save(image, path):
    with beside(path) as part, part.open("wb") as file:
        image.save(file, "PNG", optimize=True)


def chosen(names):
    """Names of families, from names of families and categories; all where none is given."""
    given = names or categories()
    return tuple(dict.fromkeys(one for name in given for one in (families(name) if name in categories() else (name,))))
