"""Commands that write, in folders of their own, and what they leave there."""

import pathlib
import random
import shutil
import sys
import time

from outputs import contents

FLEET = """models = ["mean", "poly:eq8"]
holdouts = ["sessions:4"]
[[component]]
name = "{machine}"
data = "{machine}.csv"
"""


def write_days(path, days, slope):
    """20 positions on each of some days, an error with this slope."""
    draw = random.Random(7 + len(days))
    with open(path, "w", encoding="ascii") as file:
        file.write("day,position_mm,t1_degC,error_mm\n")
        for day in days:
            warm = 20.0 + draw.gauss(0.0, 2.0)
            for position in range(20):
                error = slope * position + 1e-3 * (warm - 20.0) + draw.gauss(0.0, 2e-4)
                warmth = warm + draw.gauss(0.0, 0.1)
                file.write(f"{day},{position},{warmth:.3f},{error:.6f}\n")


class Case:
    """A command, what it writes to, and the case whose outputs it begins with."""

    def __init__(self, name, words, output, after="inputs", status=0, resumes=False):
        self.name, self.words, self.output, self.after = name, words, output, after
        self.status, self.resumes = status, resumes

    def again(self):
        return self.words + (["--resume"] if self.resumes else [])


def commands(data, models):
    """The cases; `compare` compares these models on this file."""
    return [
        Case("compare", ["compare", data, "--models", models, "--holdout", "every:3",
                         "--jobs", "2", "--out", "out"], "out", resumes=True),
        Case("fit", ["fit", "known.csv", "--model", "poly:eq8", "-o", "map.json"], "map.json"),
        Case("learn", ["learn", "known.csv", "--by", "sessions", "--models",
                       "poly:eq8,poly:ridge", "--out", "out"], "out", resumes=True),
        Case("update", ["update", "map.json", "new.csv", "-o", "map.json"], "map.json",
             after="fit"),
        Case("fleet", ["compare", "--config", "fleet.toml", "--out", "store"], "store"),
        Case("merge", ["merge", "store"], "store", after="fleet"),
        Case("deploy", ["deploy", "store", "known"], "store", after="fleet"),
        # A map that has become worse is a check that was missed.
        Case("watch", ["watch", "store", "known=new.csv"], "store", after="deploy", status=4),
    ]  # fmt: skip


def fresh(before, folder):
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(before, folder)


class Unbroken:
    """What the cases leave where nothing breaks them off, below `root`."""

    def __init__(self, cases, root, run):
        """`run` runs words in a folder and gives the status."""
        self.root = pathlib.Path(root)
        inputs = self.root / "inputs"
        inputs.mkdir()
        write_days(inputs / "known.csv", range(1, 9), 1e-3)
        write_days(inputs / "new.csv", range(11, 17), 2e-3)
        (inputs / "fleet.toml").write_text(FLEET, encoding="ascii")
        self.contents, self.seconds = {"inputs": contents(inputs)}, {}
        for case in cases:
            folder = self.root / case.name
            self.begin(case, folder)
            begin = time.monotonic()
            status = run(case.words, folder)
            self.seconds[case.name] = time.monotonic() - begin
            if status != case.status:
                sys.exit(f"{case.name} itself ends with status {status}")
            self.contents[case.name] = contents(folder)

    def begin(self, case, folder):
        """Makes the folder what it is before the case."""
        fresh(self.root / case.after, folder)

    def has_ended(self, case, found):
        """Whether all is there: what adds to its output must not be done twice."""
        return found == self.contents[case.name]
