#!/usr/bin/env python3
"""What it takes to add a column, a hold-out, a family of models and the like.

    additions_test.py SOURCE_FOLDER BUILD_FOLDER CMAKE

Each patch of additions/ adds one, in as many files as the READMEs of the rooms
say. A column, a format of tables, a hold-out, a certified problem, a filter of
a map's memory and a remark on the recommended map are applied to a copy of the sources and the program is built with them: the rooms whose sources they edit are compiled anew and linked before the
libraries of BUILD_FOLDER, which is made by Ninja with its rooms together (else
skipped, status 77; so where there is no patch(1)). Rooms that only include an
edited header are not: an enumerator or a declaration more at its end changes
nothing in them. Then the program is run.

An option of a study and a family of models add members to structs, which every
room would have to be compiled for. Of these the compiler reads, without making
anything, what the patch edits or makes and what includes the header of a list:
it is the lists that refuse what was forgotten.

The problem is Michaelis-Menten on the treated cells of Bates & Watts (1988),
table A1.3; its figures were made by Gauss-Newton steps in 60 digits and agree
with R's nls (212.7, 0.06412; sd 6.947, 0.008281).

A model of one's own is added by a program: outside_project/my_model.cc.
"""

import concurrent.futures
import csv
import io
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
# Files that each addition may edit or make, beside READMEs.
MOST_FILES = {"column": 1, "format": 1, "holdout": 3, "problem": 2,
              "filter": 4, "remark": 1}
# Likewise, without what they make, and the headers of their lists.
OF_STRUCTS = {"option": (3, "cli/study_setup/study_options.h"),
              "family": (6, "models/file/map_members_json.h")}


# Of the build that is there.
SAME = ["CMAKE_BUILD_TYPE", "CMAKE_CXX_COMPILER", "CMAKE_CXX_FLAGS",
        "CMAKE_CXX_COMPILER_LAUNCHER", "CMAKE_MAKE_PROGRAM"]


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


def compile_objects(ninja, build, objects):
    """The suite forbids the program its cache; the compiler may have its own."""
    environment = {name: value for name, value in os.environ.items()
                   if name != "XDG_CACHE_HOME"}
    run(ninja, "-C", build, "-j2", *objects, env=environment)


def copy_of_program(source, folder):
    for name in ("CMakeLists.txt", "cli", "data", "fitting", "models", "stats"):
        copy = shutil.copytree if (source / name).is_dir() else shutil.copy
        copy(source / name, folder / name)


def apply(source, folder, name, most, made_too):
    """Applies a patch; returns the files that it edits and makes."""
    patch = source / "tests/additions" / f"{name}.patch"
    text = patch.read_text()
    files = re.findall(r"^\+\+\+ b/(\S+)", text, re.M)
    made = re.findall(r"^--- /dev/null\n\+\+\+ b/(\S+)", text, re.M)
    counted = [file for file in files if made_too or file not in made]
    expect(0 < len(counted) <= most,
           f"{name}: {len(counted)} files, at most {most}: {counted}")
    run("patch", "--strip=1", "--no-backup-if-mismatch", "--batch",
        "--input", patch, cwd=folder)
    return files


def check_structs(source, folder, build, cmake):
    """Has the compiler read the patches of OF_STRUCTS; how many files."""
    copy_of_program(source, folder)
    read = set()
    for name, (most, header) in OF_STRUCTS.items():
        read.update(apply(source, folder, name, most, made_too=False))
        read.update(str(unit.relative_to(folder))
                    for unit in folder.glob("[cm]*/**/*.cc")
                    if f'#include "{header}"' in unit.read_text())
    anew = folder / "build"
    run(cmake, "-S", folder, "-B", anew, "-G", "Ninja",
        "-DERRMAP_BUILD_TESTS=OFF", "-DERRMAP_TOGETHER=OFF",
        *(f"-D{name}={cached(build, name)}" for name in SAME))
    units = [unit for unit in
             json.loads((anew / "compile_commands.json").read_text())
             if str(pathlib.Path(unit["file"]).relative_to(folder)) in read]
    expect(len(units) == sum(name.endswith(".cc") for name in read),
           f"compiles {len(units)} of {read}")
    with concurrent.futures.ThreadPoolExecutor(2) as two:
        list(two.map(lambda unit: run(
            "sh", "-c",
            re.sub(r" -o \S+ -c ", " -fsyntax-only ", unit["command"]),
            cwd=unit["directory"]), units))
    return len(units)


def room_of(unit, edited):
    """Whether a room's one source, made by CMake, includes an edited file."""
    included = re.findall(r'^#include "(.+)"', unit.read_text(), re.M)
    return any(name.endswith(tuple(edited)) for name in included)


