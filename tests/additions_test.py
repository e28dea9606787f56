#!/usr/bin/env python3
"""What it takes to add a column, a hold-out, a certified problem, a format.

    additions_test.py SOURCE_FOLDER BUILD_FOLDER CMAKE

Each patch of additions/ adds one, in as many files as the READMEs of the rooms
say. All are applied to a copy of the sources and the program is built with
them: the rooms whose sources they edit are compiled anew and linked before the
libraries of BUILD_FOLDER, which is made by Ninja with its rooms together (else
skipped, status 77; so where there is no patch(1)). Rooms that only include an
edited header are not: an enumerator or a declaration more at its end changes
nothing in them. Then the program is run.

The problem is Michaelis-Menten on the treated cells of Bates & Watts (1988),
table A1.3; its figures were made by Gauss-Newton steps in 60 digits and agree
with R's nls (212.7, 0.06412; sd 6.947, 0.008281).

A model of one's own is added by a program: outside_project/my_model.cc.
"""

import csv
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
# Files that each addition may edit or make, beside READMEs.
MOST_FILES = {"column": 1, "format": 1, "holdout": 3, "problem": 2}


def run(*words, **options):
    done = subprocess.run(
        [str(word) for word in words],
        capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise SystemExit(
            f"FAILED: {' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
    return done.stdout


def expect(condition, what):
    if not condition:
        raise SystemExit("FAILED: " + what)


def cached(build, name):
    text = (build / "CMakeCache.txt").read_text()
    found = re.search(rf"^{name}:[^=]*=(.*)$", text, re.M)
    return found[1] if found else ""


def patched_copy(source, folder):
    """Copies what the program is made of; returns the files that were edited."""
    for name in ("CMakeLists.txt", "cli", "data", "fitting", "models", "stats"):
        copy = shutil.copytree if (source / name).is_dir() else shutil.copy
        copy(source / name, folder / name)
    edited = set()
    for name, most in MOST_FILES.items():
        patch = source / "tests/additions" / f"{name}.patch"
        files = re.findall(r"^\+\+\+ b/(\S+)", patch.read_text(), re.M)
        expect(0 < len(files) <= most,
               f"{name}: {len(files)} files, at most {most}: {files}")
        run("patch", "--strip=1", "--no-backup-if-mismatch", "--batch",
            "--input", patch, cwd=folder)
        edited.update(files)
    return edited


def room_of(unit, edited):
    """Whether a room's one source, made by CMake, includes an edited file."""
    included = re.findall(r'^#include "(.+)"', unit.read_text(), re.M)
    return any(name.endswith(tuple(edited)) for name in included)


def build_program(folder, build, cmake, edited):
    """The program of the libraries of `build` and the rooms that were edited."""
    anew = folder / "build"
    same = ["CMAKE_BUILD_TYPE", "CMAKE_CXX_COMPILER", "CMAKE_CXX_FLAGS",
            "CMAKE_CXX_COMPILER_LAUNCHER", "CMAKE_MAKE_PROGRAM"]
    run(cmake, "-S", folder, "-B", anew, "-G", "Ninja",
        "-DERRMAP_BUILD_TESTS=OFF", "-DERRMAP_TOGETHER=ON",
        *(f"-D{name}={cached(build, name)}" for name in same))
    ninja = cached(build, "CMAKE_MAKE_PROGRAM")
    sources = {name for name in edited if name.endswith(".cc")}
    objects = [f"{unit.relative_to(anew)}.o"
               for unit in sorted(anew.glob("*/CMakeFiles/*.dir/Unity/*.cxx"))
               if room_of(unit, sources)]
    objects += re.findall(r"^(\S+/strd_texts\.cc\.o):",
                          run(ninja, "-C", anew, "-t", "targets", "all"), re.M)
    expect(0 < len(objects) <= len(sources) + 1,
           f"compiles {objects} of {sources}")
    # The suite forbids the program its cache; the compiler may have its own.
    os.environ.pop("XDG_CACHE_HOME", None)
    run(ninja, "-C", anew, "-j2", *objects)
    os.environ["XDG_CACHE_HOME"] = "/dev/null"
    program = folder / "errmap"
    link = run(ninja, "-C", build, "-t", "commands", "errmap").splitlines()[-1]
    before, after = link.split(" -o errmap ")
    ours = " ".join(f"'{anew / name}'" for name in objects)
    run("sh", "-c", f"{before} {ours} -o '{program}' {after}", cwd=build)
    return program


def check_column(program, table, folder):
    out = folder / "study"
    common = [program, "compare", table, "--models", "mean,poly:eq8", "--quiet"]
    screen = run(*common, "--out", out, "--details")
    expect(" largest " in screen, "no column on the screen:\n" + screen)
    (row,) = [row for row in csv.DictReader(io.StringIO(
        run(*common, "--format", "csv")))
        if row["model"] == "poly:eq8" and row["holdout"] == "groups:5"]
    largest = float(row["largest"])
    expect(largest == max(abs(float(row["test_min"])),
                          abs(float(row["test_max"]))),
           f"largest error of {row}")
    expect("| largest |" in run(*common, "--format", "md"), "not in Markdown")
    page = (out / "report.html").read_text()
    expect("largest error" in page, "not on the page")
    run(program, "report", out, "--format", "md")
    expect("largest error" in (out / "report.md").read_text(),
           "not in report.md")


def check_format(program, table):
    def rows(form):
        return run(program, "compare", table, "--models", "mean,poly:eq8",
                   "--quiet", "--format", form).splitlines()

    written = [row.split("\t") for row in rows("tsv")]
    as_csv = list(csv.reader(rows("csv")))
    expect(written[0] == as_csv[0], f"columns {written[0]}")
    expect([len(row) for row in written] == [len(row) for row in as_csv],
           f"rows {written}")
    for command in ("compare", "merge", "query", "watch"):
        expect("table|json|csv|tsv|md" in run(program, command, "--help"),
               command + " does not offer the format")


def check_holdout(program, table):
    cycles = [float(row["elapsed_cycles"])
              for row in csv.DictReader(io.StringIO(table.read_text()))]
    newest = sorted(set(cycles))[-7:]
    record = json.loads(run(
        program, "compare", table, "--models", "mean,poly:eq8", "--quiet",
        "--holdout", "newest:7", "--format", "json"))
    (component,) = record["components"]
    result = component["models"][0]["results"]["newest:7"]
    expect(result["test"]["n"] == sum(c in newest for c in cycles),
           f"{result['test']['n']} rows held out")
    expect(result["train"]["n"] == sum(c not in newest for c in cycles),
           f"{result['train']['n']} rows trained on")
    expect(component["recommendation"]["holdout"] == "newest:7",
           "the hold-out does not decide")
    expect("newest:K" in run(program, "help", "compare", "--all"),
           "help lacks it")
    refused = subprocess.run(
        [str(program), "compare", str(table), "--holdout", "newest:35"],
        capture_output=True, text=True, check=False)
    expect(refused.returncode == 3 and "at least 36 groups" in refused.stderr,
           f"{refused.returncode}: {refused.stderr}")


def check_problem(program):
    record = json.loads(run(program, "certify", "nist", "--format", "json"))
    runs = [run for run in record["nonlinear"]
            if run["problem"] == "Puromycin" and run["solver"] == "lm"]
    expect(len(runs) == 2, f"{len(runs)} runs")
    for found in runs:
        expect(min(found["lre_parameters"], found["lre_sd"],
                   found["lre_rss"]) >= 10.0, str(found))


def main():
    source, build = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    if (not (build / "build.ninja").exists() or not shutil.which("patch")
            or cached(build, "ERRMAP_TOGETHER") != "ON"):
        print("skipped: needs a build by Ninja with ERRMAP_TOGETHER and patch "
              "(apt-get install patch)")
        return SKIPPED
    table = source / "data/sets/nistir5367_xdisp_down.csv"
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        edited = patched_copy(source, folder)
        program = build_program(folder, build, sys.argv[3], edited)
        check_column(program, table, folder)
        check_format(program, table)
        check_holdout(program, table)
        check_problem(program)
    print(f"additions: {len(MOST_FILES)}, {len(edited)} files edited or made")
    return 0


if __name__ == "__main__":
    sys.exit(main())
