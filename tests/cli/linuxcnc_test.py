"""Exported maps in the real LinuxCNC: halcompile, halrun, motion controller.

  linuxcnc_test.py ERRMAP

Needs root, to install components and to make the user that LinuxCNC runs as
(it refuses root); both are taken away at the end. Skips (status 77) with the
line that says why where it cannot.
"""

import csv
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time
import types

import exports_fail_test

HERE = pathlib.Path(__file__).resolve().parent / "linuxcnc"
USER = "errmap-linuxcnc"
MODULES = pathlib.Path("/usr/lib/linuxcnc/modules")
PYTHON = "/usr/bin/python3"  # Debian's: it has the modules hal and linuxcnc
SENSORS = ["t03_degC", "t12_degC", "t15_degC"]
SECONDS = 150

HALRUN = """loadrt threads name1=servo-thread period1=1000000
loadrt {component}
loadrt integ
addf {hal} servo-thread
addf integ.0 servo-thread
setp integ.0.in 1
setp {hal}.max-rate 1e9
setp {hal}.step-s 1
{more}start
loadusr -w {python} {here}/feed_component.py {hal} case.json result.json
"""

INI = """[EMC]
VERSION = 1.1
MACHINE = errmap
[DISPLAY]
DISPLAY = {here}/move_axis.py {folder}/case.json {folder}/result.json
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = {folder}/linuxcnc.var
[EMCMOT]
EMCMOT = motmod
SERVO_PERIOD = 1000000
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = {folder}/tool.tbl
[HAL]
{halfiles}
[TRAJ]
COORDINATES = XYZ
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
MAX_LINEAR_VELOCITY = 500
[KINS]
KINEMATICS = trivkins coordinates=XYZ
JOINTS = 3
{axes}"""

AXIS = """[AXIS_{letter}]
MIN_LIMIT = -500
MAX_LIMIT = 500
MAX_VELOCITY = 500
MAX_ACCELERATION = {acceleration}
{axis_more}
[JOINT_{number}]
TYPE = LINEAR
MIN_LIMIT = -500
MAX_LIMIT = 500
MAX_VELOCITY = 500
MAX_ACCELERATION = {acceleration}
HOME = 0
HOME_SEQUENCE = 0
FERROR = 1
MIN_FERROR = 1
{joint_more}
"""

CORE_HAL = """loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
addf motion-command-handler servo-thread
addf motion-controller servo-thread
net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net Y joint.1.motor-pos-cmd => joint.1.motor-pos-fb
net Z joint.2.motor-pos-cmd => joint.2.motor-pos-fb
"""
LOOP_X = "net X joint.0.motor-pos-cmd => joint.0.motor-pos-fb\n"

failures = []


def skip(why):
    print("skipped: " + why)
    sys.exit(77)


def check(what, holds, found=None):
    print(("ok    " if holds else "FAILED ") + what
          + ("" if holds else f" (found {found})"))
    if not holds:
        failures.append(what)


def run(*words, folder=None, **more):
    return subprocess.run(words, cwd=folder, capture_output=True, text=True,
                          timeout=SECONDS, check=True, **more)