def build_program(folder, build, cmake, edited):
    """The program of the libraries of `build` and the rooms that were edited."""
    anew = folder / "build"
    run(cmake, "-S", folder, "-B", anew, "-G", "Ninja",
        "-DERRMAP_BUILD_TESTS=OFF", "-DERRMAP_TOGETHER=ON",
        *(f"-D{name}={cached(build, name)}" for name in SAME))
    ninja = cached(build, "CMAKE_MAKE_PROGRAM")
    sources = {name for name in edited if name.endswith(".cc")}
    objects = [f"{unit.relative_to(anew)}.o"
               for unit in sorted(anew.glob("*/CMakeFiles/*.dir/Unity/*.cxx"))
               if room_of(unit, sources)]
    objects += re.findall(r"^(\S+/strd_texts\.cc\.o):",
                          run(ninja, "-C", anew, "-t", "targets", "all"), re.M)
    expect(0 < len(objects) <= len(sources) + 1,
           f"compiles {objects} of {sources}")
    compile_objects(ninja, anew, objects)
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
    for command in ("compare", "merge", "watch"):
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


def check_remark(program, table):
    common = [program, "compare", table, "--models", "mean,poly:eq8", "--quiet"]
    expect("  largest error    " in run(*common, "--details"), "no remark")
    record = json.loads(run(*common, "--format", "json"))
    expect(any(reason.startswith("Largest error: ") for reason in
               record["components"][0]["recommendation"]["reasons"]),
           "no reason")


def check_filter(program, folder):
    """A map with one lag made a lead predicts what that is by hand, and its
    exported program does."""
    run(program, "simulate", "turning-centre", "-o", folder / "sim", "--days",
        "2", "--cycles", "2", "--quiet")
    data = folder / "sim/x_displacement_down.csv"
    run(program, "fit", data, "--model", "poly:ridge:view=history:terms=linear",
        "--inputs", "position_mm,t12_degC", "-o", folder / "lag.json",
        "--quiet", "--no-interval")
    model = json.loads((folder / "lag.json").read_text())
    lag = model["history"]["derived"][0]
    lag["filter"] = "lead"
    at = model["history"]["form_inputs"].index(lag["name"])
    polynomial = model["polynomial"]
    by = sum(term["coefficient"] for term in polynomial["terms"]
             if term["powers"][at] == 1) * polynomial["input_scale"][at]
    model.update(guards=None, applicability=None, name="lead")
    del model["checksum"]  # errmap would see the change
    (folder / "lead.json").write_text(json.dumps(model))
    (folder / "lag.json").write_text(json.dumps(
        {**model, "history": {**model["history"], "derived": [
            {**lag, "filter": "ema"}, *model["history"]["derived"][1:]]}}))
    found = [[float(row["predicted"]) for row in csv.DictReader(io.StringIO(
        run(program, "predict", folder / name, data, "--quiet")))]
        for name in ("lag.json", "lead.json")]
    rows = list(csv.DictReader(io.StringIO(data.read_text())))
    day, time, x, y = None, 0.0, 0.0, 0.0
    for row, of_lag, of_lead in zip(rows, *found):
        now, reading = float(row["time_s"]), float(row["t12_degC"])
        if row["day"] != day:
            y = reading
        else:
            u = (now - time) / lag["tau"]
            m = -math.expm1(-u) / u
            y += u * m * (x - y) + (1.0 - m) * (reading - x)
        day, time, x = row["day"], now, reading
        # of reading - y in the place of y
        expect(abs(of_lead - of_lag - by * (reading - 2.0 * y)) < 1e-12,
               f"row at {now}: {of_lead}, with a lag {of_lag}, y {y}")
    run(program, "export", folder / "lead.json", "--python", "-o", folder / "out",
        "--quiet")
    expect("right" in run(sys.executable, "-B", folder / "out/lead.py"),
           "its exported program")


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
        copy_of_program(source, folder)
        edited = {file for name, most in MOST_FILES.items()
                  for file in apply(source, folder, name, most, made_too=True)}
        program = build_program(folder, build, sys.argv[3], edited)
        check_column(program, table, folder)
        check_format(program, table)
        check_holdout(program, table)
        check_problem(program)
        check_remark(program, table)
        check_filter(program, folder)
    with tempfile.TemporaryDirectory() as scratch:
        units = check_structs(source, pathlib.Path(scratch), build, sys.argv[3])
    print(f"additions: {len(MOST_FILES)}, {len(edited)} files edited or made; of "
          f"structs {len(OF_STRUCTS)}, {units} files read")
    return 0


if __name__ == "__main__":
    sys.exit(main())
