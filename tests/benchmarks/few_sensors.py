#!/usr/bin/env python3
"""How many thermocouples does `errmap learn --by sensors` find to be enough?

    few_sensors.py ERRMAP [--seeds 1-10] [--days 6]

Each seed is a simulated turning centre. Printed: the error on days held out
whole, in um, with 3 to 8 sensors chosen without them and with all, and the
seconds that the search took; then the geometric means.
"""

import json
import os
import statistics
import tempfile
import time

from program_runs import FILE, parser_of, run, simulate

NUMBERS = range(3, 9)


def learn(errmap, seed, days):
    with tempfile.TemporaryDirectory() as folder:
        data = os.path.join(folder, "machine")
        simulate(errmap, data, seed, days)
        start = time.monotonic()
        found = json.loads(run(
            errmap, "learn", os.path.join(data, FILE), "--by", "sensors",
            "--format", "json", "--quiet"))["sensors"]
        taken = time.monotonic() - start
    by_number = {point["sensors"]: point["rmse"] for point in found["points"]}
    return ([1000 * by_number[number] for number in NUMBERS] +
            [1000 * found["all"]["rmse"], taken])


def main():
    parser = parser_of(__doc__, "1-10")
    parser.add_argument("--days", type=int, default=6)
    given = parser.parse_args()
    print(f"| seed | {' | '.join(map(str, NUMBERS))} | all | s |")
    print("|---" * (len(NUMBERS) + 3) + "|")
    lines = []
    for seed in given.seeds:
        lines.append(learn(given.errmap, seed, given.days))
        print(f"| {seed} | " + " | ".join(f"{v:.3f}" for v in lines[-1][:-1]) +
              f" | {lines[-1][-1]:.0f} |", flush=True)
    means = [statistics.geometric_mean(column) for column in zip(*lines)]
    print("| mean | " + " | ".join(f"{v:.3f}" for v in means[:-1]) +
          f" | {means[-1]:.0f} |")
    enough = sum(line[NUMBERS.index(6)] <= 1.05 * line[-2] for line in lines)
    print(f"6 within 5 % of all: {enough} of {len(lines)}")


if __name__ == "__main__":
    main()
