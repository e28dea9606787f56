"""The program without any slice: it links, and its core works.

    python3 without_slices_test.py SOURCE BUILD CMAKE

Rooms of the core are compiled alike with slices and without (which is checked),
so the libraries of BUILD serve: only the two lists by which slices join are
compiled anew, empty, and put before these.
"""

import csv
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from additions_test import (SAME, SKIPPED, cached, compile_objects,
                            expect, run)

SLICES = ("fleet", "machine", "netcg", "turning_centre")
COMMANDS = ("iso230", "volumetric", "submit", "merge", "deploy", "watch",
            "simulate", "convert", "netcg")


def sources_of(build, source):
    """What each room's one source includes, by the room."""
    return {str(unit.relative_to(build)):
            unit.read_text().replace(str(source), "")
            for unit in build.glob("*/CMakeFiles/*.dir/Unity/*.cxx")}


def build_program(source, build, folder, cmake):
    anew = folder / "build"
    run(cmake, "-S", source, "-B", anew, "-G", "Ninja", "-DERRMAP_SLICES=",
        "-DERRMAP_BUILD_TESTS=OFF", "-DERRMAP_TOGETHER=ON",
        *(f"-D{name}={cached(build, name)}" for name in SAME))
    core, whole = sources_of(anew, source), sources_of(build, source)
    lists = [room for room, text in core.items() if text != whole.get(room)]
    expect(len(lists) == 2 and all("_slices.dir" in room for room in lists),
           f"other rooms are compiled otherwise: {lists}")
    expect(not re.search("|".join(f"/cli/{name}/" for name in SLICES),
                         "".join(core.values())), "slices are compiled")
    ninja = cached(build, "CMAKE_MAKE_PROGRAM")
    objects = [f"{room}.o" for room in lists]
    compile_objects(ninja, anew, objects)
    link = run(ninja, "-C", build, "-t", "commands", "errmap").splitlines()
    link = next(line for line in reversed(link) if " -o errmap " in line)
    before, after = link.split(" -o errmap ")
    for name in SLICES:
        after = after.replace(f"liberrmap_{name}.a", "")
    program = folder / "errmap"
    ours = " ".join(f"'{anew / name}'" for name in objects)
    run("sh", "-c", f"{before} {ours} -o '{program}' {after}", cwd=build)
    names = run("nm", "-C", program)
    found = re.findall(rf"errmap::(?:{'|'.join(SLICES)})::\w+", names)
    expect(not found, f"{sorted(set(found))[:5]} of slices are linked")
    return program


def check_core(program, table, folder):
    shown = run(program, "--help")
    for name in COMMANDS:
        expect(f"\n  {name} " not in shown, f"help has {name}")
        refused = subprocess.run([program, name], capture_output=True,
                                 text=True, check=False)
        expect(refused.returncode == 2 and "no command" in refused.stderr,
               f"{name}: {refused.returncode}, {refused.stderr}")
    out = folder / "study"
    common = ["--models", "mean,poly:eq8", "--quiet"]
    record = json.loads(run(program, "compare", table, *common, "--format",
                            "json", "--out", out))
    (component,) = record["components"]
    expect(component["recommendation"], "recommends nothing")
    rows = csv.DictReader(io.StringIO(run(
        program, "compare", table, *common, "--format", "csv")))
    expect(sum(1 for row in rows if row["model"] == "poly:eq8") > 1, "rows")
    refused = subprocess.run(
        [program, "compare", "--machine", "machine.toml", folder],
        capture_output=True, text=True, check=False)
    expect(refused.returncode == 2, f"--machine: {refused.returncode}")
    model = folder / "model.json"
    run(program, "fit", table, "--model", "poly:eq8", "-o", model, "--quiet")
    run(program, "predict", model, table, "--quiet")
    run(program, "evaluate", model, table, "--quiet")
    run(program, "export", model, "--python", "-o", folder / "out", "--quiet")
    study = folder / "study.toml"
    run(program, "init", table, "-o", study)
    run(program, "compare", "--config", study, "--dry-run")
    check_part_of_a_slice(program, out)


def check_part_of_a_slice(program, out):
    """What a slice added to a record is passed over."""
    results = out / "results.json"
    record = json.loads(results.read_text())
    record["machine"] = {"name": "lathe"}
    results.write_text(json.dumps(record))
    page = run(program, "report", out, "--format", "html")
    expect("poly:eq8" in page and "lathe" not in page, "the page")


def main():
    source, build = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    if (not (build / "build.ninja").exists() or not shutil.which("nm")
            or cached(build, "ERRMAP_TOGETHER") != "ON"):
        print("skipped: needs a build by Ninja with ERRMAP_TOGETHER and nm")
        return SKIPPED
    table = source / "data/sets/nistir5367_xdisp_down.csv"
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        program = build_program(source, build, folder, sys.argv[3])
        check_core(program, table, folder)
    print("without slices: linked, its core works")
    return 0


if __name__ == "__main__":
    sys.exit(main())
