#!/usr/bin/env python3
"""One study has one answer. Of 30 results (2 to 10 days, 1 to 41 inputs, with
and without a goal, re-zeroing and later days) the screen, the page, Markdown,
the table of components, the map's file and results.json say the same: map,
error, interval, goal, number of days and certainty. A first answer has at most
12 lines and 110 words, and no sentence more than 25 words.

    answers_test.py ERRMAP
"""

import html
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

MOST_LINES, MOST_WORDS, MOST_IN_A_SENTENCE = 12, 110, 25
GOALS = {
    "met": "reached",
    "met after re-zeroing": "reached after re-zeroing",
    "missed": "not reached",
}


class Case:
    def __init__(self, number):
        self.number = number
        self.days = 2 + number % 9
        self.inputs = (1, 2, 3, 5, 12, 41)[number % 6]
        self.options = []
        if number % 3:
            self.options += ["--goal", ("", "0.5um", "20um")[number % 3]]
        if number % 5 == 3:
            self.options += ["--rezero", "session"]
        if number % 7 == 2 and self.days > 3:
            self.options += ["--holdout", "sessions:2", "--holdout", "forward:2"]

    def write_plain(self, path):
        """Rows of no day, cycle or position."""
        draw = random.Random(self.number)
        with path.open("w", encoding="ascii") as file:
            file.write("t01_degC,t02_degC,error_mm\n")
            for _ in range(120):
                warm = [draw.uniform(20.0, 30.0) for _ in range(2)]
                error = 1e-3 * (2.0 * warm[0] - warm[1] + draw.gauss(0.0, 0.5))
                file.write(f"{warm[0]:.2f},{warm[1]:.2f},{error:.6f}\n")

    def write(self, path):
        draw = random.Random(self.number)
        sensors = self.inputs - 1
        gains = [draw.uniform(0.2, 1.2) for _ in range(max(1, sensors))]
        with path.open("w", encoding="ascii") as file:
            names = [f"t{k:02}_degC" for k in range(sensors)]
            file.write(",".join(["day", "cycle", "position_mm", *names, "error_mm"]) + "\n")
            for day in range(self.days):
                shift = draw.gauss(0.0, 1.0)
                for cycle in range(4):
                    warm = shift + cycle * draw.uniform(0.5, 1.5)
                    for step in range(8):
                        position = -25.0 * step
                        read = [20.0 + g * warm + draw.gauss(0, 0.05) for g in gains]
                        error = 1e-3 * (0.03 * position + 2.0 * warm + draw.gauss(0, 0.3))
                        row = [day + 1, cycle + 1, position]
                        row += [f"{t:.2f}" for t in read[:sensors]]
                        file.write(",".join(map(str, [*row, f"{error:.6f}"])) + "\n")


def shown(fragment):
    """Text of a piece of HTML, in the characters of a terminal."""
    text = html.unescape(re.sub(r"<[^>]*>", "", fragment))
    return text.replace("\u00a0", " ").replace("µ", "u").replace("°", "deg").strip()


def plain(markdown):
    return re.sub(r"\\(.)", r"\1", markdown).strip("* ")


def answer_of_screen(lines):
    """The map, and (label, text) of each line below it."""
    start = next(i for i, line in enumerate(lines) if line.startswith(("Use ", "No map", "Leave ")))
    end = lines.index("", start)
    use, rows = lines[start], []
    for line in lines[start + 1 : end]:
        if not line.startswith("  "):
            use += " " + line
        elif line[2] != " ":
            rows.append([line[2:17].strip(), line[19:]])
        else:
            rows[-1][1] += " " + line.strip()
    return use, [tuple(row) for row in rows], end - start


def paragraphs_of_screen(lines):
    """Lines put together again, without tables, options and commands."""
    text = [""]
    for line in lines:
        labelled = re.match(r" {0,2}[\w?].{0,14} {2,}(\S.*)$", line)
        if not line:
            text.append("")
        elif labelled:
            text.append(labelled[1])
        else:
            text[-1] += " " + line.strip()
    return [t for t in text if not re.search(r"errmap \w|\S {2,}\S", t)]


def sentences(text):
    return re.split(r"(?<=[.!?])\s+", text)


def words_in(text):
    return sum(bool(re.search(r"\w", word)) for word in text.split())


