#!/usr/bin/env python3
"""Puts a file's text into a document, between the lines `<!-- NAME: begin -->` and `<!-- NAME: end -->`.

    tools/replace_block.py docs/guides/error.md bench-error out/error/error.md
"""

import argparse
import pathlib
import sys


def replaced(document, name, text, path):
    """The document with the block's text in place of what was there."""
    begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->\n"
    for line in (begin, end):
        if document.count(line) != 1:
            sys.exit(f"{path}: '{line.strip()}' is there {document.count(line)} times; it must be once")
    head, rest = document.split(begin)
    if end not in rest:
        sys.exit(f"{path}: '{end.strip()}' must come after '{begin.strip()}'")
    text = text.strip("\n")
    return f"{head}{begin}\n{text}\n\n{end}{rest.split(end)[1]}"


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("document", type=pathlib.Path)
    parser.add_argument("name", help="of the block")
    parser.add_argument("text", type=pathlib.Path, help="file with what belongs there")
    options = parser.parse_args()
    try:
        document = options.document.read_text()
        text = options.text.read_text()
        options.document.write_text(replaced(document, options.name, text, options.document))
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}")


if __name__ == "__main__":
    main()
