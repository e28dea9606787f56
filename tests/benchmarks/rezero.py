#!/usr/bin/env python3
"""What re-zeroed maps are worth on days that no choice saw.

    rezero.py ERRMAP [--seeds 7001-7020] [--cycles 10] [--rezero 2h:noise=0.5um]

Each seed is a simulated turning centre of six days. Maps are compared on the
first four with --rezero; the recommended one and no map are judged on the other
two, both re-zeroed alike. A line per seed (um), then the median ratio and the
worst one.
"""

import argparse
import json
import os
import statistics
import tempfile

from program_runs import FILE, read, run, seeds, simulate, write

MODELS = "zero,poly:position,poly:ridge,blend"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("errmap")
    parser.add_argument("--seeds", type=seeds, default=seeds("7001-7020"))
    parser.add_argument("--cycles", default="10")
    parser.add_argument("--rezero", default="2h:noise=0.5um")
    given = parser.parse_args()
    ratios = []
    for seed in given.seeds:
        with tempfile.TemporaryDirectory() as folder:
            simulate(given.errmap, folder, seed, 6, "--cycles", given.cycles)
            header, rows = read(os.path.join(folder, FILE))
            day = header.index("day")
            train, later = (os.path.join(folder, f"{name}.csv")
                            for name in ("train", "later"))
            write(train, header, [r for r in rows if int(r[day]) <= 4])
            write(later, header, [r for r in rows if int(r[day]) > 4])
            record = json.loads(run(
                given.errmap, "compare", train, "--models", MODELS,
                "--holdout", "sessions:4", "--holdout", "file:" + later,
                "--rezero", given.rezero, "--format", "json", "--quiet",
                "--jobs", "1"))
        (component,) = record["components"]
        found = {model["name"]: 1000 * model["results"]["file:" + later]["test"]["rmse"]
                 for model in component["models"]}
        map_name = component["recommendation"]["model"]
        ratios.append(found[map_name] / found["zero"])
        print(f"{seed} {map_name} {found[map_name]:.3f} no map "
              f"{found['zero']:.3f} ratio {ratios[-1]:.3f}",
              flush=True)
    print(f"median {statistics.median(ratios):.3f} worst {max(ratios):.3f}")


if __name__ == "__main__":
    main()
