#!/usr/bin/env python3
"""Whatever is killed while it writes can be done again, with the same results.

    kills.py ERRMAP DATA [KILLS]

KILLS (default 8; on demand 300) runs of compare, fit, learn and update in turn
are killed (SIGKILL) at moments drawn with a fixed seed, from the start to a
little after the end of an unbroken run. After each:

  - every file of its own name is whole: that of before, or that of an unbroken
    run, times apart; what was in the making has a name that says so;
  - the same command again (with --resume where there is one), until one run is
    not killed, ends in what an unbroken run gives, and nothing is left behind.

Prints kills and where they fell; status 1 where something does not hold.
"""

import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

from outputs import LEFT_BEHIND, contents, fail, failures

def noise(draw, scale):
    return draw.gauss(0.0, scale)


def write_days(path, days, slope):
    """20 positions on each of some days, an error with this slope."""
    draw = random.Random(7 + len(days))
    with open(path, "w", encoding="ascii") as file:
        file.write("day,position_mm,t1_degC,error_mm\n")
        for day in days:
            warm = 20.0 + noise(draw, 2.0)
            for position in range(20):
                error = slope * position + 1e-3 * (warm - 20.0) + noise(draw, 2e-4)
                file.write(f"{day},{position},{warm + noise(draw, 0.1):.3f},{error:.6f}\n")


class Case:
    """A command, what stands there before it, and what it writes."""

    def __init__(self, name, words, resumes):
        self.name, self.words, self.resumes = name, words, resumes


def run(errmap, case, folder, seconds=None, again=False):
    """Status, or None where it was killed after so many seconds."""
    words = [errmap, *case.words, *(["--resume"] if again and case.resumes else [])]
    process = subprocess.Popen(
        words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        return process.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        return None


def fresh(inputs, folder):
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(inputs, folder)


def main():
    errmap, data = sys.argv[1], str(pathlib.Path(sys.argv[2]).resolve())
    most_kills = int(sys.argv[3]) if len(sys.argv) > 3 else 8
    draw = random.Random(1995)
    cases = [
        Case("compare",
             ["compare", data, "--models", "mean,poly:eq8,net:scg:hidden=4:iterations=200",
              "--jobs", "2", "--out", "out"], True),
        Case("fit", ["fit", data, "--model", "poly:full:degree=4", "-o", "map.json"], False),
        Case("learn",
             ["learn", "known.csv", "--by", "sessions", "--models", "poly:eq8,poly:ridge",
              "--out", "out"], True),
        Case("update", ["update", "old.json", "new.csv", "-o", "old.json"], False),
    ]  # fmt: skip
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(scratch)
        inputs = root / "inputs"
        inputs.mkdir()
        write_days(inputs / "known.csv", range(1, 9), 1e-3)
        write_days(inputs / "new.csv", range(11, 17), 2e-3)
        made = run(errmap, Case("", ["fit", "known.csv", "--model", "poly:eq8", "-o", "old.json"], False), inputs)
        if made != 0:
            sys.exit("cannot make the map to update")
        before = contents(inputs)
        unbroken, lengths = {}, {}
        for case in cases:
            folder = root / case.name
            fresh(inputs, folder)
            begin = time.monotonic()
            if run(errmap, case, folder) != 0:
                sys.exit(f"{case.name} itself fails")
            lengths[case.name] = time.monotonic() - begin
            unbroken[case.name] = contents(folder)
        kills = {case.name: 0 for case in cases}
        whole = {case.name: 0 for case in cases}
        folder = root / "killed"
        for number in range(100 * most_kills):
            if sum(kills.values()) >= most_kills:
                break
            case = cases[number % len(cases)]
            fresh(inputs, folder)
            what = f"{case.name} {number}"
            again = False
            while True:
                status = run(errmap, case, folder, draw.uniform(0.0, 1.1 * lengths[case.name]), again)
                if status is not None:
                    break
                kills[case.name] += 1
                again = True
                try:
                    for name, content in contents(folder).items():
                        old = before.get(name)
                        if name.endswith("errmap-files.json") or content == LEFT_BEHIND:
                            continue
                        if content not in (old, unbroken[case.name].get(name)):
                            fail(what, f"{name} is neither the old one nor the new one")
                except ValueError as error:
                    fail(what, f"a file is not whole: {error}")
                if sum(kills.values()) >= most_kills:
                    break
            if status is None:
                status = run(errmap, case, folder, again=True)
            # What an update has finished is no update when it is done again.
            whole[case.name] += 1
            if status != 0:
                fail(what, f"status {status} when it is done again")
            elif case.name != "update" and contents(folder) != unbroken[case.name]:
                fail(what, "other results than those of an unbroken run")
            left = [str(p) for p in folder.rglob("*") if ".tmp" in p.name]
            if left:
                fail(what, f"left behind: {left}")
    print(json.dumps({"kills": kills, "ended": whole}))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
