#!/usr/bin/env python3
"""Peak memory of hold-outs with very many folds, and of very many rows.

    peak_memory.py ERRMAP [ROWS...]

leave-one-group-out on 10,710 rows x 41 columns in 630 cycles, and groups:5 on
ROWS (default 1,000,000) x 41; prints seconds and the most that was resident.
"""

import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

os.environ["XDG_CACHE_HOME"] = "/dev/null"  # every fit is made

SENSORS = 39


def write(path, rows, per_cycle):
    draw = random.Random(1995)
    # Rows repeat after a while: the writing is not what is measured.
    tails = [
        ",".join(f"{20 + draw.random():.3f}" for _ in range(SENSORS))
        + f",{draw.gauss(0, 0.001):.6f}\n"
        for _ in range(997)
    ]
    names = ",".join(f"t{j}_degC" for j in range(SENSORS))
    with open(path, "w", encoding="ascii") as file:
        file.write(f"cycle,position_mm,{names},error_mm\n")
        for i in range(rows):
            file.write(f"{i // per_cycle},{i % per_cycle},{tails[i % 997]}")


def measure(words):
    begin = time.monotonic()
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.monotonic() - begin
    print(
        f"{' '.join(words[2:])}: status {os.waitstatus_to_exitcode(status)}, "
        f"{seconds:.1f} s, {usage.ru_maxrss / 1024:.0f} MiB",
        flush=True,
    )


def main():
    errmap = sys.argv[1]
    sizes = [int(rows) for rows in sys.argv[2:]] or [1_000_000]
    common = ["--models", "mean", "--quiet", "--jobs", "2"]
    with tempfile.TemporaryDirectory() as folder:
        data = str(pathlib.Path(folder) / "rows.csv")
        write(data, 10_710, 17)
        measure([errmap, "compare", data, *common, "--holdout", "leave-one-group-out"])
        for rows in sizes:
            write(data, rows, 1000)
            measure([errmap, "compare", data, *common, "--holdout", "groups:5"])


if __name__ == "__main__":
    main()
