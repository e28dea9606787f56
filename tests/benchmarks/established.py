#!/usr/bin/env python3
"""How often is a gain that is true, and one that is not, called established?

    established.py ERRMAP [--seeds 1-20] [--days 6,8,10] [--noise 5.9] ...

Each seed is a simulated turning centre of K days and eight later ones, with six
cycles a day and a few thermometers. Its error is the true one (--null: 0) and
noise of --noise um: an offset of each day (a third of it; --memory: of
neighbouring days), and the rest by rows and by cycles (--cycles: their share of
its variance). With the default noise a map errs by about three quarters of the
best simple one.

Printed for each K: the median of the blend's error on the later days over that
of the best simple map, how often the blend is established to be better, and in
how many tables any difference is established that the later days do not show.
"""

import json
import math
import os
import random
import statistics
import tempfile

from program_runs import FILE, parser_of, read, run, simulate, write

LATER = 8
CYCLES = 6
THERMOMETERS = (0, 2, 5, 8, 11, 14, 17, 20, 23, 26, 31, 34, 38)
MODELS = ("zero,mean,poly:position,poly:temperature,"
          "poly:ridge:view=auto,poly:eq8,blend")


def offsets_of(days, memory, draws):
    offset = draws.gauss(0, 1)
    for _ in range(days):
        yield offset
        offset = (memory * offset
                  + math.sqrt(1 - memory ** 2) * draws.gauss(0, 1))


def noisy(given, header, rows, draws):
    """The rows with their few columns, and an error with all that noise."""
    day, cycle = header.index("day"), header.index("cycle")
    columns = [day, cycle, header.index("time_s"), header.index("position_mm")]
    columns += [header.index(f"t{i:02d}_degC") for i in THERMOMETERS]
    truth = header.index("truth_mm")
    days = int(rows[-1][day])
    offsets = [given.noise / 3 * o
               for o in offsets_of(days, given.memory, draws)]
    rest = given.noise * math.sqrt(8 / 9)
    of_cycle = {}
    found = []
    for row in rows:
        shared = of_cycle.setdefault((row[day], row[cycle]), draws.gauss(0, 1))
        noise = offsets[int(row[day]) - 1] + rest * (
            math.sqrt(given.cycles) * shared
            + math.sqrt(1 - given.cycles) * draws.gauss(0, 1))
        error = (0 if given.null else 1e3 * float(row[truth])) + noise
        found.append([row[c] for c in columns] + [f"{error:.4f}"])
    return [header[c] for c in columns] + ["error_um"], found


def study(given, seed, days):
    """Of the blend: its error over that of the best simple map, and whether it
    is established to be better; whether anything false is established."""
    with tempfile.TemporaryDirectory() as folder:
        def path(name):
            return os.path.join(folder, name)

        simulate(given.errmap, path("machine"), seed, days + LATER,
                 "--cycles", CYCLES, "--truth")
        header, rows = noisy(given, *read(path(f"machine/{FILE}")),
                             random.Random(1000 * seed + days))
        write(path("train.csv"), header, [r for r in rows if int(r[0]) <= days])
        write(path("later.csv"), header, [r for r in rows if int(r[0]) > days])
        results = json.loads(run(
            given.errmap, "compare", path("train.csv"), "--format", "json",
            "--quiet", "--holdout", "sessions:5", "--models", MODELS, "--out",
            path("study")))["components"][0]

        def later(name):
            file = path(f"study/models/{name.replace(':', '_')}.json")
            found = json.loads(run(given.errmap, "evaluate", file,
                                   path("later.csv"), "--format", "json"))
            return found["summary"]["rmse"]

        simple = min((m for m in results["models"] if m["baseline"]),
                     key=lambda m: m["results"]["sessions:5"]["test"]["rmse"])
        better = [(p["a"], p["b"]) if p["difference"] < 0 else (p["b"], p["a"])
                  for p in results["comparisons"] if p["established"]]
        return {"ratio": later("blend") / later(simple["name"]),
                "established": ("blend", simple["name"]) in better,
                "false": any(later(a) >= later(b) for a, b in better)}


def main():
    parser = parser_of(__doc__, "1-20")
    parser.add_argument("--days", default="6,8,10")
    parser.add_argument("--noise", type=float, default=5.9)
    parser.add_argument("--cycles", type=float, default=0.0)
    parser.add_argument("--memory", type=float, default=0.0)
    parser.add_argument("--null", action="store_true")
    given = parser.parse_args()
    print("| days | studies | ratio | established | false |")
    print("|---|---|---|---|---|")
    for days in map(int, given.days.split(",")):
        found = [study(given, seed, days) for seed in given.seeds]
        print(f"| {days} | {len(found)} "
              f"| {statistics.median(f['ratio'] for f in found):.2f} "
              f"| {statistics.fmean(f['established'] for f in found):.2f} "
              f"| {statistics.fmean(f['false'] for f in found):.2f} |",
              flush=True)


if __name__ == "__main__":
    main()
