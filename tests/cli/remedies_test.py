"""Every remedy that a message names can be carried out.

    remedies_test.py ERRMAP SOURCE_FOLDER

Collects from the sources the arguments that messages advise, ArgumentName(...)
and --option in their words, and the commands, "errmap WORD ... --option": each
must exist. Then it makes the mistakes of CASES, takes the advice out of what
the program answers, and runs the command again with it: it may be refused for
another reason, never for that option.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

# Named by what stands in a file, or by a program that is not this one.
NO_OPTIONS = {"where", "training", "column"}
OF_OTHERS = {"--user", "--array", "--parsable", "--version", "--help"}


def fail(text):
    print(text)
    sys.exit(1)


class Program:
    def __init__(self, path):
        self.path = path
        words = self.run(["help"]).stdout
        self.commands = [
            name
            for name in re.findall(r"^  ([a-z0-9]+) ", words, re.M)
            if self.run(["help", name]).returncode == 0
        ]
        self.options = {
            name: set(re.findall(r"--[a-z0-9-]+",
                                 self.run(["help", name, "--all"]).stdout))
            for name in self.commands
        }
        for name in self.commands:
            self.options[name] |= {"--help", "--all"}

    def run(self, words, folder=None):
        return subprocess.run([self.path, *words], cwd=folder, text=True,
                              capture_output=True, timeout=120)


def literals(text):
    """The string literals of C++, neighbours put together."""
    text = re.sub(r"^\s*(//|#).*$", "", text, flags=re.M)
    pieces = re.findall(r'(?:"(?:[^"\\\n]|\\.)*"\s*)+', text)
    for piece in pieces:
        yield "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', piece))


def sources(folder):
    for room in ("data", "stats", "fitting", "models", "cli"):
        for path in sorted((folder / room).rglob("*.cc")):
            yield path, path.read_text(encoding="utf-8")


def check_sources(program, folder):
    known = set().union(*program.options.values())
    found = 0
    for path, text in sources(folder):
        for member in re.findall(r'ArgumentName\(\s*"([a-z_]+)"', text):
            found += 1
            option = "--" + member.replace("_", "-")
            if member not in NO_OPTIONS and option not in known:
                fail(f"{path}: advises {option}, which no command has")
        for words in literals(text):
            for command, rest in re.findall(
                    r"errmap ([a-z0-9]+)((?: [^;,\"&\\]*)?)", words):
                if command not in program.commands:
                    continue
                for option in re.findall(r"(?<=\s)--[a-z][a-z0-9-]*", rest):
                    found += 1
                    own = program.options[command]
                    if option not in own and option not in OF_OTHERS:
                        fail(f"{path}: 'errmap {command}' has no {option}: "
                             f"{words}")
    if found < 60:
        fail(f"only {found} remedies found in the sources")
    return found


HEADER = "day,cycle,position_mm,t1_degC,t2_degC,time_s,error_um"


def rows():
    cells = [HEADER.split(",")]
    i = 0
    for day in range(1, 5):
        for cycle in range(1, 4):
            for x in range(5):
                i += 1
                t1 = 20 + cycle + 0.3 * day + 0.1 * (i * 7 % 5)
                t2 = 19 + 0.5 * cycle + 0.2 * day + 0.1 * (i * 3 % 5)
                error = x + 0.7 * (t1 - 20) + 0.2 * (i * 11 % 7)
                cells.append([day, cycle, 100 * x, f"{t1:.2f}", f"{t2:.2f}",
                              86400 * day + 600 * cycle + 20 * x,
                              f"{error:.3f}"])
    return [[str(cell) for cell in row] for row in cells]


def text_of(cells):
    return "".join(",".join(row) + "\n" for row in cells)


def with_cell(row, column, value):
    cells = rows()
    cells[row][HEADER.split(",").index(column)] = value
    return text_of(cells)


def without(column):
    at = HEADER.split(",").index(column)
    return text_of([row[:at] + row[at + 1:] for row in rows()])


def constant(column):
    at = HEADER.split(",").index(column)
    cells = rows()
    for row in cells[1:]:
        row[at] = "7"
    return text_of(cells)


def files():
    empty_t1 = with_cell(8, "t1_degC", "")
    return {
        "good.csv": text_of(rows()),
        "empty_t1.csv": empty_t1,
        "empty_error.csv": with_cell(8, "error_um", ""),
        "empty_position.csv": with_cell(8, "position_mm", ""),
        "word.csv": with_cell(8, "t1_degC", "warm"),
        "no_target.csv": without("error_um"),
        "dead.csv": constant("t2_degC"),
        "no_day.csv": without("day"),
        "points.csv": "x_mm,y_mm\n1,2\n,3\n",
    }


# What is done wrong, and whether advice must be there.
CASES = [
    (words.split(), advised)
    for words, advised in (
        ("compare FILE --models mean --dry-run", True),
        ("fit FILE --model poly:eq9 -o out.json", True),
        ("learn FILE --by sessions --models mean --repeats 1", True),
        ("evaluate map.json FILE", True),
        ("update map.json FILE -o out.json", True),
        ("check map.json FILE", False),
        ("predict map.json FILE", False),
        ("iso230 FILE", False),
        ("residuals FILE --column error_um", False),
    )
]

# One advice: an option with its value, up to what cannot be in one.
ADVICE = re.compile(r"(?<!\S)(--[a-z][a-z0-9-]*)(?: ([A-Za-z0-9_.:-]+))?")
# What a person has to think of; a value for it here.
VALUES = {
    "--exclude": "t2_degC",
    "--target": "error_um",
    "--inputs": "position_mm,t1_degC",
    "--group": "cycle",
    "--session": "day",
    "--time": "time_s",
    "--goal": "2um",
    "--holdout": "every:3",
    "--missing": "drop-rows",
    "--faults": "drop-rows",
    "--align": "none",
    "--position": "position_mm",
    "--seed": "2",
}
FLAGS = {"--keep-dead", "--quiet", "--details", "--force", "--all",
         "--resume", "--no-interval"}


def carried_out(program, words, message, folder):
    """Runs the command again with each option that the message advises."""
    count = 0
    message = re.sub(r"'[^']*'|errmap [a-z0-9]+ [^;]*", "", message)
    for option, value in ADVICE.findall(message):
        if option in words:
            continue
        more = [option]
        if option not in FLAGS:
            exact = option in ("--missing", "--faults", "--exclude", "--align")
            more.append(value if exact and value else VALUES.get(option, value))
        again = program.run([*words, *more], folder)
        if again.returncode == 2:
            fail(f"errmap {' '.join(words)}\n  says: {message}\n  and with "
                 f"{' '.join(more)}: {again.stderr}")
        if option in ("--missing", "--faults") and again.returncode != 0:
            fail(f"errmap {' '.join(words)} {' '.join(more)} is advised and "
                 f"refused: {again.stderr}")
        count += 1
    return count


def check_cases(program, folder):
    for name, text in files().items():
        (folder / name).write_text(text)
    fitted = program.run(["fit", "good.csv", "--model", "poly:eq9", "-o",
                          "map.json"], folder)
    if fitted.returncode != 0:
        fail(fitted.stderr)
    carried = 0
    for words, advised in CASES:
        own = 0
        for name in files():
            if name == "points.csv":
                continue
            command = [name if word == "FILE" else word for word in words]
            outcome = program.run(command, folder)
            own += carried_out(program, command, outcome.stderr, folder)
        if advised and own == 0:
            fail(f"errmap {' '.join(words)} advises nothing")
        carried += own
    return carried


def main():
    program = Program(str(pathlib.Path(sys.argv[1]).resolve()))
    if len(program.commands) < 15:
        fail(f"only {len(program.commands)} commands: {program.commands}")
    found = check_sources(program, pathlib.Path(sys.argv[2]))
    with tempfile.TemporaryDirectory() as folder:
        carried = check_cases(program, pathlib.Path(folder))
    print(f"{found} remedies in the sources, {carried} carried out")


main()
