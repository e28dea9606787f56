"""What exported maps do while something is wrong, counted over many runs.

  exports_hold_test.py ERRMAP [MAPS [SEED]]

Twelve maps of six simulated days run through two further ones in C, in Python,
as LinuxCNC's component and, where matiec is at hand, in structured text with
LREAL and with REAL, while each sensor in turn is dead, hangs from the first
row, a quarter or a half of the day, is 3 or 10 K off or exchanged with the
next, all hang together, the limits are negative, no number or huge, a retained
number is damaged, the axis is beyond its travel or Start is held. Counted is
how often the error leaves the limit, how often it is long worse than none while
the map calls itself healthy, how soon a sensor that hangs is found, and how
good the map is while one is lost. Twenty healthy machines of another kind run
ten days each with their nights. Needs a C compiler; skips (status 77) without.
"""

import functools
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

import exported_maps as bench
from component_in_c import component_in_c
from exported_maps import Exported, check, run
from healthy_machines import DRIVER, answers, check_healthy_machines

HOLD = 60.0  # s
WORSE = 3e-3  # mm worse than no compensation
SINGLE = 1e-6  # of a limit: how REAL rounds it


TEXT_DRIVER = """#include <stdio.h>
#include "accessor.h"
#include "iec_std_lib.h"
TIME __CURRENT_TIME;
BOOL __DEBUG;
#include "POUS.h"
#include "POUS.c"
static {0} B;
static void restart(int damaged, double value) {{
  __SET_VAR((&B)->,RUNNING,,0);
  __SET_VAR((&B)->,AWAYSECONDS,,1.0);
  switch (damaged) {{
{4}  }}
}}
int main(void) {{
  double start, dt, max_error, max_rate, value, x[{1}];
  {0}_init__(&B, 0);
  while (scanf("%lf %lf %lf %lf", &start, &dt, &max_error, &max_rate) == 4) {{
    int i, damaged;
    for (i = 0; i < {1}; ++i) if (scanf("%lf", &x[i]) != 1) return 1;
    if (start == 9.0) {{
      if (scanf("%d %lf", &damaged, &value) != 2) return 1;
      restart(damaged, value);
    }}
    if (start == 1.0) {0}_init__(&B, 0);
    __SET_VAR((&B)->,START,,start == 1.0 || start == 5.0);
    __SET_VAR((&B)->,DTSECONDS,,dt);
    __SET_VAR((&B)->,MAXERROR,,max_error);
    __SET_VAR((&B)->,MAXRATE,,max_rate);
{2}    {0}_body__(&B);
    i = 0;
{3}    printf("%.17g %d\\n", (double)__GET_VAR(B.ERROR), i);
  }}
  return 0;
}}
"""