class Bench:
    """A folder of the user's with exported maps in it."""

    def __init__(self, errmap, folder):
        self.errmap = errmap
        self.folder = folder
        self.components = []

    def errmap_run(self, *words):
        return run(self.errmap, *words, folder=self.folder)

    def prepare(self):
        self.errmap_run("simulate", "turning-centre", "-o", "sim", "--days",
                        "3", "--cycles", "4", "--seed", "3", "--quiet")
        inputs = ",".join(["position_mm"] + SENSORS)
        for direction in ("up", "down"):
            self.errmap_run(
                "fit", f"sim/x_displacement_{direction}.csv", "--model",
                "poly:ridge:view=history+zero", "--inputs", inputs, "-o",
                direction + ".json", "--quiet", "--no-interval")

    def install(self, name, *maps):
        self.errmap_run("export", *maps, "--hal", "--python", "--name", name,
                        "-o", ".", "--quiet")
        run("halcompile", "--install", f"errmap_{name}.comp",
            folder=self.folder)
        self.components.append("errmap_" + name)

    def remove(self):
        for component in self.components:
            (MODULES / (component + ".so")).unlink(missing_ok=True)

    def rows(self, *directions):
        """The first session: seconds since the row before, then readings."""
        table = []
        for direction in directions or ["up"]:
            with open(self.folder / f"sim/x_displacement_{direction}.csv",
                      encoding="utf-8") as file:
                table += [row for row in csv.DictReader(file)
                          if row["day"] == "1"]
        table.sort(key=lambda row: float(row["time_s"]))
        rows, before = [], None
        for row in table:
            time = float(row["time_s"])
            rows.append([0.0 if before is None else time - before]
                        + [float(row[name])
                           for name in ["position_mm"] + SENSORS])
            before = time
        return rows

    def predict(self, rows, model="up.json"):
        """What `errmap predict` says of such a session."""
        time = 0.0
        with open(self.folder / "rows.csv", "w", encoding="utf-8") as file:
            file.write("day,time_s,position_mm," + ",".join(SENSORS) + "\n")
            for dt, *readings in rows:
                time += dt
                file.write("1,%r," % time
                           + ",".join(repr(value) for value in readings)
                           + "\n")
        out = self.errmap_run("predict", model, "rows.csv").stdout
        return [float(row["predicted"])
                for row in csv.DictReader(out.splitlines())]

    def as_user(self, *words):
        """Runs LinuxCNC, which says little when it fails: its log if so."""
        shutil.chown(self.folder, USER)
        for path in self.folder.rglob("*"):
            shutil.chown(path, USER)
        result = self.folder / "result.json"
        result.unlink(missing_ok=True)
        for _ in range(3):
            found = subprocess.run(
                ["runuser", "-u", USER, "--", "env", f"HOME={self.folder}",
                 *words], cwd=self.folder, capture_output=True, text=True,
                timeout=SECONDS, check=False)
            # The session before may still hold HAL's shared memory.
            if "could not open shared memory" not in found.stdout + found.stderr:
                break
            time.sleep(1.0)
        if not result.exists():
            print(found.stdout[-2000:], found.stderr[-2000:])
            return {"failed": "no result"}
        return json.loads(result.read_text(encoding="utf-8"))

    def can_run(self, more=""):
        """Whether this system lets LinuxCNC's real-time part run at all, and
        what `more` loads."""
        (self.folder / "probe.hal").write_text(
            "loadrt threads name1=servo-thread period1=1000000\n" + more
            + "start\n")
        shutil.chown(self.folder, USER)
        return subprocess.run(
            ["runuser", "-u", USER, "--", "env", f"HOME={self.folder}",
             "halrun", "-f", "probe.hal"], cwd=self.folder,
            capture_output=True, timeout=SECONDS, check=False).returncode == 0

    def feed(self, what, name="up", more="", **case):
        case = {"what": what,
                "pins": ["position"] + ["in-" + name.replace("_", "-")
                                        for name in SENSORS], **case}
        (self.folder / "case.json").write_text(json.dumps(case))
        (self.folder / "run.hal").write_text(HALRUN.format(
            component="errmap_" + name, hal="errmap-" + name, python=PYTHON,
            here=HERE, more=more))
        return self.as_user("halrun", "-f", "run.hal")

    # At lower accelerations LinuxCNC's filter of a COMP_FILE may stand still
    # half-way; at higher ones it stops external offsets further off.
    def move(self, what, halfiles, axis_more="", joint_more="",
             acceleration=50000, **case):
        (self.folder / "case.json").write_text(
            json.dumps({"what": what, **case}))
        axes = "".join(AXIS.format(letter=letter, number=number,
                                   acceleration=acceleration,
                                   axis_more=axis_more if number == 0 else "",
                                   joint_more=joint_more if number == 0 else "")
                       for number, letter in enumerate("XYZ"))
        (self.folder / "core.hal").write_text(CORE_HAL)
        (self.folder / "loop_x.hal").write_text(LOOP_X)
        (self.folder / "tool.tbl").write_text("")
        (self.folder / "test.ini").write_text(INI.format(
            here=HERE, folder=self.folder, axes=axes,
            halfiles="\n".join("HALFILE = " + name for name in halfiles)))
        return self.as_user("linuxcnc", str(self.folder / "test.ini"))


