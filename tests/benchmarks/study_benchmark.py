#!/usr/bin/env python3
"""What a default comparison costs: wall, CPU, peak memory, and where it goes.

    study_benchmark.py ERRMAP [--only NAME,...] [--jobs 1,2]
                       [--file DATA.csv:TARGET] [--store FIGURES.json]
                       [--against FIGURES.json]

Sets: report (397 x 2, shipped), turning (1190 x 41, simulated), turning_1e5
(99,960 x 41), plain_1e6 (a million rows x 5) and files of one's own. CPU
seconds by family are the sums of the fits' own times. --store writes the
figures, by machine; --against names what has become more than 10 % slower (CPU
seconds, since wall time is also that of others on the machine).
"""

import argparse
import csv
import json
import os
import platform
import random
import subprocess
import sys
import tempfile
import time

os.environ["XDG_CACHE_HOME"] = "/dev/null"  # every fit is made

HERE = os.path.dirname(os.path.abspath(__file__))
SHIPPED = os.path.join(HERE, "../../data/sets/nistir5367_xdisp_down.csv")
SLOWER = 1.10


def simulated(errmap, folder, days):
    subprocess.run([errmap, "simulate", "turning-centre", "--quiet", "-o",
                    folder, "--seed", "1", "--days", str(days), "--dead",
                    "3,4,16,19"], check=True)
    return f"{folder}/x_displacement_down.csv", None


def plain(folder, rows):
    """Five inputs, days of 1000 rows, an error of two time constants."""
    draw = random.Random(1)
    path = f"{folder}/plain.csv"
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow(["time_s", "day", "position_mm", "t1_degC", "t2_degC",
                      "t3_degC", "speed_rpm", "error_um"])
        warm = 0.0
        for row in range(rows):
            if row % 1000 == 0:
                warm, base = 0.0, draw.gauss(0.0, 1.0)
            speed = 1000.0 * (1 + row // 100 % 5)
            warm += (speed / 1000.0 - warm) / 60.0
            x = row % 17 * 25.0
            out.writerow([row * 60 + row // 1000 * 30000, row // 1000 + 1, x,
                          f"{20 + base + warm + draw.gauss(0, .05):.3f}",
                          f"{20 + base + 0.5 * warm:.3f}",
                          f"{20 + base + draw.gauss(0, .05):.3f}", speed,
                          f"{2 * warm + x * warm / 200 + base:.3f}"])
    return path, None


def measure(errmap, data, target, jobs):
    words = [errmap, "compare", data, "--quiet", "--jobs", str(jobs)]
    words += ["--target", target] if target else []
    with tempfile.TemporaryDirectory() as folder:
        start = time.monotonic()
        process = subprocess.Popen(words + ["--out", f"{folder}/out"],
                                   stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        said = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - start
        if status != 0:
            sys.exit(f"{' '.join(words)}\n{said}")
        with open(f"{folder}/out/results.json", encoding="utf-8") as file:
            component = json.load(file)["components"][0]
    families = {}
    for model in component["models"]:
        if model["status"] != "ok":
            continue
        seconds = model["final"]["fit_seconds"]
        seconds += sum(fold["fit_seconds"] or 0.0
                       for result in model["results"].values()
                       for fold in result["folds"])
        family = model["name"].split(":view")[0]
        families[family] = families.get(family, 0.0) + seconds
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime,
            "peak_mib": usage.ru_maxrss / 1024.0, "families": families}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("errmap")
    parser.add_argument("--only", default="report,turning")
    parser.add_argument("--jobs", default="1,2")
    parser.add_argument("--file", action="append", default=[])
    parser.add_argument("--store")
    parser.add_argument("--against")
    given = parser.parse_args()
    machine = f"{platform.node()} {platform.processor() or platform.machine()}"
    figures = {}
    with tempfile.TemporaryDirectory() as folder:
        made = {
            "report": lambda: (SHIPPED, None),
            "turning": lambda: simulated(given.errmap, f"{folder}/2", 2),
            "turning_1e5": lambda: simulated(given.errmap, f"{folder}/168",
                                             168),
            "plain_1e6": lambda: plain(folder, 1_000_000),
        }
        sets = {name: made[name] for name in given.only.split(",") if name}
        for word in given.file:
            path, _, target = word.partition(":")
            sets[os.path.basename(path)] = lambda p=path, t=target: (p, t)
        print("| set | jobs | wall s | CPU s | peak MiB | most of it |\n"
              "|---|---|---|---|---|---|")
        for name, make in sets.items():
            data, target = make()
            for jobs in given.jobs.split(","):
                of = measure(given.errmap, data, target, int(jobs))
                figures[f"{name} jobs={jobs}"] = of
                most = sorted(of["families"].items(), key=lambda f: -f[1])[:4]
                print(f"| {name} | {jobs} | {of['wall']:.2f} | "
                      f"{of['cpu']:.2f} | {of['peak_mib']:.0f} | " +
                      ", ".join(f"{n} {s:.2f}" for n, s in most) + " |",
                      flush=True)
    if given.against:
        with open(given.against, encoding="utf-8") as file:
            before = json.load(file).get(machine, {})
        for name, of in figures.items():
            if name in before and of["cpu"] > SLOWER * before[name]["cpu"]:
                print(f"slower: {name}: {before[name]['cpu']:.2f} -> "
                      f"{of['cpu']:.2f} s of CPU")
    if given.store:
        stored = {}
        if os.path.exists(given.store):
            with open(given.store, encoding="utf-8") as file:
                stored = json.load(file)
        stored.setdefault(machine, {}).update(figures)
        with open(given.store, "w", encoding="utf-8") as file:
            json.dump(stored, file, indent=1)


if __name__ == "__main__":
    main()