class Map(Exported):
    """One of the maps of the test of failing sensors, of more days."""

    def prepare(self):
        self.own = self.map.Map()
        self.alarm = self.map.UNHEALTHY
        (self.folder / "hold.c").write_text(DRIVER.format(self.name))
        run("cc", "-std=c99", "-O1", "hold.c", self.name + ".c", "-o",
            self.name + ".hold", "-lm", folder=self.folder)
        sensors = [i + 1 for i in range(len(self.map.INPUTS))
                   if i != self.position]
        self.sensors = sensors
        hal = "hal_" + self.name
        maps = (self.files if len(self.files) == 1 else
                ["--increasing", self.files[0], "--decreasing", self.files[1]])
        run(self.errmap, "export", *maps, "--hal", "--name", self.name, "-o",
            hal, "--quiet", folder=self.folder)
        component, self.kept = component_in_c(
            (self.folder / hal / f"errmap_{self.name}.comp").read_text(),
            len(self.map.INPUTS))
        (self.folder / hal / "hold.c").write_text(component)
        run("cc", "-std=c99", "-O1", "-w", "hold.c", "-o", "hold", "-lm",
            folder=self.folder / hal)
        self.component = str(self.folder / hal / "hold")

    def languages(self):
        """Name, runner (rows, limits) -> answers, and how near to C's."""
        yield "Python", self.by_python, 1e-12
        yield "HAL", self.by_hal, 1e-12
        if bench.has_compiler():
            yield "ST", self.by_text, 1e-12
            yield "ST, REAL", functools.partial(
                self.by_text, where="single"), None

    def by_hal(self, rows, limits=None, flags=None):
        return answers(run(self.component,
                           text=self.lines_of(rows, limits, flags)))

    def lines_of(self, rows, limits=None, flags=None):
        limits = limits or (self.own.max_error, self.own.max_rate)
        flags = flags or {}
        return "".join(
            f"{flags.get(i, 1 if i == 0 else 0)} {row[0]!r} {limits[0]!r} "
            f"{limits[1]!r} " + " ".join(map(repr, row[1:])) + "\n"
            for i, row in enumerate(rows))

    def by_c(self, rows, limits=None):
        return answers(run(str(self.folder / (self.name + ".hold")),
                           text=self.lines_of(rows, limits)))

    def by_python(self, rows, limits=None):
        session = self.map.Map()
        session.begin()
        if limits:
            session.max_error, session.max_rate = limits
        return [session.step(dt, inputs) for dt, *inputs in rows]

    def compile_text(self, where):
        """By matiec; what is retained of it, in the order of its places."""
        exe = self.folder / where / (self.name + ".text")
        text = (self.folder / where / (self.name + ".st")).read_text()
        retained = re.search(r"VAR RETAIN\n(.*?)END_VAR", text, re.S)[1]
        places = []
        for name, size in re.findall(
                r"^  (\w+) : (?:ARRAY\[0\.\.(\d+)\] OF )?L?REAL", retained,
                re.M):
            places += ([f"{name.upper()}.value.table[{i}]"
                        for i in range(int(size) + 1)] if size else
                       [name.upper() + ".value"])
        if exe.exists():
            return exe, places
        iec2c = pathlib.Path(bench.compiler_of_text()).resolve()
        out = self.folder / where / (self.name + "_hold")
        out.mkdir()
        run(str(iec2c), "-I", str(iec2c.parent / "lib"), "-T", str(out),
            self.name + ".st", folder=self.folder / where)
        inputs = re.findall(r"^  (In_\w+) : L?REAL;", text, re.M)
        (out / "driver.c").write_text(TEXT_DRIVER.format(
            self.name.upper() + "_MAP", len(inputs), "".join(
                f"    __SET_VAR((&B)->,{name.upper()},,x[{i}]);\n"
                for i, name in enumerate(inputs)), "".join(
                f"    if (__GET_VAR(B.{bit})) i |= {getattr(self.map, bit)};\n"
                for bit in bench.BITS), "".join(
                f"    case {i}: B.{place} = value; break;\n"
                for i, place in enumerate(places))))
        run("cc", "-O0", "-w", "-I", str(iec2c.parent / "lib" / "C"), "-I",
            str(out), str(out / "driver.c"), "-o", str(exe), "-lm")
        return exe, places

    def by_text(self, rows, limits=None, flags=None, where="."):
        exe, _ = self.compile_text(where)
        return answers(run(str(exe), text=self.lines_of(rows, limits, flags)))


def filled(day, errors):
    """The rows of a day, its pauses filled by steps of 20 s in which sensors
    have their noise, in steps of 0.01 K; and what was measured, None where
    nothing was."""
    noise = random.Random(7)
    rows, truth = [[0.0, *day[0][1:]]], [errors[0]]
    for before, row, error in zip(day, day[1:], errors[1:]):
        passed = row[0] - before[0]
        count = max(1, math.ceil(passed / 20.0))
        for k in range(1, count + 1):
            share = k / count
            rows.append([passed / count] + [
                row[i] if k == count else
                round((1 - share) * before[i] + share * row[i]
                      + noise.gauss(0.0, 0.01), 2)
                for i in range(1, len(row))])
            truth.append(error if k == count else None)
    return rows, truth