def check_component(bench):
    rows = bench.rows()
    predicted = bench.predict(rows)
    found = bench.feed("session", rows=rows, predicted=predicted)
    check("the session ran", "failed" not in found, found)
    check("before the first step the offset is 0 and not valid",
          found.get("offset_before") == 0.0
          and not found.get("valid_before", True), found)
    check("every row was one step", found.get("steps") == len(rows), found)
    check("offset = -error of errmap predict to 1e-9 mm",
          found.get("worst", 1.0) < 1e-9, found)

    with_gap = rows[:2] + [[sum(row[0] for row in rows[2:7])] + rows[6][1:]]
    ranges = json.loads((bench.folder / "up.json").read_text())["inputs"][3]
    outside = ranges["max"] + 0.1 * (ranges["max"] - ranges["min"])
    found = bench.feed("missing", rows=rows, predicted=predicted,
                       predicted_with_gap=bench.predict(with_gap)[-1],
                       a_little_outside=outside)
    check("nan, inf, 0 and 10000 keep the last good offset, not valid",
          found.get("held") == [True] * 4, found)
    check("the gap is one step to the first good row",
          abs(found.get("after_gap", 1.0)) < 1e-9
          and found.get("valid_again"), found)
    check("a little outside is said and valid",
          found.get("outside") == [True, True], found)

    fresh = bench.predict([[0.0] + rows[-1][1:]])[0]
    found = bench.feed("zero", rows=rows, predicted=predicted,
                       predicted_fresh=fresh)
    check("the zero is taken anew",
          abs(found.get("zeroed", 1.0)) < 1e-9, found)

    found = bench.feed("limits", rows=rows, predicted=predicted)
    check("the largest offset holds",
          abs(found.get("most", 1.0) - 0.002) < 1e-12, found)
    check("without it the offset is whole",
          abs(found.get("unlimited", 1.0)) < 1e-9, found)
    check("a lowered limit holds at once", found.get("lowered", 1.0) <= 1e-9,
          found)
    check("the largest change per second holds, and it moves",
          found.get("fastest", 1.0) <= 0.01 and found.get("moved", 0.0) > 0.002,
          found)

    found = bench.feed("machine", rows=rows, predicted=predicted)
    counts = found.get("counts", 0)
    check("counts are 0 off, right on, and again after off and on",
          counts != 0 and found.get("machine") == [
              [0, 0, False], [1, counts, True], [0, 0, False],
              [1, counts, True]], found)


def check_exports(bench):
    """A .hal file of another export does not load the component."""
    loads = next(line for line in
                 (bench.folder / "errmap_up.hal").read_text().splitlines()
                 if line.startswith("loadrt errmap_up "))
    check("the export of the .hal file loads", bench.can_run(loads + "\n"), loads)
    check("another one does not",
          not bench.can_run(loads.partition("=")[0] + "=1\n"))


def check_restart(bench):
    """The user part keeps the state in a file, and a restart goes on there."""
    rows = bench.rows()[:40]
    at = 20
    state = bench.folder / "kept.json"
    # At rates of no limit a step after the restart shows the filters alone.
    part = (f"loadusr -Wn errmap-up-state {PYTHON} ./errmap_up_state.py "
            "kept.json 0.2\n")
    found = bench.feed("leave", more=part, rows=rows[:at])
    check("the state is kept in a file",
          "failed" not in found and state.exists(), found)
    found = bench.feed("go_on", more=part, rows=rows[at:])
    away = found.get("away", 0.0)
    unbroken = [list(row) for row in rows]
    unbroken[at][0] += away
    expected = bench.predict(unbroken)[at:]
    given = found.get("given", [])
    check("restarted with its state it goes on as if it had not been away",
          found.get("restored") is True and 0.0 < away < SECONDS
          and len(given) == len(expected) and all(
              abs(offset + error) < 1e-9
              for (offset, _), error in zip(given, expected)),
          (found, expected))
    check("and does not settle",
          given and all(settling == 0.0 for _, settling in given), given)
    kept = json.loads(state.read_text())
    for what, wrong in (
            ("too old", {**kept, "time": kept["time"] - 1e8}),
            ("of another map", {**kept, "state": [1.5] + kept["state"][1:]}),
            ("cut", {**kept, "state": kept["state"][:-1]}),
            ("no state", {})):
        state.write_text(json.dumps(wrong))
        found = bench.feed("go_on", more=part, rows=rows[at:at + 2])
        check(f"a file that is {what} is not taken, and it settles",
              found.get("restored") is False and all(
                  settling > 0.0 for _, settling in found.get("given", [(0, 0)])),
              found)


