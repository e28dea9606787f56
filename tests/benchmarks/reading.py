#!/usr/bin/env python3
"""Are logs of machines whose truth is known read right, asked about, or wrong?

    reading.py ERRMAP [--files] [--seeds 1-200] [--show]

Each seed is a log of 1 to 12 days of at most 14 h, with 2 to 20 cycles a day,
pauses of at most a quarter of the shortest night, nights of 4 to 60 h, shifts
over midnight; with and without a day, dates, a cycle, a direction; time in one
of eleven forms, names in four languages. `errmap read --format json` has to
find sessions, cycles, axis, direction and the step of time. Right: all of them,
and sure. Asked: what differs, or stands open, is named in a question or not
sure. Wrong: something differs without a word. --show prints those that are not
right. Ends with status 4 where a log is read wrong, or fewer than 95 % right.

With --files each seed is a file as laboratories have them (lab_files.py): a kind
of habit over six days of ten cycles, its names, steps and pauses drawn. There a
refusal in one line that names an option counts as asked, and asked as right.
"""

import collections
import json
import math
import os
import random
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "cli",
                                "reading"))
import lab_files  # noqa: E402
import lab_logs  # noqa: E402
from program_runs import parser_of, seeds  # noqa: E402


def told(reading, topic):
    """Whether the reading says that this item is open."""
    item = reading.get(topic)
    unsure = isinstance(item, dict) and item.get("sure") is False
    return unsure or any(
        question["topic"] == topic for question in reading["questions"])


def differences(reading, log, names, has):
    """What of a reading is not so: {topic: (read, true)}."""
    found = {}

    def hold(topic, read, true):
        if read != true:
            found[topic] = (read, true)

    hold("position", (reading["position"] or {}).get("column"), names["axis"])
    hold("target", (reading["target"] or {}).get("column"), names["target"])
    hold("sessions", reading["sessions"]["first_rows"],
         lab_logs.first_rows(log.day))
    hold("cycles", reading["cycles"]["count"], log.days * log.cycles_a_day)
    ways = ["down", "up"] if log.both_ways else ["up"]
    hold("direction", sorted(reading["direction"]["values"]) or ["up"], ways)
    step = reading["time"]["step_s"] if has["time"] else None
    if has["time"]:
        if step is None or not math.isclose(step, log.step, rel_tol=0.01):
            found["time"] = (step, log.step)
    hold("sensors", sorted(reading["sensors"]), sorted(names["sensors"]))
    return found


def judge(errmap, seed, folder):
    """('right'|'asked'|'wrong'|'refused', what of it)."""
    log = lab_logs.Log(seed)
    draw = random.Random(-seed)
    form = draw.choice(lab_logs.TIMES)
    has = {"day": draw.random() < 0.4, "cycle": draw.random() < 0.5,
           "direction": log.both_ways and draw.random() < 0.5,
           "cycle_anew": draw.random() < 0.4, "form": form}
    # Of a log without dates, days or cycles nothing could tell the days.
    has["time"] = True
    text, names = lab_logs.write_table(
        log, draw, form=form, day=has["day"], cycle=has["cycle"],
        cycle_anew=has["cycle_anew"], direction=has["direction"])
    path = os.path.join(folder, f"log{seed}.csv")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([errmap, "read", path, "--format", "json"],
                          capture_output=True, text=True, check=False)
    about = (f"{form}, {log.days} x {log.cycles_a_day}, " + ", ".join(
        name for name in ("day", "cycle", "cycle_anew", "direction")
        if has[name]) + (", both ways" if log.both_ways else ""))
    try:
        reading = json.loads(done.stdout)
    except json.JSONDecodeError:
        reading = None
    if not isinstance(reading, dict) or "questions" not in reading:
        return "refused", f"{about}: {done.stderr.strip()[:200]}"
    if done.returncode == 2:
        return "asked", about + ": " + "; ".join(
            question["topic"] for question in reading["questions"])
    found = differences(reading, log, names, has)
    silent = [topic for topic in found if not told(reading, topic)]
    text = f"{about}: " + "; ".join(
        f"{topic}: read {str(read)[:60]}, true {str(true)[:60]}"
        for topic, (read, true) in found.items())
    if silent:
        return "wrong", text
    asked = [topic for topic in ("position", "direction", "time", "cycles",
                                 "sessions") if told(reading, topic)]
    if found or asked:
        return "asked", f"{text} (not sure: {', '.join(asked)})"
    return "right", about


def judge_file(errmap, seed, folder):
    """The same of a file of lab_files."""
    kind, file = lab_files.draw(seed)
    paths = lab_files.write(file, folder)
    clean = os.path.join(folder, "clean.csv")
    if os.path.exists(clean):
        os.remove(clean)
    done = subprocess.run(
        [errmap, "read", *paths, *file.words(folder), "--format", "json", "-o",
         clean], capture_output=True, text=True, check=False)
    line = done.stderr.strip().splitlines()
    if done.returncode in (2, 3):
        if done.returncode == 2 and done.stdout.strip():
            questions = json.loads(done.stdout)["questions"]
            return "asked", f"{kind}: {[q['topic'] for q in questions]}"
        works = len(line) == 1 and "--" in line[0]
        return ("asked" if works else "refused"), f"{kind}: {line[:2]}"
    if done.returncode != 0:
        return "refused", f"{kind}: status {done.returncode} {line[:1]}"
    reading = json.loads(done.stdout)
    wrong = file.wrong(reading, lab_files.columns_of(clean))
    silent = {topic: text for topic, text in wrong.items()
              if not told(reading, topic)}
    if silent:
        return "wrong", f"{kind}: {silent}"
    return ("asked" if wrong else "right"), f"{kind}: {wrong or ''}"


def main():
    parser = parser_of(__doc__, seeds("1-200"))
    parser.add_argument("--files", action="store_true")
    parser.add_argument("--show", action="store_true")
    given = parser.parse_args()
    judge_one = judge_file if given.files else judge
    counts = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        for seed in given.seeds:
            verdict, about = judge_one(given.errmap, seed, folder)
            counts[verdict] += 1
            if given.show and verdict != "right":
                print(f"{seed}: {verdict}: {about}")
    total = sum(counts.values())
    print(", ".join(f"{verdict} {counts[verdict]}" for verdict in
                    ("right", "asked", "refused", "wrong")), f"of {total}")
    good = counts["right"] + (counts["asked"] if given.files else 0)
    if counts["wrong"] > 0 or good < 0.95 * total:
        raise SystemExit(4)


if __name__ == "__main__":
    main()