def longest_worse(rows, truth, found, alarm):
    """How long it is on end worse than nothing and calls itself healthy (s)."""
    longest = since = 0.0
    for (dt, *_), error, (given, status) in zip(rows, truth, found):
        if error is None:
            if since > 0.0 and not status & alarm:
                since += dt
            continue
        bad = (abs(error - given) - abs(error) > WORSE
               and not status & alarm)
        since = since + dt if bad else 0.0
        longest = max(longest, since)
    return longest


def faults(exported, rows):
    """(what, rows, sensor, first row) of each failure of one sensor."""
    quarter, half = len(rows) // 4, len(rows) // 2
    for which in exported.sensors:
        other = exported.sensors[exported.sensors.index(which) - 1]
        for what, begin in (("dead", quarter), ("hangs", 0), ("hangs", quarter),
                            ("hangs", half), ("3 K off", quarter),
                            ("10 K off", quarter), ("swapped", quarter)):
            failed = [list(row) for row in rows]
            for row in failed[begin:]:
                good = row[which]
                row[which] = {"dead": 0.0, "hangs": rows[begin][which],
                              "3 K off": good + 3.0, "10 K off": good + 10.0,
                              "swapped": row[other]}[what]
                if what == "swapped":
                    row[other] = good
            yield what, failed, which, begin
    failed = [list(row) for row in rows]
    for row in failed[quarter:]:
        for which in exported.sensors:
            row[which] = rows[quarter][which]
    yield "all hang", failed, None, quarter


def found_in_time(exported, rows, which, begin, found):
    """None where the sensor need not move, else whether it was found: it would
    have moved by five steps without its noise, that is on average over nine
    rows."""
    def level(i):
        near = rows[max(0, i - 4):i + 5]
        return sum(row[which] for row in near) / len(near)

    within = 0.1 * sum(row[0] for row in rows)
    passed, moved, told = 0.0, 0.0, False
    for i in range(begin, len(rows)):
        passed += rows[i][0] if i > begin else 0.0
        if passed > within:
            break
        moved = max(moved, abs(level(i) - level(begin)))
        told = told or bool(found[i][1] & exported.map.NOT_TAKEN)
    return told if moved >= 5 * 0.01 else None


def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else 0.0


class Counts:
    """What was counted of one language."""

    def __init__(self):
        self.runs = self.worse = self.beyond = self.other = 0
        self.hang = {}
        self.by_fault = {}

    def add(self, what, longest, beyond):
        self.runs += 1
        self.worse += longest > HOLD
        self.beyond += beyond
        runs, worse = self.by_fault.get(what, (0, 0))
        self.by_fault[what] = runs + 1, worse + (longest > HOLD)

    def told(self):
        return [one for some in self.hang.values() for one in some]


def beyond_limit(found, limit, share=1e-12):
    return sum(not abs(error) <= limit * (1 + share) for error, _ in found)


