#!/usr/bin/env python3
"""Is a map with sensors recommended where sensors tell nothing?

    worth_of_sensors.py ERRMAP [--seeds 1-480] [--models LIST]

Each odd seed is a set of a curve over the position with noise, each even one of
noise alone; the noise is independent, an offset of each session or remembers, in
turn. Thermometers warm over each session and have no part in the error. Counted:
sets where `compare` recommends a map that reads one.
"""

import collections
import json
import math
import os
import random
import tempfile

from program_runs import parser_of, run, write

NOISES = ("independent", "offsets", "memory")


def rows_of(seed):
    draw = random.Random(seed)
    noise = NOISES[seed // 2 % 3]
    days, cycles = draw.choice((4, 5, 6, 8, 10)), draw.choice((3, 5, 8))
    places, sensors = draw.choice((7, 11)), draw.randint(2, 6)
    curve = [draw.uniform(-size, size) for size in (4, 4, 3)]
    header = ["day", "cycle", "time_s", "position_mm",
              *(f"t{i:02d}_degC" for i in range(sensors)), "error_um"]
    rows = []
    for day in range(days):
        base = [draw.gauss(20, 1.2) for _ in range(sensors)]
        rise = [draw.uniform(0, 6) for _ in range(sensors)]
        tau = [draw.uniform(1500, 9000) for _ in range(sensors)]
        duty, offset = draw.uniform(0.4, 1.2), draw.gauss(0, 1)
        time = start = day * 86400 + draw.uniform(25000, 29000)
        memory = draw.gauss(0, 1)
        for cycle in range(cycles):
            for place in range(places):
                at = -1 + 2 * place / (places - 1)
                memory = 0.97 * memory + draw.gauss(0, math.sqrt(1 - 0.97 ** 2))
                error = draw.gauss(0, 1 if noise == "independent" else 0.4)
                error += {"independent": 0, "offsets": offset,
                          "memory": memory}[noise]
                if seed % 2:
                    error += sum(c * at ** (k + 1) for k, c in enumerate(curve))
                warm = [base[i] + draw.gauss(0, 0.03) + duty * rise[i] *
                        (1 - math.exp((start - time) / tau[i]))
                        for i in range(sensors)]
                rows.append([day + 1, day * cycles + cycle + 1, f"{time:.0f}",
                             f"{300 * at:g}", *(f"{t:.2f}" for t in warm),
                             f"{error:.4f}"])
                time += 6
            time += draw.uniform(600, 1500)
    return noise, header, rows


def main():
    parser = parser_of(__doc__, range(1, 481))
    parser.add_argument("--models", default="")
    given = parser.parse_args()
    counts = collections.Counter()
    words = ["--models", given.models] if given.models else []
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "set.csv")
        for seed in given.seeds:
            noise, header, rows = rows_of(seed)
            write(path, header, rows)
            found = json.loads(run(given.errmap, "compare", path, "--format",
                                   "json", "--quiet", *words))
            advice = found["components"][0]["recommendation"]
            of = ("position and " if seed % 2 else "") + noise
            counts[of, "sets"] += 1
            counts[of, "with sensors"] += bool(advice["sensors"])
    for of in sorted({of for of, _ in counts}):
        print(f"{of:26} {counts[of, 'with sensors']} of {counts[of, 'sets']}")


if __name__ == "__main__":
    main()
