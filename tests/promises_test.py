#!/usr/bin/env python3
"""Each sentence of cli/PROMISES.md is backed by a test of the name beside it.

    promises_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys


def main():
    source = pathlib.Path(sys.argv[1])
    tests = set()
    for path in (source / "tests").rglob("*_test.cc"):
        for suite, name in re.findall(
            r"^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\)", path.read_text(), re.M
        ):
            tests.add(f"{suite}.{name}")
    scripts = set(re.findall(r"add_test\(NAME (\w+)", (source / "tests/CMakeLists.txt").read_text()))
    text = (source / "cli/PROMISES.md").read_text()
    wrong = []
    named = 0
    for item in re.findall(r"^- (.+?)(?=^- |^#|^$)", text, re.M | re.S):
        names = re.findall(r"\[([\w., ]+)\]", " ".join(item.split()))
        if not names:
            wrong.append("no test: " + item)
        for name in names[-1].split(", ") if names else []:
            named += 1
            if name not in tests and name not in scripts:
                wrong.append("no such test: " + name)
    for line in wrong:
        print("FAILED:", line, file=sys.stderr)
    print(named, "tests named")
    return 1 if wrong or named == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
