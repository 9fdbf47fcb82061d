#!/usr/bin/env python3
"""Names the source files of more than 500 lines of code; comments and blank lines do not count."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ("model", "rtl", "tb", "tests", "tools")
ENDINGS = {".cpp", ".h", ".hpp", ".py", ".sv"}
MOST = 500
NO_CODE = re.compile(r"\s*(//.*|#(?!\s*(include|define|if|endif|else|elif|undef|pragma|error)).*)?$")


def main():
    wrong = 0
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in ENDINGS:
                continue
            lines = sum(not NO_CODE.match(line) for line in path.read_text().splitlines())
            if lines > MOST:
                print(f"{path.relative_to(ROOT)}: {lines} lines of code; legal: at most {MOST}")
                wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
