#!/usr/bin/env python3
"""After any call of the system that fails, nothing is lost and nothing is half.

    faults_test.py ERRMAP PRELOADED DATA [MALLOCS [SITES]] [--models LIST]
                   [--cases NAME,...] [--only-memory]

Runs a small study (`compare` of cases.py) once for every write, fsync, rename
and opening of a file, in which that call fails (PRELOADED: failing_calls.cc),
once for each of MALLOCS (60) allocations drawn with a fixed seed, and once for
each of SITES (10; "all") places in the program's own code, of which the first
allocation fails; the other commands of cases.py for some of these, for every
file and place where SITES is "all". On demand: 1000 all, and the same with every
kind of model. After each:

  - the program has ended within 10 s of its own time, by itself;
  - the status is 1 and a line names a file, where the call was one for files; 0
    where no output is touched: a fit that could not be kept for --resume, which
    a line says, or a flush after all is in place;
  - each output is whole, and that of before or of the unbroken run;
  - where a fit found not enough memory its model has failed and says so: what
    the others found is what they found in the unbroken run; a command that
    makes one map ends as if nothing had been, or by status 1;
  - the same command again (--resume) ends in what the unbroken run gave.
"""

import argparse
import json
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile

from cases import Unbroken, commands
from outputs import LEFT_BEHIND, contents, fail, failures

MOST_SECONDS = 10  # of its own: a busy machine does not change that
MOST_WAITING = 600  # for what waits for ever
# That never look at what malloc gives.
LIBRARIES = ("libopenblas", "libtbb", "libceres", "libcrypto")
FILE_CALLS = ("write", "fsync", "rename", "open", "ftruncate")
findings = {"runs": 0, "killed in a library": 0, "statuses": {}}


class Program:
    """errmap, with calls that fail."""

    def __init__(self, errmap, preloaded, root):
        self.errmap, self.preloaded = errmap, preloaded
        self.log = root / "log"

    def run(self, words, folder, fault=None):
        environment = dict(os.environ, XDG_CACHE_HOME="/dev/null")
        self.log.unlink(missing_ok=True)
        if fault:
            environment["LD_PRELOAD"] = self.preloaded
            environment["ERRMAP_FAIL"] = fault
            environment["ERRMAP_FAIL_LOG"] = str(self.log)
        return subprocess.run(
            [self.errmap, *words],
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=MOST_WAITING,
            preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS + 1)
            ),
            check=False,
        )

    def log_text(self):
        return self.log.read_text() if self.log.exists() else ""


