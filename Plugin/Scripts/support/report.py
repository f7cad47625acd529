"""One self-contained HTML page: sections of text, tables and pictures."""

import base64
import html
import math
import os
import re
import struct

from . import command, outputs, painter

_MOST_ROWS_SHOWN = 12  # longer tables are folded
_NOTHING = 1e-12  # what rounding leaves of zero
_LONG = 32  # letters: such a cell is broken into lines
_LEAST_NM = 100  # channels whose numbers are all as large are named by their wavelengths
_WIDE = 1.7  # times the height: needs the whole width of the page
_WORDS = {"p95": "95th percentile", "left_out": "left out", "residual_rms": "residual rms", "condition": "condition number",
          "complete": "all unknowns determined", "OutOfRange": "excess over range",
          "UncertaintyRms": "standard uncertainty", "held_out_rms": "rms of held-out samples (1 = white)",
          "locality": "penalty on width", "smoothness": "penalty on roughness", "freedom": "effective coefficients per channel",
          "curve_square": "detector curve: square term", "curve_held_out_rms": "detector curve: rms of held-out samples (1 = white)",
          "curve_deviations": "detector curve: gain in standard deviations", "determined": "directions that the chart determines",
          "directions": "directions of the responsivity", "centroid": "mean wavelength (nm)", "dark_error": "standard error of dark",
          "rms_around_line": "rms around the line"}  # of the tables' columns and the maps
_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #1a1a1a; max-width: 62rem; margin: 2rem auto;
       padding: 0 1rem; }