class Checks:
    def __init__(self):
        self.failures = 0
        self.results = 0

    def same(self, case, what, first, second):
        if first != second:
            self.failures += 1
            print(f"FAILED: result {case.number}: {what}: {first!r}, {second!r}", file=sys.stderr)

    def short(self, case, what, text):
        for sentence in sentences(text):
            self.same(
                case,
                f"words of a sentence {what}: {sentence}",
                True,
                words_in(sentence) <= MOST_IN_A_SENTENCE,
            )

    def holdouts_of(self, case, page):
        """What each hold-out holds out, as drawn and as tabled."""
        titles = re.findall(r"<text[^>]*>([^<(]*) \((\S+:\d+)\)</text>", page)
        drawn = {name: what for what, name in titles}
        tabled = dict(re.findall(r"<bdi>([^\s<]+:\d+) RMSE.*?class=\"soft\">([^<;]*)", page))
        for name in drawn.keys() & tabled.keys():
            self.same(case, f"what {name} holds out", tabled[name], drawn[name])
        self.same(case, "hold-outs drawn and tabled", True, bool(drawn.keys() & tabled.keys()))

    def of(self, case, screen, folder):
        self.results += 1
        lines = screen.split("\n")
        page = (folder / "report.html").read_text(encoding="utf-8")
        text = (folder / "report.md").read_text(encoding="utf-8")
        component = json.loads((folder / "results.json").read_text())["components"][0]
        advice = component["recommendation"]
        use, rows, length = answer_of_screen(lines)
        reading = next(i for i, line in enumerate(lines) if not line)
        self.same(case, "lines", True, length + reading <= MOST_LINES)
        words = words_in(" ".join(lines[: lines.index("", reading + 1)]))
        self.same(case, f"{words} words", True, words <= MOST_WORDS)

        card = re.search(r'<div class="card">(.*?)</div>', page, re.S)[1]
        on_page = re.findall(r"<dt>(.*?)</dt><dd.*?>(.*?)</dd>", card)
        on_page = [(shown(label), shown(value)) for label, value in on_page]
        self.same(case, "map on the page", use, shown(re.search(r"<p.*?</p>", card)[0]))
        self.same(case, "lines on the page", rows, [r for r in on_page if r in rows])
        begin, end = text.index("\n**"), text.index("\nError = ")
        bullets = [plain(line[2:]) for line in text[begin:end].split("\n") if line.startswith("- ")]
        self.same(case, "lines in Markdown", [f"{a}: {b}" for a, b in on_page], bullets)
        self.same(case, "map in Markdown", use, plain(text[begin:].split("\n")[1]))

        model = advice["model"]
        error = rows[0][1].split(" ")[0]
        self.same(case, "map", True, f" {model}" in use or model == "zero")
        star = next(line for line in lines if line.startswith("* ")).split()
        cut = re.escape(star[1]).replace(r"\.\.\.", ".*")
        self.same(case, "map in the table", True, bool(re.fullmatch(cut, model)))
        self.same(case, "error in the table", error, star[3])
        marked = re.search(r'<tr class="mark">(.*?)</tr>', page, re.S)[1]
        cells = [shown(cell) for cell in re.findall(r"<td.*?</td>", marked, re.S)]
        self.same(case, "table of the page", [model, error], [cells[0], cells[1].split(" ")[0]])
        self.holdouts_of(case, page)
        number = shown(re.search(r'<p class="number">.*?</p>', page)[0])
        self.same(case, "number of the page", error, number.split(" ")[0])
        bold = next(line for line in text.split("\n") if line.startswith("| **"))
        bold = [plain(cell.strip()) for cell in bold.strip("| ").split("|")]
        self.same(case, "table of Markdown", cells[:2], bold[:2])
        digits = len(error.partition(".")[2])
        self.same(case, "results.json", error, f"{1e3 * advice['rmse']:.{digits}f}")
        interval = re.search(r"95 %: (\S+) to (\S+)\)", rows[0][1])
        known = None not in advice["ci95"]
        self.same(case, "has an interval", known, interval is not None)
        if known:
            ends = [f"{1e3 * end:.{digits}f}" for end in advice["ci95"]]
            self.same(case, "interval", ends, list(interval.groups()))
            self.same(case, "interval in the table", "-".join(ends), star[4])
            self.same(case, "interval of the page", f"({ends[0]} to {ends[1]})", cells[1].partition(" ")[2])

        goal = dict(rows).get("goal", "")
        standing = advice["goal_standing"]
        self.same(case, "goal", standing == "no goal", goal.startswith("none given") or not goal)
        if standing in GOALS:
            self.same(case, "goal", GOALS[standing], re.sub(r"^.*?: |;.*$", "", goal))
        rival = dict(rows).get("best simple map", "")
        if "gap" in rival:
            proven = advice["against_baseline"] == "established"
            self.same(case, "certainty", proven, "proven" in rival)
        needed = set()
        for words in (" ".join(value for _, value in rows), screen, shown(page), text):
            needed.update(re.findall(r"(\d+) (?:days|cycles) would\b", words))
            needed.update(re.findall(r"(\d+) (?:days|cycles)? ?or more in all", words))
        self.same(case, f"numbers of days {needed}", True, len(needed) <= 1)

        for paragraph in paragraphs_of_screen(lines):
            self.short(case, "on the screen", paragraph)
        for part in re.findall(r"<(?:p|li|dd)[ >].*?</(?:p|li|dd)>", page, re.S):
            if not re.search(r"<code>|<a |^<p>\d+ inputs?:|minus its centre:", part):
                self.short(case, "on the page", shown(part))

        files = [m["file"] for m in component["models"] if m["name"] == model and m.get("file")]
        for name in files:
            kept = json.loads((folder / name).read_text())
            self.same(case, "map's file", model, kept["name"])
            if kept.get("interval"):
                holdout = next(h for h in component["holdouts"] if h["name"] == advice["holdout"])
                of_file = kept["interval"]
                self.same(case, "days of the map's file", holdout["units"], of_file["groups"])
                self.same(case, "hold-out of the map's file", holdout["name"], of_file["holdout"])


    def of_many(self, run, numbers, models):
        """The tables of several components and of a fleet."""
        pathlib.Path("many.toml").write_text(
            f"models = {models.split(',')}\n"
            + "".join(f"[[component]]\nname = 'd{n}'\ndata = 'data{n}.csv'\n" for n in numbers)
        )
        pathlib.Path("fleet.toml").write_text(
            f"models = {models.split(',')}\n[[component]]\n"
            "name = '{machine}/{axis}'\ndata = 'fleet/{machine}/{axis}.csv'\n"
        )
        for number in numbers:
            machine = pathlib.Path(f"fleet/m{number}")
            machine.mkdir(parents=True)
            (machine / "x.csv").write_bytes(pathlib.Path(f"data{number}.csv").read_bytes())
        table = run("compare", "--config", "many.toml", "--quiet", "--out", "many")
        fleet = run("compare", "--config", "fleet.toml", "--quiet", "--out", "store")
        record = json.loads(pathlib.Path("many/results.json").read_text())
        page = pathlib.Path("many/report.html").read_text(encoding="utf-8")
        for number, component in zip(numbers, record["components"]):
            case, advice = Case(number), component["recommendation"]
            row = re.search(rf"^d{number} .*$", table, re.M)[0].split()
            self.same(case, "map of many", advice["model"], row[1])
            digits = len(row[2].partition(".")[2])
            self.same(case, "error of many", f"{1e3 * advice['rmse']:.{digits}f}", row[2])
            line = re.search(rf'<tr><td[^>]*><a href="#c\d+">(?:<bdi>)?d{number}<.*?</tr>', page)[0]
            cells = [shown(cell) for cell in re.findall(r"<td.*?</td>", line)]
            self.same(case, "page of many", [row[1], f"{row[2]} um"], cells[1:3])
            row = re.search(rf"^m{number}/x .*$", fleet, re.M)[0].split()
            self.same(case, "map of a fleet", advice["model"], row[2])
            self.same(case, "error of a fleet", f"{1e3 * advice['rmse']:.4g}", row[5])
            self.same(case, "goals nobody set", None, re.search("goal met|not met", fleet))


