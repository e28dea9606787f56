#!/usr/bin/env python3
"""Do the tests notice mistakes? Makes those of mutants.toml, one at a time.

    mutate.py BUILD [--survivors N] [--check] [NUMBER...]

Each mutant (all, or those of these numbers from 1) is put into its source file,
its test program is built in BUILD and the units named, which pass without it,
are run: one of them has to fail. The file is put back whatever happens. --check
only looks whether every text that is to be changed stands once in its file, as
the suite does. Status 1 where more than --survivors (2) live. A mutant that does
not build, or whose unit takes two minutes longer than without it, is dead.
"""

import argparse
import pathlib
import subprocess
import sys
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent
MOST_SECONDS = 120


def builds(build, program):
    command = ["cmake", "--build", build, "--parallel", "1", "--target", program]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


def run(build, program, unit, most=None):
    words = [f"{build}/tests/{program}", f"--unit={unit}"]
    return subprocess.run(
        words, capture_output=True, text=True, errors="replace", timeout=most, check=False
    )


def seconds_of_units(build, mutants):
    """What each unit of these takes as it is; they have to pass."""
    for program in sorted({mutant["program"] for mutant in mutants}):
        if not builds(build, program):
            sys.exit(f"{program} does not build")
    found = {}
    for program, unit in sorted({(m["program"], unit) for m in mutants for unit in m["units"]}):
        begin = time.monotonic()
        if run(build, program, unit).returncode != 0:
            sys.exit(f"{program} --unit={unit} fails without a mutant")
        found[unit] = time.monotonic() - begin
    return found


def kill(build, mutant, seconds):
    """How it died, or None."""
    program = mutant["program"]
    if not builds(build, program):
        return "does not build"
    for unit in mutant["units"]:
        try:
            outcome = run(build, program, unit, MOST_SECONDS + seconds[unit])
        except subprocess.TimeoutExpired:
            return f"{unit} does not end"
        if outcome.returncode != 0:
            failed = [line for line in outcome.stdout.splitlines() if "[  FAILED  ]" in line]
            return f"{unit}: {failed[0].split()[3] if failed else outcome.returncode}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("numbers", nargs="*", type=int)
    parser.add_argument("--survivors", type=int, default=2)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    mutants = tomllib.loads((HERE / "mutants.toml").read_text(encoding="utf-8"))["mutant"]
    lost = [
        f"{number}: {mutant['file']} has {mutant['old']!r} {count} times"
        for number, mutant in enumerate(mutants, 1)
        if (count := (SOURCE / mutant["file"]).read_text(encoding="utf-8").count(mutant["old"])) != 1
    ]
    print(*lost, sep="\n", end="\n" if lost else "")
    if lost or arguments.check:
        print(len(mutants), "mutants,", len(lost), "of them not to be made")
        return 1 if lost else 0
    survivors = 0
    chosen = arguments.numbers or range(1, len(mutants) + 1)
    seconds = seconds_of_units(arguments.build, [mutants[n - 1] for n in chosen])
    for number in chosen:
        mutant = mutants[number - 1]
        path = SOURCE / mutant["file"]
        text = path.read_text(encoding="utf-8")
        begin = time.monotonic()
        try:
            path.write_text(text.replace(mutant["old"], mutant["new"]), encoding="utf-8")
            death = kill(arguments.build, mutant, seconds)
        finally:
            path.write_text(text, encoding="utf-8")
        survivors += death is None
        print(
            f"{number} {mutant['file']}: {death or 'LIVES'} ({time.monotonic() - begin:.0f} s)",
            flush=True,
        )
    print(f"{survivors} of {len(chosen)} live")
    return 1 if survivors > arguments.survivors else 0


if __name__ == "__main__":
    sys.exit(main())
