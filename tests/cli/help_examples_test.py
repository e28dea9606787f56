"""Runs the example of each command's help, in the order of the help.

Usage: help_examples_test.py ERRMAP SOURCE

The examples read the shipped data sets, and the files that earlier ones wrote.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

errmap, source = (pathlib.Path(word).resolve() for word in sys.argv[1:3])

# They need a fleet's store, a cluster or a file of 1995.
NEED_OTHER_FILES = {"submit", "merge", "deploy", "watch", "netcg"}
# Right answers of these are not 0: 4 where no interval reaches the goal.
OTHER_STATUS = {"when": {0, 4}}


def help_of(*words):
    done = subprocess.run([errmap, *words], capture_output=True, text=True, check=True)
    return done.stdout


def example_of(command):
    found = re.search(r"^Example:\s+(errmap .*?[^\\])$", help_of("help", command), re.M | re.S)
    return found and found.group(1)


failed = 0
commands = re.findall(r"^  ([a-z0-9]+)  ", help_of("--help"), re.M)
ran = 0
with tempfile.TemporaryDirectory() as folder:
    (pathlib.Path(folder) / "data").symlink_to(source / "data")
    # What makes a map comes first.
    for command in sorted(commands, key=lambda name: name != "fit"):
        example = example_of(command)
        if example is None:
            print(f"{command}: its help has no example")
            failed += 1
            continue
        if command in NEED_OTHER_FILES:
            continue
        done = subprocess.run(
            ["sh", "-c", example.replace("errmap ", f"{errmap} ", 1)],
            cwd=folder,
            capture_output=True,
            text=True,
        )
        ran += 1
        if done.returncode not in OTHER_STATUS.get(command, {0}):
            print(f"{command}: status {done.returncode} of: {example}\n{done.stderr}")
            failed += 1
print(f"help_examples: {ran} examples run, {failed} failed")
sys.exit(failed > 0 or ran < 20)