class Faults:
    """Of one case, what can fail in it."""

    def __init__(self, program, unbroken, case):
        self.program, self.unbroken, self.case = program, unbroken, case

    def calls(self, kind):
        folder = self.unbroken.root / "counted"
        self.unbroken.begin(self.case, folder)
        self.program.run(self.case.words, folder, f"{kind}:0")
        lines = self.program.log_text().splitlines()
        return int(lines[-1].split()[-1]), sorted(lines[:-1])

    def drawn(self, arguments):
        """Those to try, with whether it is a call for files."""
        draw = random.Random(1995)
        is_main = self.case.name == "compare"
        everything = arguments.sites == "all"
        of_files = []
        for kind in () if arguments.only_memory else FILE_CALLS:
            of_files += [f"{kind}:{n + 1}" for n in range(self.calls(kind)[0])]
        count, _ = self.calls("malloc")
        _, sites = self.calls("site")
        print(f"{self.case.name}: {len(of_files)} calls for files, {count} allocations,",
              f"{len(sites)} places that allocate", flush=True)  # fmt: skip
        mallocs = arguments.mallocs if is_main else arguments.mallocs // 10
        if not everything:
            most = int(arguments.sites)
            sites = draw.sample(sites, min(most if is_main else most // 5, len(sites)))
            if not is_main:
                of_files = draw.sample(of_files, min(most, len(of_files)))
        of_memory = [f"malloc:{draw.randint(1, count)}" for _ in range(mallocs)]
        of_memory += [f"site:{site}" for site in sites]
        return [(fault, True) for fault in of_files] + [(fault, False) for fault in of_memory]


def found_by_models(results):
    """What each model that has not failed found by itself, by component and name."""
    found = {}
    for component in results["components"]:
        for model in component["models"]:
            if model["status"] != "ok":
                continue
            memorisation = model["memorisation"]
            if memorisation and memorisation["why_not"] == "not enough memory":
                memorisation = None
            figures = [model[key] for key in ("options", "parameters", "equation", "final")]
            for holdout in model["results"].values():
                figures += [holdout[key] for key in ("train", "test", "folds")]
            found[component["name"], model["name"]] = (figures, memorisation)
    return found


def judge_models(what, found, unbroken):
    expected = found_by_models(unbroken)
    for name, (figures, memorisation) in found_by_models(found).items():
        if figures != expected[name][0]:
            fail(what, f"{name} is ok, with other figures than in the unbroken run")
        if memorisation and memorisation != expected[name][1]:
            fail(what, f"{name} learnt another share of noise")


def judge_file_fault(what, case, outcome, is_whole):
    named = re.compile(rf"^errmap: (.*[ '])?{re.escape(case.output)}([/:;, ']|$)")
    if outcome.returncode != 1 and not is_whole:
        fail(what, f"status {outcome.returncode}: {outcome.stderr}")
    if not any(named.search(line) for line in outcome.stderr.splitlines()):
        if not (is_whole and " fsync" in what):
            fail(what, f"no line names a file: {outcome.stderr}")


def judge_status(what, case, outcome, log):
    status = outcome.returncode
    if status in (-signal.SIGXCPU, -signal.SIGKILL):
        fail(what, "does not end")
    elif status < 0:
        # They end the program.
        inside = any(name in log for name in LIBRARIES)
        findings["killed in a library"] += inside
        if not inside:
            fail(what, f"ended by signal {-status}:\n{log}{outcome.stderr}")
    elif status not in (case.status, 1, 4):
        fail(what, f"status {status}: {outcome.stderr}")
    if status in (1, 4) and status != case.status and not outcome.stderr:
        fail(what, f"status {status} without a word")


def judge_outputs(what, case, found, unbroken, is_file_fault, status):
    before, whole = unbroken.contents[case.after], unbroken.contents[case.name]
    for name, content in found.items():
        if content == LEFT_BEHIND:
            if status >= 0 and whole.get(name) != LEFT_BEHIND:
                fail(what, f"left {name} behind")
        elif content in (before.get(name), whole.get(name)):
            continue
        elif is_file_fault and not name.endswith("errmap-files.json"):
            fail(what, f"{name} is not that of the unbroken run")
        elif pathlib.PurePath(name).name in ("results.json", "results.json.gz"):
            judge_models(what, content, whole[name])


def judge(program, unbroken, case, fault, folder, outcome, is_file_fault):
    what = f"{case.name} {fault}"
    findings["runs"] += 1
    if findings["runs"] % 100 == 0:
        print(findings["runs"], "runs", flush=True)
    status = outcome.returncode
    findings["statuses"][status] = findings["statuses"].get(status, 0) + 1
    judge_status(what, case, outcome, program.log_text())
    found = {}
    try:
        found = contents(folder)
    except ValueError as error:
        fail(what, f"an output is not whole: {error}")
    judge_outputs(what, case, found, unbroken, is_file_fault, status)
    is_whole = status == case.status and unbroken.has_ended(case, found)
    if is_file_fault and status >= 0:
        judge_file_fault(what, case, outcome, is_whole)
    may_fail_in_parts = case.name in ("compare", "fleet", "merge")
    if status == case.status and not is_whole and not may_fail_in_parts:
        fail(what, "ends as if nothing had been, with other outputs")
    if unbroken.has_ended(case, found):
        return
    again = program.run(case.again(), folder)
    if again.returncode != case.status:
        fail(what, f"again: status {again.returncode}: {again.stderr}")
    elif not unbroken.has_ended(case, contents(folder)):
        fail(what, "done again it ends in other results")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("errmap", "preloaded", "data"):
        parser.add_argument(name, type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("mallocs", nargs="?", type=int, default=60)
    parser.add_argument("sites", nargs="?", default="10")
    parser.add_argument("--only-memory", action="store_true")
    parser.add_argument("--cases", type=lambda names: names.split(","))
    parser.add_argument(
        "--models",
        default="mean,poly:eq8,net:scg:hidden=3:iterations=30,poly:formula=no_such_mm",
    )
    arguments = parser.parse_args()
    cases = commands(arguments.data, arguments.models)
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(scratch)
        program = Program(arguments.errmap, arguments.preloaded, root)
        unbroken = Unbroken(
            cases, root, lambda words, folder: program.run(words, folder).returncode
        )
        folder = root / "broken"
        try:
            for case in cases:
                if arguments.cases and case.name not in arguments.cases:
                    continue
                faults = Faults(program, unbroken, case)
                for fault, is_file_fault in faults.drawn(arguments):
                    unbroken.begin(case, folder)
                    try:
                        outcome = program.run(case.words, folder, fault)
                    except subprocess.TimeoutExpired:
                        fail(fault, "does not end")
                        continue
                    judge(program, unbroken, case, fault, folder, outcome, is_file_fault)
        except KeyboardInterrupt:
            print("broken off; so far:")
    print(json.dumps(findings))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