class Trial:
    """Runs of faults of one map, counted by language."""

    def __init__(self, exported, counts):
        self.exported, self.counts = exported, counts

    def alone(self, rows, truth):
        """How long the map itself is worse than nothing: no fault shows then."""
        return longest_worse(rows, truth, self.exported.by_c(rows),
                             self.exported.alarm)

    def run(self, what, rows, truth, limits=None, hangs=None):
        """What C gives, once all languages are counted; no truth, none worse."""
        mine = self.exported
        found = mine.by_c(rows, limits)
        for name, given, near in [("C", found, 0.0)] + [
                (name, by(rows, limits), near)
                for name, by, near in mine.languages()]:
            self.count(self.counts.setdefault(name, Counts()), what, rows,
                       truth, given, hangs,
                       1e-12 if near is not None else SINGLE)
            if near is not None:
                self.compare(name, what, found, given, near)
        return found

    def count(self, counts, what, rows, truth, given, hangs, share):
        mine = self.exported
        counts.add(what, longest_worse(rows, truth, given, mine.alarm)
                   if truth else 0.0,
                   beyond_limit(given, mine.own.max_error, share))
        if hangs:
            told = found_in_time(mine, *hangs, given)
            if told is not None:
                counts.hang.setdefault(mine.name, []).append(told)

    def compare(self, name, what, found, given, near):
        limit = self.exported.own.max_error
        self.counts[name].other += found != given
        check(f"{self.exported.name}, {what}: {name} agrees with C",
              len(found) == len(given) and all(
                  abs(a[0] - b[0]) <= near * limit and a[1] == b[1]
                  for a, b in zip(found, given)),
              next(((i, a, b) for i, (a, b) in enumerate(zip(found, given))
                    if a != b), None))


def check_sensors(trial, days):
    exported = trial.exported
    for rows, truth in days:
        alone = trial.alone(rows, truth)
        print(f"{exported.name}: {sum(row[0] for row in rows):.0f} s, healthy "
              f"it is worse than nothing for {alone:.0f} s")
        for what, failed, which, begin in faults(exported, rows):
            trial.run(what, failed, truth if alone <= HOLD else None,
                      hangs=((rows, which, begin) if what == "hangs"
                             else None))


