#!/usr/bin/env python3
"""Do prediction intervals hold on later days, and do flags rise on unlike ones?

    interval_coverage.py ERRMAP [--seeds 1-20] [--days 4,6,10] [--model SPEC]

Each seed is a simulated turning centre; a map is fitted to its first K days and
judged on the next four, of like duty and of harder duty. Printed for each K:
the share of rows within the 90 % interval (mean over seeds, and the lowest),
its width over that of the smallest constant one that would have held 90 % of
them (median), how often no interval was given, and the share of rows flagged
(inside = 0).
"""

import csv
import io
import math
import os
import statistics
import tempfile

from program_runs import FILE, parser_of, read, run, simulate, write

LATER = 4


def simulated(errmap, folder, seed, days, *options):
    simulate(errmap, folder, seed, days, *options)
    return read(os.path.join(folder, FILE))


def judge(errmap, folder, header, rows):
    later = os.path.join(folder, "later.csv")
    write(later, header, rows)
    lines = list(csv.DictReader(io.StringIO(run(
        errmap, "predict", os.path.join(folder, "map.json"), later,
        "--quiet"))))
    target = header.index("error_mm")
    sizes = [abs(float(row[target]) - float(line["predicted"]))
             for row, line in zip(rows, lines)]
    flagged = sum(line["inside"] == "0" for line in lines) / len(lines)
    if not lines[0]["lower_90"]:
        return None, None, flagged
    halves = [(float(line["upper_90"]) - float(line["lower_90"])) / 2
              for line in lines]
    held = sum(s <= h for s, h in zip(sizes, halves)) / len(sizes)
    least = sorted(sizes)[math.ceil(0.9 * len(sizes)) - 1]
    return held, statistics.fmean(halves) / least, flagged


def main():
    parser = parser_of(__doc__, "1-20")
    parser.add_argument("--days", default="4,6,10")
    parser.add_argument("--model", default="poly:ridge")
    given = parser.parse_args()
    print("| days | duty | within 90 % | lowest | width | not given | flagged |")
    print("|---|---|---|---|---|---|---|")
    for days in map(int, given.days.split(",")):
        found = {"like": [], "harder": []}
        for seed in given.seeds:
            with tempfile.TemporaryDirectory() as folder:
                header, rows = simulated(
                    given.errmap, os.path.join(folder, "like"), seed,
                    days + LATER)
                _, harder = simulated(
                    given.errmap, os.path.join(folder, "hard"), seed,
                    days + LATER, "--duty", "1.7", "--speed", "1.5")
                day = header.index("day")
                train = os.path.join(folder, "train.csv")
                write(train, header, [r for r in rows if int(r[day]) <= days])
                run(given.errmap, "fit", train, "--model", given.model, "-o",
                    os.path.join(folder, "map.json"), "--quiet")
                for name, all_rows in (("like", rows), ("harder", harder)):
                    found[name].append(judge(
                        given.errmap, folder, header,
                        [r for r in all_rows if int(r[day]) > days]))
        for name, results in found.items():
            given_ones = [r for r in results if r[0] is not None]
            print(f"| {days} | {name} "
                  f"| {statistics.fmean(r[0] for r in given_ones):.3f} "
                  f"| {min(r[0] for r in given_ones):.2f} "
                  f"| {statistics.median(r[1] for r in given_ones):.2f} "
                  f"| {1 - len(given_ones) / len(results):.2f} "
                  f"| {statistics.fmean(r[2] for r in results):.3f} |",
                  flush=True)


if __name__ == "__main__":
    main()
