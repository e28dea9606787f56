#!/usr/bin/env python3
"""Do the stated intervals hold where neighbours err alike or scatter differs?

    headline_coverage.py ERRMAP [--seeds 1-200] [--kinds NAME,...]

Each seed is a machine whose error is a line over position and one temperature,
and noise by a kind below: an offset of each unit (--memory of neighbouring
ones, default 0.9) with half its standard deviation by rows, or rows whose
scatter is another in each session. The mean and simple maps are compared; the
recommended map, fitted to all rows, is judged on the sessions that follow (as
many as it is good for, else four) and on 400 others of the same process.

Printed for each kind: in how many studies the 95 % interval of the recommended
map's error is stated, how often that holds the error on the others, and its
upper end over the stated error (median); the error on the others over the
stated one; how often "good for" is stated, and the share of the rows of the sessions it names
(where it names none: of the next four) within the 90 % interval.
"""

import csv
import io
import json
import math
import os
import random
import statistics
import tempfile

from program_runs import parser_of, run, write

HEADER = ["day", "cycle", "time_s", "position_mm", "t0_degC", "error_um"]
MODELS = "mean,poly:temperature,poly:full:degree=1"
OTHERS = 400
# Sessions, cycles in each, the unit that has an offset, whether scatter differs
KINDS = {
    "15 cycles": (1, 15, "cycle", False),
    "40 cycles": (1, 40, "cycle", False),
    "8 x 6 cycles": (8, 6, "cycle", False),
    "5 sessions": (5, 4, "session", False),
    "6 sessions": (6, 4, "session", False),
    "8 sessions": (8, 4, "session", False),
    "10 sessions": (10, 4, "session", False),
    "20 sessions": (20, 4, "session", False),
    "6 scatters": (6, 4, None, True),
    "10 scatters": (10, 4, None, True),
}


def offsets_of(memory, draws):
    offset = draws.gauss(0, 1)
    while True:
        yield offset
        offset = (memory * offset
                  + math.sqrt(1 - memory ** 2) * draws.gauss(0, 1))


def sessions_of(kind, memory, draws):
    """Rows of one session after another."""
    _, cycles, unit, scatters = KINDS[kind]
    offsets = offsets_of(memory, draws)
    day = cycle = 0
    while True:
        day += 1
        scatter = math.exp(0.7 * draws.gauss(0, 1)) if scatters else 0.5
        offset = next(offsets) if unit == "session" else 0.0
        rows = []
        for of_day in range(cycles):
            cycle += 1
            if unit == "cycle":
                offset = next(offsets)
            for place in range(10):
                warm = 20 + 5 * (1 - math.exp(-of_day / 3))
                rows.append([day, cycle,
                             86400 * day + 600 * of_day + 10 * place,
                             50 * place, f"{warm + draws.gauss(0, 0.1):.2f}",
                             round(place + 0.5 * warm + offset
                                   + scatter * draws.gauss(0, 1), 3)])
        yield rows


def taken(sessions, count):
    return [row for _ in range(count) for row in next(sessions)]


def errors(given, folder, map_file, rows):
    """Of every row: its error, and the half-width of the 90 % interval."""
    path = os.path.join(folder, "judged.csv")
    write(path, HEADER, rows)
    lines = csv.DictReader(io.StringIO(run(
        given.errmap, "predict", map_file, path, "--quiet")))
    return [(abs(row[-1] - float(line["predicted"])),
             (float(line["upper_90"]) - float(line["lower_90"])) / 2
             if line["upper_90"] else math.nan)
            for row, line in zip(rows, lines)]


def study(given, kind, seed):
    draws = random.Random(f"{kind} {seed}")
    machine = sessions_of(kind, given.memory, draws)
    sessions = KINDS[kind][0]
    with tempfile.TemporaryDirectory() as folder:
        data = os.path.join(folder, "data.csv")
        write(data, HEADER, taken(machine, sessions))
        advice = json.loads(run(
            given.errmap, "compare", data, "--format", "json", "--quiet",
            "--models", MODELS, "--out", f"{folder}/study"))[
                "components"][0]["recommendation"]
        map_file = (f"{folder}/study/models/"
                    f"{advice['model'].replace(':', '_')}.json")
        promise = advice["promise"] or {}
        next_ones = errors(given, folder, map_file,
                           taken(machine, promise.get("good_for", 4)))
        others = errors(given, folder, map_file, [
            row for _ in range(OTHERS // sessions) for row in
            taken(sessions_of(kind, given.memory, draws), sessions)])
    true = math.sqrt(statistics.fmean(e * e for e, _ in others))
    low, high = advice["ci95"]
    return {"stated": low is not None,
            "holds": low is not None and low <= true <= high,
            "upper": math.nan if low is None else high / advice["rmse"],
            "ratio": true / advice["rmse"],
            "good_for": "good_for" in promise,
            "within": statistics.fmean(e <= w for e, w in next_ones)
                      if promise else math.nan}


def mean(values, of=statistics.fmean):
    values = [v for v in values if not math.isnan(v)]
    return f"{of(values):.2f}" if values else "-"


def median(values):
    return mean(values, statistics.median)


def main():
    parser = parser_of(__doc__, range(1, 201))
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--memory", type=float, default=0.9)
    given = parser.parse_args()
    print("| kind | studies | 95 % stated | holds | upper / stated error "
          "| found / stated error | good for | within 90 % |")
    print("|---|---|---|---|---|---|---|---|")
    for kind in given.kinds.split(","):
        found = [study(given, kind, seed) for seed in given.seeds]
        print(f"| {kind} | {len(found)} | {mean(f['stated'] for f in found)} "
              f"| {mean(f['holds'] for f in found if f['stated'])} "
              f"| {median(f['upper'] for f in found)} "
              f"| {median(f['ratio'] for f in found)} "
              f"| {mean(f['good_for'] for f in found)} "
              f"| {mean(f['within'] for f in found)} |", flush=True)


if __name__ == "__main__":
    main()
