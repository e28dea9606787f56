#!/usr/bin/env python3
"""What is compensation by component maps worth on a day that they never saw?

    volumetric_days.py ERRMAP [--seeds 1-20] [--train 2,4,6] [--points 300]
                       [--model SPEC | --compare [WORDS] | --machine [WORDS]]
                       [--no-log]

Each seed is a simulated turning centre of K + 1 days. K days train: for every
component a map by --model (default poly:ridge), or what `errmap compare`
recommends with WORDS. On the last day `errmap volumetric` predicts the error at
the tool at random poses, the filters of maps with a memory run through
temperatures.csv (--no-log: through the poses alone). The 95th percentile of the
length of the error in X and Z, before and after compensation, is compared, and
the share of errors within the stated 90 % intervals is counted for X, Y and Z.
A line per seed and K, as a Markdown table, with the component that the rest
owes most to: the one whose own error, known from the file of that day, times
its arm is the largest.

--machine: one `errmap compare --machine` with WORDS (such as "--models
poly:ridge") per line, and its figures for the recommended maps.
"""

import csv
import json
import math
import os
import statistics
import sys
import tempfile

from program_runs import parser_of, read, run, simulate, write

NOT_MAPPED = ("tool_tip.csv", "diagonals.csv", "temperatures.csv")


def split(folder, name, days):
    """Rows of the first `days` days and those of later ones, as files."""
    header, rows = read(os.path.join(folder, name))
    day = header.index("day")
    paths = []
    for part, chosen in (
            ("training", [r for r in rows if int(r[day]) <= days]),
            ("later", [r for r in rows if int(r[day]) > days])):
        paths.append(os.path.join(folder, part, name))
        write(paths[-1], header, chosen)
    return paths


def recommended(errmap, training, words):
    results = json.loads(run(errmap, "compare", training, "--format", "json",
                             "--quiet", *words))
    return results["components"][0]["recommendation"]["model"]


def rmse_of(errmap, model, later):
    found = json.loads(run(errmap, "evaluate", model, later, "--format",
                           "json", "--quiet"))
    return found["summary"]["rmse"]


def percentile(values, share):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, math.floor(share * len(ordered)))]


def judge_machine(given, folder):
    results = json.loads(run(
        given.errmap, "compare", "--machine",
        os.path.join(folder, "machine.toml"), folder, "--format", "json",
        "--quiet", "--jobs", "1", *given.machine.split()))
    choices = {c["name"]: c for c in results["machine"]["choices"]}
    after = choices["recommended"]
    if after["why"]:
        sys.exit(f"no figures: {after['why']}")
    p95 = [1e3 * choices[name]["p95"]
           for name in ("uncompensated", "recommended")]
    worst = after["parts"][0]
    return {"before": p95[0], "after": p95[1], "ratio": p95[0] / p95[1],
            "worst": f"{worst['error']} {1e3 * worst['rms']:.2f}",
            **dict(zip("xyz", after["within_90"]))}


def judge(given, seed, days, folder):
    simulate(given.errmap, folder, seed, days + 1, "--points", given.points)
    if given.machine is not None:
        return judge_machine(given, folder)
    for part in ("training", "later"):
        os.mkdir(os.path.join(folder, part))
    own = {}
    for name in sorted(os.listdir(folder)):
        if not name.endswith(".csv"):
            continue
        training, later = split(folder, name, days)
        if name in NOT_MAPPED:
            continue
        spec = given.model or recommended(
            given.errmap, training, (given.compare or "").split())
        model = os.path.join(folder, name.replace(".csv", ".json"))
        run(given.errmap, "fit", training, "--model", spec, "-o", model,
            "--quiet")
        unit = 1.0 if "_mm" in read(later)[0][-1] else 1e-6
        own[name.removesuffix(".csv")] = unit * rmse_of(
            given.errmap, model, later)
    points = os.path.join(folder, "later", "tool_tip.csv")
    log = [] if given.no_log else [
        "--after", os.path.join(folder, "later", "temperatures.csv")]
    header, *rows = csv.reader(
        run(given.errmap, "volumetric", os.path.join(folder, "machine.toml"),
            "--at", points, "--draws", "0", "--quiet", *log).splitlines())
    predicted = [dict(zip(header, row)) for row in rows]
    truth = [dict(zip(read(points)[0], row)) for row in read(points)[1]]
    return summary(truth, predicted, own)


# Lengths, mm, that turn an angle's error into one at the tool.
ARMS = {"x_yaw": 120, "z_yaw": 280, "parallelism": 330, "orthogonality": 280,
        "spindle_tilt_xz": 330, "spindle_tilt_yz": 250}


def summary(truth, predicted, own):
    def value(row, column):
        return float(row[column] or "nan")

    before, after, covered = [], [], {d: 0 for d in "xyz"}
    for actual, stated in zip(truth, predicted):
        rest = {d: value(actual, f"error_{d}_mm") -
                value(stated, f"error_{d}_mm") for d in "xyz"}
        before.append(math.hypot(value(actual, "error_x_mm"),
                                 value(actual, "error_z_mm")))
        after.append(math.hypot(rest["x"], rest["z"]))
        for d in "xyz":
            covered[d] += abs(rest[d]) <= value(stated,
                                                f"half_width_90_{d}_mm")
    at_tool = {name: ARMS.get(name, 1) * error for name, error in own.items()}
    worst = max(at_tool, key=at_tool.get)
    p95 = [1e3 * percentile(v, 0.95) for v in (before, after)]
    return {"before": p95[0], "after": p95[1], "ratio": p95[0] / p95[1],
            "worst": f"{worst} {1e3 * at_tool[worst]:.2f}",
            **{d: n / len(truth) for d, n in covered.items()}}


def main():
    parser = parser_of(__doc__, "1-20")
    parser.add_argument("--train", default="2,4,6")
    parser.add_argument("--points", type=int, default=300)
    parser.add_argument("--model")
    parser.add_argument("--compare", nargs="?", const="")
    parser.add_argument("--machine", nargs="?", const="")
    parser.add_argument("--no-log", action="store_true")
    given = parser.parse_args()
    if given.model is None and given.compare is None and given.machine is None:
        given.model = "poly:ridge"
    print("| days | seed | before, um | after, um | ratio | within 90 %: X | Y "
          "| Z | worst component, um at the tool |")
    print("|---|---|---|---|---|---|---|---|---|")
    for days in map(int, given.train.split(",")):
        found = []
        for seed in given.seeds:
            with tempfile.TemporaryDirectory() as folder:
                line = judge(given, seed, days, folder)
            found.append(line)
            print(f"| {days} | {seed} | {line['before']:.1f} "
                  f"| {line['after']:.2f} | {line['ratio']:.1f} "
                  f"| {line['x']:.2f} | {line['y']:.2f} | {line['z']:.2f} "
                  f"| {line['worst']} |", flush=True)
        ratios = [line["ratio"] for line in found]
        within = [statistics.fmean(line[d] for line in found) for d in "xyz"]
        print(f"| {days} | all | | | median {statistics.median(ratios):.1f}, "
              f"least {min(ratios):.1f} | {within[0]:.3f} | {within[1]:.3f} "
              f"| {within[2]:.3f} | |", flush=True)


if __name__ == "__main__":
    main()