def main():
    errmap = os.path.abspath(sys.argv[1])
    checks = Checks()
    with tempfile.TemporaryDirectory() as scratch:
        os.chdir(scratch)
        os.environ["XDG_CACHE_HOME"] = scratch

        def run(*arguments):
            done = subprocess.run([errmap, *arguments], capture_output=True, text=True, check=False)
            if done.returncode:
                raise SystemExit(f"errmap {' '.join(arguments)}: {done.stderr}")
            return done.stdout

        models = "zero,mean,poly:position,poly:eq8,poly:full:degree=1"
        for number in range(30):
            case = Case(number)
            data = pathlib.Path(f"data{number}.csv")
            case.write(data)
            common = [*case.options, "--models", models, "--quiet"]
            folder = pathlib.Path(f"study{number}")
            screen = run("compare", str(data), *common, "--out", str(folder), "--details")
            checks.of(case, screen, folder)
        checks.of_many(run, (2, 7, 15), models)
        case = Case(30)
        case.write_plain(pathlib.Path("plain.csv"))
        run("compare", "plain.csv", "--models", "mean,poly:full:degree=1", "--quiet", "--out", "plain")
        checks.holdouts_of(case, pathlib.Path("plain/report.html").read_text(encoding="utf-8"))
    print(f"answers: {checks.results} results, {checks.failures} differences")
    return 1 if checks.failures or checks.results < 30 else 0


if __name__ == "__main__":
    sys.exit(main())
