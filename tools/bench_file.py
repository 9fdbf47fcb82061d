"""Reads the JSON that `halfspace bench` wrote, and saves the pictures that are drawn of it."""

import argparse
import json
import pathlib
import sys

ENDINGS = (".png", ".svg")


def read_json(path, expected):
    """`expected`: name and version of the schema."""
    try:
        data = json.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        sys.exit(f"{path}: {error.strerror}")
    except ValueError as error:
        sys.exit(f"{path}: is not JSON: {error}")
    schema = (data.get("schema"), data.get("schema_version")) if isinstance(data, dict) else None
    if schema != expected:
        sys.exit(f"{path}: schema is {schema}; legal: {expected}")
    return data


def check_endings(images):
    for image in images:
        if image.suffix not in ENDINGS:
            sys.exit(f"{image}: extension is '{image.suffix}'; legal: {', '.join(ENDINGS)}")


def save(figure, images):
    """The same bytes every time."""
    import matplotlib  # who only reads needs none

    matplotlib.rcParams["svg.hashsalt"] = "halfspace"
    for image in images:
        image.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(image, metadata={"Date": None} if image.suffix == ".svg" else {"Software": None})


def plot(description, name, schema, draw):
    """What a script does that draws one file: `draw` makes a figure of the data in the file of that name."""
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("json", type=pathlib.Path, help=name)
    parser.add_argument("image", type=pathlib.Path, nargs="+", help="file to write, .png or .svg")
    options = parser.parse_args()
    check_endings(options.image)
    save(draw(read_json(options.json, schema)), options.image)
