#!/usr/bin/env python3
"""Whatever is killed while it writes can be done again, with the same results.

    kills.py ERRMAP DATA [KILLS]

KILLS (default 24; on demand 300) runs of the commands of cases.py in turn are
killed (SIGKILL) at moments drawn with a fixed seed, from the start to a little
after the end of an unbroken run. After each:

  - every file of its own name is whole: that of before, or that of an unbroken
    run, times apart; what was in the making has a name that says so;
  - the same command again (with --resume where there is one), until one run is
    not killed or all is there, ends in what an unbroken run gives, and nothing
    is left behind.

Prints kills and where they fell; status 1 where something does not hold.
"""

import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

from cases import Unbroken, commands
from outputs import LEFT_BEHIND, contents, fail, failures

MODELS = "mean,poly:eq8,net:scg:hidden=4:iterations=200"


def run(words, folder, seconds=None):
    """Status, or None where it was killed after so many seconds."""
    process = subprocess.Popen(
        words,
        env={**os.environ, "XDG_CACHE_HOME": "/dev/null"},
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        return process.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        return None


def judge_killed(what, case, found, unbroken):
    for name, content in found.items():
        if name.endswith("errmap-files.json") or content == LEFT_BEHIND:
            continue
        if content not in (
            unbroken.contents[case.after].get(name),
            unbroken.contents[case.name].get(name),
        ):
            fail(what, f"{name} is neither the old one nor the new one")


def main():
    errmap, data = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:3])
    most_kills = int(sys.argv[3]) if len(sys.argv) > 3 else 24
    draw = random.Random(1995)
    cases = commands(data, MODELS)
    kills = {case.name: 0 for case in cases}
    ended = {case.name: 0 for case in cases}
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(scratch)
        unbroken = Unbroken(cases, root, lambda words, folder: run([errmap, *words], folder))
        folder = root / "killed"
        for number in range(100 * most_kills):
            if sum(kills.values()) >= most_kills:
                break
            case = cases[number % len(cases)]
            unbroken.begin(case, folder)
            what = f"{case.name} {number}"
            words = case.words
            while True:
                seconds = None
                if sum(kills.values()) < most_kills:
                    seconds = draw.uniform(0.0, 1.1 * unbroken.seconds[case.name])
                status = run([errmap, *words], folder, seconds)
                if status is not None and status != case.status:
                    fail(what, f"status {status}")
                try:
                    found = contents(folder)
                except ValueError as error:
                    fail(what, f"a file is not whole: {error}")
                    break
                if status is None:
                    kills[case.name] += 1
                    judge_killed(what, case, found, unbroken)
                    words = case.again()
                if status is not None or unbroken.has_ended(case, found):
                    if not unbroken.has_ended(case, found):
                        fail(what, "other results than those of an unbroken run")
                    break
            ended[case.name] += 1
    print(json.dumps({"kills": kills, "ended": ended}))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
