"""What exported maps do while something is wrong, counted over many runs.

  exports_hold_test.py ERRMAP [MAPS]

Twelve maps of six simulated days run through two further ones in C, in Python
and, where matiec is at hand, in structured text with LREAL and with REAL, while
each sensor in turn is dead, hangs from the first row, a quarter or a half of the
day, is 3 or 10 K off or exchanged with the next, all hang together, the limits
are negative, no number or huge, a retained number is damaged, the axis is
beyond its travel or Start is held. Counted is how often the error leaves the
limit, how often it is long worse than none while the map calls itself healthy,
how soon a sensor that hangs is found, and how good the map is while one is
lost. Twenty healthy machines of another kind run ten days each with their
nights. Needs a C compiler; skips (status 77) without.
"""

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

    def by_text(self, rows, where=".", **how):
        exe, _ = self.compile_text(where)
        return answers(run(str(exe), text=self.lines_of(rows, **how)))


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
    def __init__(self):
        self.runs = self.worse = self.beyond = 0
        self.hang = {}
        self.by_fault = {}

    def add(self, what, longest, beyond):
        self.runs += 1
        self.worse += longest > HOLD
        self.beyond += beyond
        runs, worse = self.by_fault.get(what, (0, 0))
        self.by_fault[what] = runs + 1, worse + (longest > HOLD)


def beyond_limit(found, limit, share=1e-12):
    return sum(not abs(error) <= limit * (1 + share) for error, _ in found)


def check_sensors(exported, days, counts, chance):
    limit = exported.own.max_error
    for rows, truth in days:
        # Where the map itself is worse than nothing no fault shows.
        alone = longest_worse(rows, truth, exported.by_c(rows), exported.alarm)
        print(f"{exported.name}: {sum(row[0] for row in rows):.0f} s, healthy "
              f"it is worse than nothing for {alone:.0f} s")
        for what, failed, which, begin in faults(exported, rows):
            found = exported.by_c(failed)
            longest = longest_worse(failed, truth, found, exported.alarm)
            counts.add(what, longest if alone <= HOLD else 0.0,
                       beyond_limit(found, limit))
            if what == "hangs":
                told = found_in_time(exported, rows, which, begin, found)
                if told is not None:
                    counts.hang.setdefault(exported.name, []).append(told)
            if chance.random() < 0.1:
                check_alike(exported, what, failed, found)


def check_alike(exported, what, rows, found):
    limit = exported.own.max_error
    others = [(exported.by_python(rows), 1e-12)]
    if bench.has_compiler():
        others.append((exported.by_text(rows), 1e-12))
        single = exported.by_text(rows, where="single")
        check(f"{exported.name}, {what}: REAL stays within the limit",
              beyond_limit(single, limit, SINGLE) == 0)
    for other, share in others:
        check(f"{exported.name}, {what}: the languages agree",
              all(abs(a[0] - b[0]) <= share * limit and a[1] == b[1]
                  for a, b in zip(found, other)) and len(found) == len(other),
              next(((i, a, b) for i, (a, b) in enumerate(zip(found, other))
                    if a != b), None))