def check_pair(bench):
    rows = bench.rows("up", "down")
    up, down = bench.predict(rows), bench.predict(rows, "down.json")
    direction = exports_fail_test.Direction(0.02)
    predicted, turns = [], 0
    for row, errors in zip(rows, zip(up, down)):
        turns += direction.follow(row[1])
        predicted.append(errors[direction.down])
    found = bench.feed("session", "pair", rows=rows, predicted=predicted)
    check("the map of each direction of motion acts in it to 1e-9 mm",
          found.get("worst", 1.0) < 1e-9 and turns > 5, (found, turns))


def check_failures(bench, count=12):
    """The component as the exported Python, whatever fails."""
    chance = random.Random(11)
    module = types.ModuleType("pair")
    exec((bench.folder / "pair.py").read_text(), module.__dict__)
    session = module.Map()
    session.max_rate = 1e9
    rows = bench.rows("up", "down")[:60]
    rows[0][0] = 1.0
    kinds = ["zero", "stuck", "plus 50", "nan", "swapped", "delayed"]
    sessions, expected = [], []
    for i in range(count):
        which = chance.randrange(2, len(rows[0]))
        begin = chance.randrange(1, 30)
        sessions.append(exports_fail_test.fail(
            rows, kinds[i % len(kinds)], which, begin, begin + 20,
            which % (len(rows[0]) - 1) + 1))
        session.begin()
        expected.append([])
        for dt, *readings in sessions[-1]:
            status = session.read(dt, readings)
            error, moved = session.move(1e6)
            expected[-1].append([-error, status | moved])
    found = bench.feed("failures", "pair", sessions=sessions)
    given = [row for rows in found.get("given", []) for row in rows]
    wanted = [row for rows in expected for row in rows]
    held = sum(status & module.NOT_TAKEN != 0 for _, status in wanted)
    check(f"{count} failures: offset and status as in Python, {held} rows held",
          len(given) == len(wanted) and held > 20 and all(
              abs(mine[0] - other[0]) < 1e-9 and mine[1] == other[1]
              for mine, other in zip(given, wanted)),
          found.get("failed") or [pair for pair in zip(given, wanted)
                                  if pair[0][1] != pair[1][1]
                                  or abs(pair[0][0] - pair[1][0]) >= 1e-9][:3])
    check("no offset leaves the limit", given and all(
        abs(offset) <= session.max_error * (1 + 1e-12) for offset, _ in given))


def check_comp_file(bench):
    said = bench.errmap_run(
        "export", "--linuxcnc", "--increasing", "up.json", "--decreasing",
        "down.json", "-o", "x.comp.txt", "--points", "16", "--log",
        "sim/x_displacement_up.csv").stderr
    words = said.split("it is off by up to ")[1].split()
    assert words[1] == "um", said
    printed = float(words[0]) / 1000.0

    # The map itself at that thermal state, by a table of 256 points each.
    positions = [-210.0 + 190.0 * i / 49.0 for i in range(50)]
    exact = {}
    for direction in ("up", "down"):
        bench.errmap_run("export", "--linuxcnc", direction + ".json", "-o",
                         direction + ".txt", "--log",
                         "sim/x_displacement_up.csv", "--quiet")
        exact[direction] = [
            [float(word) for word in line.split()]
            for line in (bench.folder / (direction + ".txt")).read_text()
            .splitlines()]

    def error(direction, position):
        table = exact[direction]
        above = next(i for i, row in enumerate(table) if row[0] >= position)
        low, high = table[max(above - 1, 0)], table[above]
        share = (position - low[0]) / ((high[0] - low[0]) or 1.0)
        return ((1 - share) * (low[1] - low[0])
                + share * (high[1] - high[0]))

    found = bench.move(
        "compensation", ["core.hal", "loop_x.hal"],
        joint_more=f"COMP_FILE = {bench.folder}/x.comp.txt\n"
                   "COMP_FILE_TYPE = 0", positions=positions)
    pairs = found.get("found", [])
    check("the motion controller moved to 50 positions from both sides",
          len(pairs) == 100, found)
    # LinuxCNC renews the correction while the joint moves only, so that it is
    # that of one period before rest: 2e-4 of slope times the last 2 um.
    lag = 5e-7
    worst = swapped = 0.0
    for position, increasing, filtered, added in pairs:
        right = -error("up" if increasing else "down", position)
        wrong = -error("down" if increasing else "up", position)
        worst = max(worst, abs(filtered - right), abs(added - right))
        swapped = max(swapped, abs(filtered - wrong))
    check("it adds -error of the map of its direction within the printed error",
          pairs and worst <= printed + lag, (worst, printed))
    check("the other way round would be found out",
          swapped > 10.0 * (printed + lag), swapped)


