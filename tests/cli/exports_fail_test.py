"""Sensors that fail under exported maps, in C, Python and structured text.

  exports_fail_test.py ERRMAP [FAILURES]

Each failure takes one input of one map, and from a random row on for a random
while it reads 0, stands still, reads 50 more, no number, another input or
itself some rows ago. Whatever it is: no error leaves the limit of the file, no
step of it exceeds the rate and what the axis' own motion adds, and the languages
agree, status and all, structured text also as matiec compiles it, where that is
at hand; with REAL alone it is near; SCL and PLCopen's XML say the same text. Of
failures that are told, the filters are afterwards where they would be if the
rows had never been. Healthy rows are believed and
equal `errmap predict`, and say of each row what it does; a control that kept
its state goes on as if it had not been away. In the end faults are planted, and
must be found. Needs a C compiler; skips (status 77) without.
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
import xml.etree.ElementTree

from exported_maps import (LONG, MAPS, Exported, check, compiler_of_text,
                           failures, has_compiler, planted, run, write_days)

LANGUAGES_AGREE = 1e-12  # of the error's limit
SINGLE_AGREES = 1e-5  # of it; a filter that stands still loses 5e-5
RECOVERS = 1e-9  # mm
PREDICTS = 1e-12  # mm
RESTARTS = 1e-12  # of the error's limit
# What `predict` calls a row, and the bit of the status that says so.
WHY = {"range": "OUTSIDE", "relation": "RELATION", "distance": "DISTANCE",
       "leverage": "LEVERAGE", "start": "SETTLING", "gap": "GAP"}

WITH_STATUS = ["ridge", "stepwise", "strict", "pair", "raw"]

# A fault in the exported Python, which the checks must find.
PLANTS = {
    "no limit": [("if abs(target) > bound:", "if False:"),
                 ("if not (abs(self.given) <=", "if False and not (abs(self.given) <=")],
    "no rate": [("if abs(target - self.given) > self.room:", "if False:")],
    "steps are always taken": [("if not (status & NOT_TAKEN):", "if True:")],
    "a gap is not a time": [("self.waited = self.waited + passed",
                             "self.waited = passed")],
}


class Direction:
    """Whether the position decreases, as the head of a file tells."""

    def __init__(self, band):
        self.band, self.down, self.turn = band, False, None

    def follow(self, position):
        """Whether it turned."""
        if self.turn is None:
            self.turn = position
        back = position - self.turn if self.down else self.turn - position
        if back > self.band:
            self.down, self.turn = not self.down, position
            return True
        if back < 0.0:
            self.turn = position
        return False


def steps_of(day):
    rows = []
    for i, (time, *inputs) in enumerate(day):
        rows.append([0.0 if i == 0 else time - day[i - 1][0], *inputs])
    return rows


def fail(rows, kind, which, begin, end, other):
    """The rows with input `which` (from 1) failing."""
    failed = [list(row) for row in rows]
    for i in range(begin, end):
        failed[i][which] = {
            "zero": 0.0,
            "stuck": rows[begin][which],
            "plus 50": rows[i][which] + 50.0,
            "nan": math.nan,
            "swapped": rows[i][other],
            "delayed": rows[max(0, i - 10)][which]}[kind]
        if kind == "swapped":
            failed[i][other] = rows[i][which]
    return failed


def check_limits(exported, rows, found, what):
    limits = exported.map.Map()
    given, last = 0.0, None
    direction = Direction(exported.band)
    for (dt, *inputs), (error, status) in zip(rows, found):
        check(what + ": a number within the limit",
              abs(error) <= limits.max_error, error)
        allowed = limits.max_rate * (LONG if last is None else dt)
        if direction.follow(inputs[exported.position]):
            allowed += exported.reversal
        low, high = exported.ends
        at = inputs[exported.position]
        if 2 * low - high <= at <= 2 * high - low:  # else it is refused
            at = min(max(at, low), high)
            if last is not None:
                allowed += exported.slope * abs(at - last)
            last = at
        check(what + ": no step beyond the rate",
              abs(error - given) <= allowed * (1 + 1e-9) + 1e-15,
              (error, given, allowed))
        given = error


def check_recovery(exported, rows, found, what):
    """As without the rows that were not taken, each left out."""
    spared, waited, kept = [], 0.0, []
    for i, ((dt, *inputs), (_, status)) in enumerate(zip(rows, found)):
        waited += dt
        if status & exported.map.NOT_TAKEN:
            continue
        spared.append([waited, *inputs])
        kept.append(i)
        waited = 0.0
    expected = exported.in_python(spared)
    ramping = exported.map.RAMPING
    for i, (error, status) in zip(kept, expected):
        if (status | found[i][1]) & ramping:
            continue
        check(what + ": the filters as if the rows had not been",
              abs(found[i][0] - error) <= RECOVERS, (i, found[i], error))


def check_healthy(exported):
    at, held, turned = 0, 0, 0
    for day in exported.days.values():
        direction = Direction(exported.band)
        steps = steps_of(day)
        for (_, *inputs), (error, status) in zip(steps,
                                                 exported.in_python(steps)):
            held += bool(status & exported.map.NOT_TAKEN)
            turned += direction.follow(inputs[exported.position])
            predicted = exported.predicted[int(direction.down)][at]
            check(exported.name + ": healthy rows are as predicted",
                  abs(error - predicted) <= PREDICTS,
                  (at, error, predicted, status))
            at += 1
    check(exported.name + ": healthy rows are believed", held == 0, held)
    check(exported.name + ": the axis turns and the maps differ",
          exported.name != "pair" or turned > 20 and max(
              abs(up - down) for up, down in zip(*exported.predicted)) > 1e-3,
          turned)


def failed_session(exported, chance):
    rows = steps_of(chance.choice(list(exported.days.values())))
    kind = chance.choice(["zero", "stuck", "plus 50", "nan", "swapped",
                          "delayed"])
    which = chance.randrange(1, len(rows[0]))
    other = chance.choice([i for i in range(1, len(rows[0])) if i != which])
    begin = chance.randrange(1, len(rows) - 1)
    end = min(len(rows), begin + chance.randrange(1, 30))
    rows = fail(rows, kind, which, begin, end, other)
    return rows, (f"{exported.name}, {exported.map.INPUTS[which - 1]} {kind} in "
                  f"rows {begin} to {end}")


def check_failure(exported, chance, others):
    rows, what = failed_session(exported, chance)
    found = exported.in_python(rows)
    check_limits(exported, rows, found, what)
    # Which way the axis went in rows that were left out is not known.
    if exported.name != "pair":
        check_recovery(exported, rows, found, what)
    allowed = LANGUAGES_AGREE * exported.map.Map().max_error
    for language in others:
        for mine, other in zip(found, language(exported, rows)):
            check(f"{what}: the same {language.__name__}",
                  abs(mine[0] - other[0]) <= allowed and mine[1] == other[1],
                  (mine, other))


def check_plants(exported, chance):
    """Limits so near that they are reached; then each fault is found."""
    right = (exported.folder / (exported.name + ".py")).read_text()
    for limit, nearer in (("error", 0.15), ("rate", 0.05)):
        right = re.sub(rf"(self\.max_{limit} =) ([0-9.e-]+)",
                       lambda most: f"{most[1]} {nearer * float(most[2])!r}",
                       right, count=1)
    for fault, changes in {"": [], **PLANTS}.items():
        wrong = right
        for old, new in changes:
            check("the place of a fault: " + fault, old in wrong)
            wrong = wrong.replace(old, new)
        exported.load(wrong)
        found = len(failures)
        planted[:] = [fault] if fault else []
        for _ in range(20):
            check_failure(exported, chance, [])
        planted.clear()
        found = len(failures) - found
        if not fault:
            check("without a fault nothing is found", found == 0, found)
        else:
            del failures[len(failures) - found:]
            check(f"a fault is found: {fault}", found > 0)
            print(f"planted, {fault}: found in {found} checks")


def other_files(folder, errmap, ways):
    """Other days of the machine and of others; whole, without the first rows of
    each day, and with gaps."""
    for seed in (3, 4, 5):
        run(errmap, "simulate", "turning-centre", "-o", f"sim{seed}", "--days",
            "4", "--cycles", "4", "--seed", str(seed), "--quiet",
            folder=folder)
        cycle = 17 * len(ways)
        for kind, keeps in (("whole", lambda at: True),
                            ("late", lambda at: at >= cycle),
                            ("gaps", lambda at: not cycle <= at < 3 * cycle)):
            yield write_days(folder / f"sim{seed}" / (kind + ".csv"), ways,
                             keeps)


def check_status(exported, errmap, counts):
    """Row by row as `predict`, up to the first row that is not taken."""
    ways = ["up", "down"] if exported.name == "pair" else ["down"]
    bits = {why: getattr(exported.map, bit) for why, bit in WHY.items()}
    unlike = sum(bits.values())
    for file in other_files(exported.folder, errmap, ways):
        predicted = exported.predict(file)
        at = 0
        for day in exported.read_days(file).values():
            of_day = [rows[at:at + len(day)] for rows in predicted]
            at += len(day)
            steps = steps_of(day)
            how = {"begins": not any(row["why"] == "start" for rows in of_day
                                     for row in rows)}
            found = exported.in_python(steps, **how)
            for other in (exported.in_c(steps, **how),
                          exported.in_structured_text(steps, **how)):
                check(f"{exported.name}, {file}: the languages agree",
                      [status for _, status in found]
                      == [status for _, status in other])
            direction = Direction(exported.band)
            for i, ((_, *inputs), (_, status)) in enumerate(zip(steps, found)):
                direction.follow(inputs[exported.position])
                if status & exported.map.NOT_TAKEN:
                    counts["not taken"] = counts.get("not taken", 0) + 1
                    break
                row = of_day[int(direction.down)][i]
                counts[row["why"]] = counts.get(row["why"], 0) + 1
                if row["why"] == "where":
                    # A control turns once the axis has moved.
                    at_turn = i == 0 or (inputs[exported.position] ==
                                         steps[i - 1][1 + exported.position])
                    check(f"{exported.name}, {file}: row {i} is at a turn",
                          at_turn)
                    continue
                check(f"{exported.name}, {file}: row {i} as predict says",
                      bool(status & unlike) == (row["inside"] == "0")
                      and (not row["why"] or status & bits[row["why"]]),
                      (status, row["why"]))


def from_scl(text):
    """A source of TIA Portal as IEC 61131-3 has it."""
    text = re.sub(r"^\{ S7_.*\}\nVERSION : 0\.1\n", "", text, flags=re.M)
    text = re.sub(r"^.*TIA Portal itself.*\n", "", text, flags=re.M)
    text = re.sub(r"(\nFUNCTION .*?)\nBEGIN\n", r"\1\n", text, flags=re.S)
    return text.replace("\nBEGIN\n", "\n\n").replace("#", "").replace('"', "")


def from_plcopen(text, single=False):
    """The same of a project in PLCopen's XML."""
    spaces = {"p": "http://www.plcopen.org/xml/tc6_0201",
              "x": "http://www.w3.org/1999/xhtml"}
    real = "REAL" if single else "LREAL"
    root = xml.etree.ElementTree.fromstring(text)

    def text_of(element, path):
        found = element.find(path + "/x:p", spaces)
        return None if found is None else found.text

    def name_of(kind):
        return kind.tag.partition("}")[2]

    def variable(element):
        kind = element.find("p:type", spaces)[0]
        values = [value.get("value") for value in
                  element.iterfind(".//p:simpleValue", spaces)]
        if name_of(kind) == "array":
            upper = kind.find("p:dimension", spaces).get("upper")
            of = name_of(kind.find("p:baseType", spaces)[0])
            kind, values = f"ARRAY[0..{upper}] OF {of}", (
                ["[" + ", ".join(values) + "]"] if values else [])
        else:
            kind = name_of(kind)
        comment = text_of(element, "p:documentation")
        return (f"{element.get('name')} : {kind}"
                + "".join(" := " + value for value in values) + ";"
                + (f" (* {comment} *)" if comment else ""))

    out = []
    for pou in root.iterfind(".//p:pou", spaces):
        is_block = pou.get("pouType") == "functionBlock"
        about = text_of(pou, "p:documentation")
        if is_block:
            out.insert(0, f"(* {about} *)")
        out.append(f"FUNCTION_BLOCK {pou.get('name')}" if is_block else
                   f"FUNCTION {pou.get('name')} : {real}"
                   + (f" (* {about} *)" if about else ""))
        for section in pou.find("p:interface", spaces):
            word = {"inputVars": "VAR_INPUT", "outputVars": "VAR_OUTPUT",
                    "localVars": "VAR"}.get(name_of(section))
            if word is None:
                assert section[0].tag.endswith("}" + real)
                continue
            out.append(word + (" RETAIN" if section.get("retain") else ""))
            out += map(variable, section)
            out.append("END_VAR")
        out.append(text_of(pou, "p:body/p:ST"))
        out.append("END_FUNCTION_BLOCK" if is_block else "END_FUNCTION")
    return "\n".join(out)