def check_limits(exported, rows, counts):
    own = exported.own
    for limits in ((-own.max_error, own.max_rate), (math.nan, own.max_rate),
                   (1e30, own.max_rate), (0.0, own.max_rate),
                   (own.max_error, -own.max_rate), (own.max_error, math.nan),
                   (own.max_error, 1e30), (own.max_error, 0.0)):
        found = exported.by_c(rows, limits)
        counts.add("limits", 0.0, beyond_limit(found, own.max_error))
        usable = limits == (own.max_error, 1e30)
        check(f"{exported.name}, limits {limits}: said",
              all(bool(status & exported.map.PARAMETER) != usable
                  for _, status in found))
        check_alike_limits(exported, rows, limits, found)
    lowered = 0.1 * own.max_error
    session = exported.map.Map()
    session.begin()
    for i, (dt, *inputs) in enumerate(rows):
        if i == len(rows) // 2:
            session.max_error = lowered
        error, _ = session.step(dt, inputs)
        check(exported.name + ": a lowered limit holds at once",
              i < len(rows) // 2 or abs(error) <= lowered, error)


def check_alike_limits(exported, rows, limits, found):
    others = [exported.by_python(rows, limits)]
    if bench.has_compiler():
        others.append(exported.by_text(rows, limits=limits))
        check(f"{exported.name}, limits {limits}: REAL stays within",
              beyond_limit(exported.by_text(rows, where="single",
                                            limits=limits),
                           exported.own.max_error, SINGLE) == 0)
    for other in others:
        check(f"{exported.name}, limits {limits}: the languages agree",
              all(abs(a[0] - b[0]) <= 1e-12 * exported.own.max_error
                  for a, b in zip(found, other)))


def check_damage(exported, rows):
    """A state of which one number was changed is not gone on from."""
    session = exported.map.Map()
    session.begin()
    for dt, *inputs in rows[:20]:
        session.step(dt, inputs)
    saved = session.get_state()
    check(exported.name + ": its own state is taken",
          exported.map.Map().set_state(saved, 1.0))
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
                check(f"{exported.name}: no state with another {name}",
                      not exported.map.Map().set_state(changed, 1.0))
    if not bench.has_compiler():
        return
    for where, share in ((".", 1e-12), ("single", SINGLE)):
        _, places = exported.compile_text(where)
        for i in range(-1, len(places)):
            for wrong in (math.nan, 1e9, -7.25):
                text = exported.lines_of(rows[:20])
                after = exported.lines_of([[0.0] + rows[20][1:]], flags={0: 9})
                out = answers(run(str(exported.compile_text(where)[0]),
                                  text=text + after.rstrip("\n")
                                  + f" {i} {wrong!r}\n"))
                goes_on = abs(out[-1][0] - out[-2][0]) <= abs(out[-2][0]) / 2
                if i < 0:
                    check(f"{exported.name}, {where}: goes on", goes_on, out)
                    break
                check(f"{exported.name}, {where}: {places[i]} = {wrong} is "
                      "not gone on from",
                      out[-1][0] == 0.0 or abs(out[-1][0])
                      <= share * exported.own.max_error, out[-2:])


def check_travel(exported, rows):
    """At the end of the travel, then refused."""
    at = exported.position + 1
    ends = [min(row[at] for row in rows), max(row[at] for row in rows)]
    travel = ends[1] - ends[0]
    for end, way in zip(ends, (-1, 1)):
        for beyond in (0.5, 1.0, 2.0):
            there = [list(row) for row in rows]
            for row in there[10:]:
                row[at] = end + way * (beyond * travel + 1e-3 * (beyond == 1.0))
            held = [list(row) for row in rows]
            for row in held[10:]:
                row[at] = end
            found, expected = exported.by_c(there), exported.by_c(held)
            check(f"{exported.name}: {beyond} travels beyond",
                  beyond_limit(found, exported.own.max_error) == 0)
            if beyond < 1.0:
                check(f"{exported.name}: as at the end of the travel",
                      all(abs(a[0] - b[0]) <= 1e-12
                          for a, b in zip(found, expected)))
                continue
            check(f"{exported.name}: {beyond} travels beyond is refused",
                  all(status & exported.map.FAR and status & exported.alarm
                      for _, status in found[10:]))


def check_start_held(exported, rows):
    if not bench.has_compiler():
        return
    flags = {i: 5 for i in range(1, len(rows))}
    for where in (".", "single"):
        held = exported.by_text(rows, where=where, flags=flags)
        check(f"{exported.name}: Start acts by its edge",
              held == exported.by_text(rows, where=where))


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
              found.returncode != 0 and "of two exports" in found.stderr,
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


def main():
    errmap = os.path.abspath(sys.argv[1])
    names = sys.argv[2].split(",") if len(sys.argv) > 2 else list(bench.MAPS)
    if shutil.which("cc") is None:
        print("skipped: no C compiler")
        sys.exit(77)
    chance = random.Random(11)
    counts = Counts()
    with tempfile.TemporaryDirectory(prefix="errmap_hold_") as name:
        folder = pathlib.Path(name)
        run(errmap, "simulate", "turning-centre", "-o", "sim", "--days", "8",
            "--cycles", "6", "--seed", "3", "--quiet", folder=folder)
        known, further = bench.split_days(folder / "sim", 6)
        own, lost = [], []
        for name in names:
            exported = Map(name, known, errmap, interval=True)
            exported.prepare()
            ways = ["up", "down"] if name == "pair" else ["down"]
            days = days_of(exported, bench.write_days(
                further / (name + ".csv"), ways))
            check_sensors(exported, days, counts, chance)
            rows = days[0][0][:300]
            check_limits(exported, rows, counts)
            check_damage(exported, rows)
            check_travel(exported, rows)
            check_start_held(exported, rows)
            if name != "pair":
                check_mixed(exported, errmap)
            of_map, of_lost = lost_and_moving(exported, days)
            own += of_map
            lost += of_lost
            print(f"{name}: own RMS {1e3 * rms(of_map):.2f} um, with a sensor "
                  f"lost {1e3 * rms(of_lost):.2f} um")
        check_healthy_machines(folder, errmap, 20, 10)
    told = [one for some in counts.hang.values() for one in some]
    print(f"{counts.runs} runs: {counts.beyond} steps beyond the limit, "
          f"{counts.worse} runs long worse than none and healthy; by fault "
          + ", ".join(f"{what} {worse}/{runs}" for what, (runs, worse)
                      in counts.by_fault.items()))
    print(f"hanging sensors found in time: {sum(told)} of {len(told)}; "
          + ", ".join(f"{name} {sum(some)}/{len(some)}"
                      for name, some in counts.hang.items()))
    print(f"a sensor lost, over the hold: {1e3 * rms(lost):.2f} um, the maps' "
          f"own {1e3 * rms(own):.2f} um")
    check("no step beyond the limit", counts.beyond == 0, counts.beyond)
    check("healthy and worse than nothing in one run of a hundred at most",
          counts.worse <= 0.01 * counts.runs, counts.by_fault)
    check("hanging sensors are found", sum(told) >= 0.95 * len(told))
    check("the hold is as good as the map", rms(lost) <= 1.5 * rms(own))
    if not bench.has_compiler():
        print("structured text was not run: no iec2c (matiec) on the PATH, in "
              "IEC2C or to be built from MATIEC_SOURCE")
    print("WRONG" if bench.failures else "right")
    return 1 if bench.failures else 0


if __name__ == "__main__":
    sys.exit(main())