def check_wiring(bench):
    # Sensors that stand still, and a position of the joint's own.
    row = bench.rows()[0]
    setp = "".join(
        f"setp errmap-up.in-{name.replace('_', '-')} {value}\n"
        for name, value in zip(SENSORS, row[2:]))
    (bench.folder / "sensors.hal").write_text(
        setp + "setp errmap-up.max-rate 1e9\n")
    positions = [-200.0, -120.0, -40.0]
    predicted = bench.predict([[0.0, position] + row[2:]
                               for position in positions])

    found = bench.move("offset", ["core.hal", "errmap_up.hal", "sensors.hal"],
                       component="errmap-up", positions=positions)
    rows = found.get("found", [])
    check("the motor goes to the command less the error",
          len(rows) == 3 and all(
              abs(offset + error) < 1e-9 and abs(added - offset) < 1e-9
              for (_, offset, added, _), error in zip(rows, predicted)), found)
    check("the controller sees no following error",
          len(rows) == 3 and all(abs(row[3]) < 1e-6 for row in rows), found)
    check("the offset holds through machine off and on",
          all(abs(found.get(key, [1.0, 1.0])[0] + predicted[-1]) < 1e-9
              and abs(found[key][1]) < 1e-6 for key in ("off", "on_again")),
          found)

    found = bench.move(
        "external", ["core.hal", "loop_x.hal", "errmap_up_eoffset.hal",
                     "sensors.hal"], axis_more="OFFSET_AV_RATIO = 0.2",
        component="errmap-up", positions=positions, acceleration=2000)
    rows = found.get("found", [])
    short = 2e-6  # a count, and LinuxCNC stops a little short
    # The position that the map reads has the offset in it: 30 um of 2e-4.
    moved = 1e-5
    check("external offsets reach -error",
          len(rows) == 3 and all(
              abs(wanted + error) < moved and abs(reached - wanted) < short
              for (wanted, reached), error in zip(rows, predicted)), found)
    again = found.get("on_again", [0.0, 1.0])
    check("they are right again after machine off and on",
          abs(again[0] + predicted[-1]) < moved
          and abs(again[1] - again[0]) < short, found)


def main():
    errmap = os.path.abspath(sys.argv[1])
    for program in ("halcompile", "halrun", "linuxcnc", "runuser", "useradd"):
        if shutil.which(program) is None:
            skip(f"no {program}; apt-get install linuxcnc-uspace "
                 "linuxcnc-uspace-dev")
    if os.geteuid() != 0:
        skip("needs root, to install components and to make a user")
    made_user = subprocess.run(["id", USER], capture_output=True,
                               check=False).returncode != 0
    if made_user:
        run("useradd", "--system", "--shell", "/bin/sh", "--home-dir",
            "/nonexistent", USER)
    try:
        with tempfile.TemporaryDirectory(prefix="errmap_linuxcnc_") as folder:
            bench = Bench(errmap, pathlib.Path(folder))
            if not bench.can_run():
                skip("halrun does not run on this system")
            try:
                bench.prepare()
                bench.install("up", "up.json")
                bench.install("pair", "--increasing", "up.json", "--decreasing",
                              "down.json")
                check_component(bench)
                check_exports(bench)
                check_restart(bench)
                check_pair(bench)
                check_failures(bench)
                check_comp_file(bench)
                check_wiring(bench)
            finally:
                bench.remove()
    finally:
        if made_user:
            run("userdel", USER)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