def check_forms(exported):
    """What Siemens and PLCopen read is the text that is tested, and matiec
    compiles it."""
    def read(end, where="."):
        return (exported.folder / where / (exported.name + end)).read_text(
            encoding="ascii")

    def words(text):
        return re.findall(r"[\w.]+|\S", text)

    check(exported.name + ": SCL is the same text",
          from_scl(read(".scl")) == read(".st"))
    for where in (".", "single"):
        check(f"{exported.name}, {where}: PLCopen's XML is the same text",
              words(from_plcopen(read(".xml", where), where == "single"))
              == words(read(".st", where)))
        if has_compiler():
            compile_text(exported, where)


def compile_text(exported, where):
    iec2c = pathlib.Path(compiler_of_text()).resolve()
    out = exported.folder / where / (exported.name + "_c")
    out.mkdir()
    found = subprocess.run(
        [str(iec2c), "-I", str(iec2c.parent / "lib"), "-T", str(out),
         exported.name + ".st"], cwd=exported.folder / where,
        capture_output=True, text=True, check=False)
    check(f"{exported.name}, {where}: matiec compiles it",
          found.returncode == 0, found.stderr[-300:])


def check_single(exported):
    """With REAL alone: near, and no slower filter stands still."""
    allowed = SINGLE_AGREES * exported.map.Map().max_error
    day = next(iter(exported.days.values()))
    for rows in (steps_of(day), slow(steps_of(day))):
        for i, (mine, other) in enumerate(zip(
                exported.in_python(rows),
                exported.in_structured_text(rows, where="single"))):
            check(f"{exported.name}: row {i} with REAL alone",
                  abs(mine[0] - other[0]) <= allowed, (mine, other, allowed))


