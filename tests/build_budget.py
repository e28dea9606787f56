#!/usr/bin/env python3
"""What the compiler reads for the program, by room, against a budget.

    build_budget.py BUILD_FOLDER

A translation unit takes the time of the headers that it reads, whatever it does
itself, so one careless #include costs every build seconds. Ninja knows which
files each object was made of; their lines are counted, those that the program
wrote and those of libraries alike. Skipped (status 77) where the build is not
by Ninja with its rooms together, or on other libraries than those of Debian 12,
for which the budget was counted (27 November 2026: 2.7 million lines in all
beside the precompiled headers, 5 to 6 of 10 in the standard library's).
"""

import collections
import pathlib
import re
import subprocess
import sys

SKIPPED = 77
# Thousands of lines that an object of a room may read.
BUDGET = {
    "stats": 155, "data": 105, "fitting": 130, "models": 115, "report": 105,
    "study": 100, "fleet": 85, "machine": 105, "netcg": 105, "turning": 105,
    "cli": 130,
}
ALL = 2_850  # thousands, of the whole program
LIBRARIES = ("eigen3", "boost", "nlohmann", "CLI", "tbb", "fmt", "toml", "ceres")


def library_of(path):
    for name in LIBRARIES:
        if f"/{name}/" in path:
            return name
    return "c++" if "/c++/" in path else "other"


def read_by_object(build):
    """Lines by object and library."""
    known = subprocess.run(["ninja", "-C", build, "-t", "deps"],
                           capture_output=True, text=True, check=True).stdout
    lengths = {}
    objects = {}
    for line in known.splitlines():
        if found := re.match(r"(\S+): #deps", line):
            lines = objects.setdefault(found[1], collections.Counter())
        elif line.startswith("    "):
            path = (build / line.strip()).resolve()
            if path not in lengths:  # 0 of a file that is there no more
                lengths[path] = (len(path.read_bytes().splitlines())
                                 if path.is_file() else 0)
            lines[library_of(str(path))] += lengths[path]
    return {name: lines for name, lines in objects.items()
            if name.endswith(".o")  # else a precompiled header
            and not name.startswith(("tests/", "cli/python/", "CMakeFiles/"))}


def excesses(objects, budget, most):
    """A line for each object above its room's budget, and for all together."""
    for name, lines in sorted(objects.items()):
        room = re.search(r"/errmap_?([a-z]*)", name)[1] or "cli"
        thousands = lines.total() / 1000
        if thousands > budget[room]:
            parts = ", ".join(f"{library} {count // 1000}"
                              for library, count in lines.most_common(4))
            yield (f"{name}: {thousands:.0f} thousand lines, {budget[room]} "
                   f"allowed ({parts})")
    total = sum(lines.total() for lines in objects.values()) / 1000
    if total > most:
        yield f"the program: {total:.0f} thousand lines, {most} allowed"


def main():
    build = pathlib.Path(sys.argv[1])
    cache = (build / "CMakeCache.txt").read_text()
    if ("ERRMAP_TOGETHER:BOOL=ON" not in cache
            or not (build / "build.ninja").exists()
            or 'VERSION_ID="12"' not in pathlib.Path("/etc/os-release").read_text()):
        print("skipped: needs a build by Ninja with ERRMAP_TOGETHER on Debian 12")
        return SKIPPED
    objects = read_by_object(build)
    if len(objects) < 40:
        raise SystemExit(f"FAILED: knows {len(objects)} objects only")
    # That it can fail: the same with one object's budget taken away.
    if len(list(excesses(objects, BUDGET | {"report": 0}, 1))) < 4:
        raise SystemExit("FAILED: sees no excess where there is one")
    found = list(excesses(objects, BUDGET, ALL))
    print("\n".join(found) or f"build_budget: {len(objects)} objects within it")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