def check_limits(trial, rows, truth):
    exported = trial.exported
    own = exported.own
    for limits in ((-own.max_error, own.max_rate), (math.nan, own.max_rate),
                   (1e30, own.max_rate), (0.0, own.max_rate),
                   (own.max_error, -own.max_rate), (own.max_error, math.nan),
                   (own.max_error, 1e30), (own.max_error, 0.0)):
        found = trial.run("limits", rows, truth, limits)
        usable = limits == (own.max_error, 1e30)
        check(f"{exported.name}, limits {limits}: said",
              all(bool(status & exported.map.PARAMETER) != usable
                  for _, status in found))
    lowered = 0.1 * own.max_error
    session = exported.map.Map()
    session.begin()
    for i, (dt, *inputs) in enumerate(rows):
        if i == len(rows) // 2:
            session.max_error = lowered
        error, _ = session.step(dt, inputs)
        check(exported.name + ": a lowered limit holds at once",
              i < len(rows) // 2 or abs(error) <= lowered, error)


def check_damage(trial, rows):
    """A state of which one number was changed is not gone on from."""
    exported = trial.exported
    limit = exported.own.max_error
    session = exported.map.Map()
    session.begin()
    for dt, *inputs in rows[:20]:
        session.step(dt, inputs)
    saved = session.get_state()
    check(exported.name + ": its own state is taken",
          exported.map.Map().set_state(saved, 1.0))
    counts = trial.counts.setdefault("Python", Counts())
    for name, value in saved.items():
        places = range(len(value)) if isinstance(value, list) else [None]
        for at in places:
            for wrong in (math.nan, math.inf, 1e9, -1.0):
                changed = {key: list(kept) if isinstance(kept, list) else kept
                           for key, kept in saved.items()}
                if at is None:
                    changed[name] += wrong
                else:
                    changed[name][at] += wrong
                anew = exported.map.Map()
                check(f"{exported.name}: no state with another {name}",
                      not anew.set_state(changed, 1.0))
                counts.add("damaged", 0.0, beyond_limit(
                    [anew.step(0.0, rows[20][1:])], limit))
    programs = [("HAL", exported.component, range(exported.kept), 1e-12)]
    if bench.has_compiler():
        programs += [("ST", *exported.compile_text("."), 1e-12),
                     ("ST, REAL", *exported.compile_text("single"), SINGLE)]
    for name, exe, places, share in programs:
        counts = trial.counts.setdefault(name, Counts())
        text = exported.lines_of(rows[:20]) + exported.lines_of(
            [[0.0] + rows[20][1:]], flags={0: 9}).rstrip("\n")
        for i, wrong in [(-1, 0.0)] + [
                (i, wrong) for i in range(len(places))
                for wrong in (math.nan, 1e9, -7.25)]:
            out = answers(run(str(exe), text=f"{text} {i} {wrong!r}\n"))
            if i < 0:
                check(f"{exported.name}, {name}: goes on", abs(
                    out[-1][0] - out[-2][0]) <= abs(out[-2][0]) / 2, out[-2:])
                continue
            check(f"{exported.name}, {name}: {places[i]} = {wrong} is not gone "
                  "on from", abs(out[-1][0]) <= share * limit, out[-2:])
            counts.add("damaged", 0.0, beyond_limit(out[-1:], limit, share))


def check_travel(trial, rows):
    """At the end of the travel, then refused."""
    exported = trial.exported
    at = exported.position + 1
    ends = [min(row[at] for row in rows), max(row[at] for row in rows)]
    travel = ends[1] - ends[0]
    for end, way in zip(ends, (-1, 1)):
        held = [list(row) for row in rows]
        for row in held[10:]:
            row[at] = end
        expected = exported.by_c(held)
        for beyond in (0.5, 1.0, 2.0):
            there = [list(row) for row in rows]
            for row in there[10:]:
                row[at] = end + way * (beyond * travel + 1e-3 * (beyond == 1.0))
            # What was measured was measured elsewhere.
            found = trial.run("beyond", there, None)
            if beyond < 1.0:
                check(f"{exported.name}: as at the end of the travel",
                      all(abs(a[0] - b[0]) <= 1e-12
                          for a, b in zip(found, expected)))
                continue
            check(f"{exported.name}: {beyond} travels beyond is refused",
                  all(status & exported.map.FAR and status & exported.alarm
                      for _, status in found[10:]))


def check_start_held(trial, rows, truth):
    exported = trial.exported
    flags = {i: 5 for i in range(1, len(rows))}
    runners = [("HAL", exported.by_hal, {}, 1e-12)]
    if bench.has_compiler():
        runners += [("ST", exported.by_text, {}, 1e-12),
                    ("ST, REAL", exported.by_text, {"where": "single"}, SINGLE)]
    for name, by, how, share in runners:
        held = by(rows, flags=flags, **how)
        check(f"{exported.name}, {name}: Start acts by its edge",
              held == by(rows, **how))
        trial.count(trial.counts.setdefault(name, Counts()), "Start held", rows,
                    truth, held, None, share)


def check_mixed(exported, errmap):
    """The header of one export and the source of another do not compile."""
    old = exported.folder / (exported.name + "_old")
    run(errmap, "export", exported.files[0], "--c", "--name", exported.name,
        "--max-offset", "33um", "-o", str(old), "--quiet",
        folder=exported.folder)
    for here, there in ((exported.folder, old), (old, exported.folder)):
        mixed = exported.folder / (exported.name + "_mixed")
        mixed.mkdir(exist_ok=True)
        for place, end in ((here, ".c"), (there, ".h")):
            shutil.copy(place / (exported.name + end), mixed)
        found = subprocess.run(["cc", "-c", exported.name + ".c"], cwd=mixed,
                               capture_output=True, text=True, check=False)
        check(exported.name + ": a mixed set does not compile",
              found.returncode != 0 and "from two exports" in found.stderr,
              found.stderr[:200])


def lost_and_moving(exported, days):
    """(map, lost) errors over the hold, with each sensor lost, the axis on its
    way."""
    own, lost = [], []
    for rows, truth in days:
        healthy = exported.by_c(rows)
        for which in exported.sensors:
            for begin in range(20, len(rows), 40):
                failed = [list(row) for row in rows]
                passed, end = 0.0, begin
                while end < len(rows) and passed + rows[end][0] <= HOLD:
                    failed[end][which] = math.nan
                    passed += rows[end][0]
                    end += 1
                found = exported.by_c(failed[:end])
                for i in range(begin, end):
                    if truth[i] is None:
                        continue
                    own.append(truth[i] - healthy[i][0])
                    lost.append(truth[i] - found[i][0])
    return own, lost


def days_of(exported, file):
    """The days of a file with what was measured, filled."""
    import csv
    errors = {}
    with open(exported.folder / file, encoding="utf-8") as text:
        for row in csv.DictReader(text):
            errors.setdefault(row["day"], []).append(float(row["error_mm"]))
    return [filled(rows, errors[day])
            for day, rows in exported.read_days(file).items()]


def table(counts):
    lines = ["runs, steps beyond the limit, runs healthy and worse than "
             "nothing for longer than the hold, hanging sensors found in time, "
             "runs whose answers are not C's bit for bit:"]
    for name, of in counts.items():
        told = of.told()
        lines.append(f"{name:9} {of.runs:6} {of.beyond:4} {of.worse:4} "
                     f"{sum(told):4} of {len(told):4} {of.other:4}; "
                     + ", ".join(f"{what} {worse}/{runs}" for what,
                                 (runs, worse) in of.by_fault.items()))
    return "\n".join(lines)


def main():
    errmap = os.path.abspath(sys.argv[1])
    names = (sys.argv[2].split(",") if len(sys.argv) > 2 and sys.argv[2]
             else list(bench.MAPS))
    seed = sys.argv[3] if len(sys.argv) > 3 else "3"
    if shutil.which("cc") is None:
        print("skipped: no C compiler")
        sys.exit(77)
    counts = {}
    with tempfile.TemporaryDirectory(prefix="errmap_hold_") as name:
        folder = pathlib.Path(name)
        run(errmap, "simulate", "turning-centre", "-o", "sim", "--days", "8",
            "--cycles", "6", "--seed", seed, "--quiet", folder=folder)
        known, further = bench.split_days(folder / "sim", 6)
        own, lost = [], []
        for name in names:
            exported = Map(name, known, errmap, interval=True)
            exported.prepare()
            ways = ["up", "down"] if name == "pair" else ["down"]
            days = days_of(exported, bench.write_days(
                further / (name + ".csv"), ways))
            trial = Trial(exported, counts)
            check_sensors(trial, days)
            rows, truth = days[0][0][:300], days[0][1][:300]
            if trial.alone(rows, truth) > HOLD:
                truth = None
            check_limits(trial, rows, truth)
            check_damage(trial, rows)
            check_travel(trial, rows)
            check_start_held(trial, rows, truth)
            if name != "pair":
                check_mixed(exported, errmap)
            of_map, of_lost = lost_and_moving(exported, days)
            own += of_map
            lost += of_lost
            print(f"{name}: own RMS {1e3 * rms(of_map):.2f} um, with a sensor "
                  f"lost {1e3 * rms(of_lost):.2f} um")
        check_healthy_machines(folder, errmap, 20, 10)
    print(table(counts))
    print(f"a sensor lost, over the hold: {1e3 * rms(lost):.2f} um, the maps' "
          f"own {1e3 * rms(own):.2f} um")
    for name, of in counts.items():
        told = of.told()
        check(name + ": no step beyond the limit", of.beyond == 0, of.beyond)
        check(name + ": healthy and worse than nothing in one run of a hundred "
              "at most", of.worse <= 0.01 * of.runs, of.by_fault)
        check(name + ": hanging sensors are found",
              sum(told) >= 0.95 * len(told))
    check("the hold is as good as the map", rms(lost) <= 1.5 * rms(own))
    if not bench.has_compiler():
        print("structured text was not run: no iec2c (matiec) on the PATH, in "
              "IEC2C or to be built from MATIEC_SOURCE")
    print("WRONG" if bench.failures else "right")
    return 1 if bench.failures else 0


if __name__ == "__main__":
    sys.exit(main())