h1 { font-size: 1.7rem; } h2 { font-size: 1.25rem; margin-top: 2.2rem; } h3 { font-size: 1.05rem; }
figure { margin: 1rem 0; } figcaption { color: #555; font-size: .9rem; }
img { max-width: 100%; height: auto; border: 1px solid #ddd; cursor: zoom-in; }
img.large { position: fixed; inset: 0; margin: auto; max-width: 98vw; max-height: 98vh; z-index: 1; cursor: zoom-out; }
.row { display: grid; grid-template-columns: repeat(auto-fit, minmax(28rem, 1fr)); gap: 1rem; }
.row .wide { grid-column: 1 / -1; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .92rem; }
th, td { padding: .25rem .7rem; text-align: right; border-bottom: 1px solid #e3e3e3; }
th:first-child, td:first-child { text-align: left; }
td.text, th.text { text-align: left; }
td { white-space: nowrap; } td.long { white-space: normal; min-width: 12rem; }
.scroll { overflow-x: auto; }
.lead { font-size: 1.2rem; } .warning { background: #fff3cd; border-left: 4px solid #e69f00; padding: .5rem .8rem; }
details summary { cursor: pointer; } figure a { display: block; }
footer { margin-top: 3rem; color: #777; font-size: .85rem; }
"""


def text(title, *paragraphs):
    return _section(title, "".join(f"<p>{html.escape(p)}</p>" for p in paragraphs))


def chapter(title, sections, lead=""):
    """Sections under one title; lead: what they are about."""
    words = f"<p>{html.escape(lead)}</p>" if lead else ""
    return _section(title, words + "".join(sections).replace("<h2>", "<h3>").replace("</h2>", "</h3>"))


def channels(names, peaks=None):
    """The channels of one camera in words, by name: C400 is 400 nm; C3 is channel 3, and beside it C150 is channel 150.
    peaks: by name, their wavelengths in nm where the names do not tell them."""
    numbers = {name: found[1] for name in names if (found := re.fullmatch(r"C(\d+(?:\.\d+)?)", name))}
    in_nm = all(float(number) >= _LEAST_NM for number in numbers.values())
    words = {name: name for name in names}
    for name, number in numbers.items():
        words[name] = f"{number} nm" if in_nm else f"channel {number}" + (f" ({peaks[name]:g} nm)" if peaks else "")
    return words


def in_words(name):
    """Of a column, a metric or an array: \u0394E00 for dE00."""
    return _WORDS.get(name, re.sub(r"\bdE(?=[0-9 ])", "\u0394E", name))


def _value_in_words(name, value):
    if name == "metric":
        return in_words(value)
    if name == "complete":
        return "yes" if value else "no"
    if name == "condition" and value == 0:
        return ""  # the method has none
    return value


def _column_in_words(name, values):
    known = channels([value for value in values if isinstance(value, str)]) if name == "channel" else {}
    return [known.get(value) or _value_in_words(name, value) for value in values]


def table(title, names, rows, columns=None, note=None, fold=True):
    """columns: the columns to show, in order; all by default. fold: long tables are opened by a click."""
    if not rows:
        return ""
    chosen = [names.index(name) for name in (columns or names)]
    head = "".join(f"<th{_class(rows[0][i])}>{html.escape(in_words(names[i]))}</th>" for i in chosen)
    told = zip(*(_column_in_words(names[i], [row[i] for row in rows]) for i in chosen))
    body = "".join("<tr>" + "".join(f"<td{_class(row[i])}>{_cell(value)}</td>" for i, value in zip(chosen, values))
                   + "</tr>" for row, values in zip(rows, told))
    remark = f"<p>{html.escape(note)}</p>" if note else ""
    content = f"<div class='scroll'><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>"
    if fold and len(rows) > _MOST_ROWS_SHOWN:
        content = f"<details><summary>{len(rows)} rows</summary>{content}</details>"
    return _section(title, remark + content)


def figures(title, names, rows, note=None):
    """The figures of one row, each in a line of its own: for tables of one row and many columns. A status in words stands above."""
    status = rows[0][names.index("status")] if rows and "status" in names else ""
    values = [_column_in_words(name, [value])[0] for name, value in zip(names, rows[0])] if rows else []
    lines = [[in_words(name), value if isinstance(value, str) else _cell(value)] for name, value in zip(names, values)]
    return table(title, ["figure", "value"], [line for line in lines if line[1] not in ("", status)],
                 note=" ".join(filter(None, (note, status and f"{status[:1].upper()}{status[1:]}."))))


def pictures(title, folder, captions):
    """captions: {file name: caption}; the pictures are put into the page."""
    if command.rank() != 0:
        return ""
    painter.finish()
    figures = ""
    for name, caption in captions.items():
        with open(os.path.join(folder, name), "rb") as file:
            content = file.read()
        data = base64.b64encode(content).decode("ascii")
        width, height = struct.unpack(">II", content[16:24])  # of a PNG
        wide = " class='wide'" if width > _WIDE * height else ""
        figures += (f"<figure{wide}><img alt='{html.escape(caption)}' src='data:image/png;base64,{data}' "
                    f"onclick='this.classList.toggle(\"large\")' title='Click to enlarge'><figcaption>{html.escape(caption)}</figcaption></figure>")
    layout = f"<div class='row'>{figures}</div>" if len(captions) > 1 else figures
    return _section(title, layout)


def write(folder, title, sections, lead="", warnings=()):
    """report.html in the folder: complete or absent. lead: the result in one sentence; warnings: what a reader must know
    before the result."""
    if command.rank() != 0:
        return
    page = (f"<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'>"
            f"<meta name='viewport' content='width=device-width'>{outputs.list_of_written()}"
            f"<title>{html.escape(title)}</title><style>{_STYLE}</style></head><body>"
            f"<h1>{html.escape(title)}</h1>"
            + (f"<p class='lead'>{html.escape(lead)}</p>" if lead else "")
            + "".join(f"<p class='warning'>{html.escape(warning)}</p>" for warning in warnings)
            + f"{''.join(sections)}"
            f"<footer>Written by Multispectral; the tables stand beside this page as CSV.</footer>"
            f"</body></html>")
    outputs.write_text(os.path.join(folder, "report.html"), page)


def _section(title, content):
    return f"<section><h2>{html.escape(title)}</h2>{content}</section>"


def _class(value):
    if not isinstance(value, str):
        return ""
    return " class='text long'" if len(value) > _LONG else " class='text'"


def _cell(value):
    if isinstance(value, float):
        if math.isnan(value):
            return ""
        if abs(value) < _NOTHING:
            return "0"
        return f"{value:.0f}" if value.is_integer() and abs(value) < 1e9 else f"{value:.4g}"
    return html.escape(str(value))