def slow(rows):
    """The first hours of a day in steps of a second, where each of them moves a
    filter of hours by less than the last digit of a REAL."""
    steps = [rows[0]]
    for before, row in zip(rows, rows[1:]):
        if len(steps) > 4000:
            break
        count = max(1, round(row[0]))
        for i in range(1, count + 1):
            share = i / count
            steps.append([row[0] / count] + [
                (1 - share) * a + share * b
                for a, b in zip(before[1:], row[1:])])
    return steps


def check_restart(exported, chance):
    """A control that kept its state goes on as if it had not been away."""
    rows = steps_of(chance.choice(list(exported.days.values())))
    at = chance.randrange(1, len(rows))
    allowed = RESTARTS * exported.map.Map().max_error
    unbroken = exported.in_python(rows)
    for language in (exported.in_python, exported.in_c,
                     exported.in_structured_text):
        for mine, other in zip(unbroken, language(rows, restart=at)):
            check(f"{exported.name}: restarted at row {at} with its state",
                  abs(mine[0] - other[0]) <= allowed and mine[1] == other[1],
                  (mine, other))
    session = exported.map.Map()
    session.begin()
    session.step(LONG, rows[0][1:])
    saved = session.get_state()
    for what, wrong, age in (("older", saved, 1e8), ("younger", saved, -1.0),
                             ("of another map", {**saved, "map": 1.5}, 1.0),
                             ("damaged", {**saved, "given": math.nan}, 1.0),
                             ("cut", {"map": saved["map"]}, 1.0)):
        check(f"{exported.name}: no state that is {what}",
              not exported.map.Map().set_state(wrong, age))


