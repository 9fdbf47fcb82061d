"""The page of the docs, and the HTML file that needs nothing else."""

import base64
import os
import pathlib

import jinja2

from methods import ROOT, command_line
from runs import records_of

TEMPLATES = pathlib.Path(__file__).with_name("templates")
KINDS = {".png": "image/png", ".svg": "image/svg+xml"}


def shown_command(method):
    """What the reader types; the rest of the path is the reader's."""
    options = f" {' '.join(records_of(method.command))} --time {method.passes} --out out/gallery/{method.id}"
    return command_line(method, options)


def parts(method):
    """The command in pieces that stay on a line: an option and its value."""
    words, *options = shown_command(method).split(" --")
    return [words, *(f"--{option}" for option in options)]


def count(value):
    return "-" if value is None else f"{value:,}"


def decimals(value, digits=2):
    return "-" if value is None else f"{value:,.{digits}f}"


def _inlined(folder):
    def data(name):
        path = folder / name
        return f"data:{KINDS[path.suffix]};base64,{base64.b64encode(path.read_bytes()).decode()}"

    return data


def _environment():
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=jinja2.select_autoescape(["html.jinja"]),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["count"] = count
    environment.filters["decimals"] = decimals
    environment.globals["command"] = shown_command
    environment.globals["parts"] = parts
    return environment


def title_of(group, method_id):
    return next(method.title for method in group.methods if method.id == method_id)


def write(groups, figures, images, page, html, processor):
    """figures: {method id: (Cost, Difference)}; images: the folder of pictures; page, html: the files to write."""
    environment = _environment()
    environment.globals["title_of"] = title_of
    known = {"groups": groups, "figures": figures, "processor": processor}
    to_docs = ROOT / "docs/guides"
    links = {group.id: _relative(group.page, to_docs) for group in groups}
    page.write_text(environment.get_template("gallery.md.jinja").render(**known, links=links))
    text = environment.get_template("gallery.html.jinja").render(**known, data=_inlined(images))
    html.write_text(text)


def _relative(page, folder):
    """A page of the tree as a link from docs/guides."""
    path, hash_mark, anchor = page.partition("#")
    return os.path.relpath(ROOT / path, folder) + hash_mark + anchor
