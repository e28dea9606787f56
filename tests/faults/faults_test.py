#!/usr/bin/env python3
"""After any call of the system that fails, nothing is lost and nothing is half.

    faults_test.py ERRMAP PRELOADED DATA [MALLOCS [SITES [--only-memory]]]

Runs a small study once for every write, fsync, rename and opening of a file,
in which that call fails (PRELOADED: failing_calls.cc), once for each
of MALLOCS (60) allocations drawn with a fixed seed, and once for each of SITES
(10; "all") places in the program's own code, of which the first allocation
fails. On demand: 1000 all. After each:

  - the program has ended within 10 s of its own time, by itself;
  - the status is 1 and a line names a file, where the call was one for files; 0
    where no output is touched: a fit that could not be kept for --resume, which
    a line says, or a flush after all is in place;
  - each output is whole, and that of the unbroken run, or not there;
  - --resume ends in what the unbroken run gave.
"""

import json
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile

from outputs import LEFT_BEHIND, contents, fail, failures

MOST_SECONDS = 10  # of its own: a busy machine does not change that
MOST_WAITING = 600  # for what waits for ever
findings = {"runs": 0, "killed in a library": 0, "statuses": {}}


class Study:
    def __init__(self, errmap, preloaded, data, root):
        self.errmap, self.preloaded, self.root = errmap, preloaded, root
        self.words = [
            errmap, "compare", data, "--models",
            "mean,poly:eq8,net:scg:hidden=3:iterations=30,poly:formula=no_such_mm",
            "--holdout", "every:3", "--jobs", "2",
        ]  # fmt: skip
        self.log = root / "log"

    def run(self, folder, fault=None, more=()):
        environment = dict(os.environ)
        self.log.unlink(missing_ok=True)
        if fault:
            environment["LD_PRELOAD"] = self.preloaded
            environment["ERRMAP_FAIL"] = fault
            environment["ERRMAP_FAIL_LOG"] = str(self.log)
        return subprocess.run(
            self.words + ["--out", str(folder), *more],
            env=environment,
            capture_output=True,
            text=True,
            timeout=MOST_WAITING,
            preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS + 1)
            ),
            check=False,
        )

    def calls(self, kind):
        folder = self.root / "counted"
        self.run(folder, f"{kind}:0")
        shutil.rmtree(folder)
        return int(self.log.read_text().split()[-1])

    def sites(self):
        """Places in the program that allocate, as failing_calls.cc names them."""
        folder = self.root / "counted"
        self.run(folder, "site:0")
        shutil.rmtree(folder)
        lines = self.log.read_text().splitlines()
        return sorted(line for line in lines if not line.startswith("calls"))


def judge(study, unbroken, what, folder, outcome, is_file_fault):
    findings["runs"] += 1
    if findings["runs"] % 100 == 0:
        print(findings["runs"], "runs", flush=True)
    status = outcome.returncode
    findings["statuses"][status] = findings["statuses"].get(status, 0) + 1
    lines = outcome.stderr.splitlines()
    log = study.log.read_text() if study.log.exists() else ""
    if status in (-signal.SIGXCPU, -signal.SIGKILL):
        fail(what, "does not end")
    elif status < 0:
        # Libraries that never look at what malloc gives end the program.
        inside = any(name in log for name in ("libopenblas", "libtbb", "libceres"))
        findings["killed in a library"] += inside
        if not inside:
            fail(what, f"ended by signal {-status}:\n{log}{outcome.stderr}")
    elif is_file_fault:
        is_whole = status == 0 and contents(folder) == unbroken
        names_file = any(
            line.startswith("errmap: ") and str(folder) in line for line in lines
        )
        if status != 1 and not is_whole:
            fail(what, f"status {status}: {outcome.stderr}")
        if not names_file and not (is_whole and what.startswith("fsync")):
            fail(what, f"no line names a file: {outcome.stderr}")
    elif status not in (0, 1, 4):
        fail(what, f"status {status}: {outcome.stderr}")
    if status == 1 and not lines:
        fail(what, "status 1 without a word")
    try:
        found = contents(folder) if folder.exists() else {}
    except ValueError as error:
        fail(what, f"an output is not whole: {error}")
        found = {}
    for name, content in found.items():
        if content == LEFT_BEHIND:
            if status >= 0:
                fail(what, f"left {name} behind")
        elif is_file_fault and name != "errmap-files.json" and content != unbroken[name]:
            fail(what, f"{name} is not that of the unbroken run")
    again = study.run(folder, more=["--resume"])
    if again.returncode != 0:
        fail(what, f"--resume: status {again.returncode}: {again.stderr}")
    elif contents(folder) != unbroken:
        fail(what, "--resume ends in other results")


def main():
    errmap, preloaded, data = sys.argv[1:4]
    mallocs = int(sys.argv[4]) if len(sys.argv) > 4 else 60
    most_sites = sys.argv[5] if len(sys.argv) > 5 else "10"
    kinds = ("write", "fsync", "rename", "open", "ftruncate")
    if "--only-memory" in sys.argv:
        kinds = ()
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(scratch)
        study = Study(errmap, preloaded, data, root)
        if study.run(root / "unbroken").returncode != 0:
            sys.exit("the study itself fails")
        unbroken = contents(root / "unbroken")
        faults = []
        for kind in kinds:
            count = study.calls(kind)
            print(kind, count, "calls")
            faults += [(f"{kind}:{n + 1}", True) for n in range(count)]
        count = study.calls("malloc")
        print("malloc", count, "calls")
        draw = random.Random(1995)
        faults += [(f"malloc:{draw.randint(1, count)}", False) for _ in range(mallocs)]
        sites = study.sites()
        print("site", len(sites), "places")
        if most_sites != "all":
            sites = draw.sample(sites, min(int(most_sites), len(sites)))
        faults += [(f"site:{site}", False) for site in sites]
        try:
            for fault, is_file_fault in faults:
                folder = root / "study"
                shutil.rmtree(folder, ignore_errors=True)
                try:
                    outcome = study.run(folder, fault)
                except subprocess.TimeoutExpired:
                    fail(fault, "does not end")
                    continue
                judge(study, unbroken, fault, folder, outcome, is_file_fault)
        except KeyboardInterrupt:
            print("broken off; so far:")
    print(json.dumps(findings))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