def main():
    errmap = os.path.abspath(sys.argv[1])
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 500
    if shutil.which("cc") is None:
        print("skipped: no C compiler")
        sys.exit(77)
    chance = random.Random(7)
    with tempfile.TemporaryDirectory(prefix="errmap_fail_") as name:
        folder = pathlib.Path(name)
        run(errmap, "simulate", "turning-centre", "-o", "sim", "--days", "3",
            "--cycles", "4", "--seed", "3", "--quiet", folder=folder)
        maps = [Exported(name, folder, errmap) for name in MAPS]
        counts = {}
        for exported in maps:
            check_healthy(exported)
            check_forms(exported)
            check_single(exported)
            if exported.name in WITH_STATUS:
                check_status(exported, errmap, counts)
            for _ in range(3):
                check_restart(exported, chance)
        print("rows:", counts)
        check("every reason occurred", all(counts.get(why) for why in WHY),
              counts)
        for i in range(count):
            others = [Exported.in_c]
            if i % 10 < 3:
                others.append(Exported.in_structured_text)
            if i % 10 == 3 and has_compiler():
                others.append(Exported.in_compiled_text)
            check_failure(maps[i % len(maps)], chance, others)
            if len(failures) > 20:
                break
        check_plants(maps[0], random.Random(5))
    if not has_compiler():
        print("structured text was read, not compiled: no iec2c (matiec) on "
              "the PATH or in IEC2C")
    print(f"{count} failures over {len(maps)} maps: "
          + ("WRONG" if failures else "right"))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
