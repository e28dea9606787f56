"""A reader of the IEC 61131-3 structured text that errmap writes, and of no
more: functions and one function block of LREAL, BOOL, INT and arrays of LREAL,
or REAL in its place, rounded after each operation; assignments, IF and FOR. Debian 12 has no parser of the language, so this one is
written from the standard's grammar (IEC 61131-3:2013, Annex A) and strict: a
word that it does not know, a type that does not fit, `__` or a trailing `_` in
a name, a real literal without a point, a line over 200 characters ends it.

  read_structured_text.py FILE.st < ROWS

Each row is `start dt inputs...`, start 1 where a session begins, 3 where one
goes on that began before, and 2 where the zero is taken anew; both begin after
so long a pause that no rate limits the first error. At 4 the control was away
for dt, what it retains was not, and the call comes dt after. Prints Error,
Compensation, Valid, Outside, Far, Clipped and the status after each call.
"""

import ctypes
import math
import re
import sys

WORDS = {"FUNCTION", "END_FUNCTION", "FUNCTION_BLOCK", "END_FUNCTION_BLOCK",
         "VAR", "VAR_INPUT", "VAR_OUTPUT", "END_VAR", "ARRAY", "OF", "LREAL",
         "BOOL", "IF", "THEN", "ELSE", "ELSIF", "END_IF", "AND", "OR", "NOT",
         "TRUE", "FALSE", "EXP", "SIN", "COS", "FOR", "WHILE", "REPEAT", "INT",
         "REAL", "XOR", "MOD", "CASE", "RETURN", "EXIT", "PROGRAM", "DT",
         "ABS", "TO", "BY", "DO", "END_FOR", "RETAIN"}
# Of the status, as the other languages have them.
BITS = {"OUTSIDE": 1, "FAR": 2, "CLIPPED": 4, "INVALID": 8, "DEAD": 16,
        "FROZEN": 32, "CONTRADICTS": 64, "FADED": 128, "LIMITED": 256,
        "RAMPING": 512, "RELATION": 1024, "DISTANCE": 2048, "LEVERAGE": 4096,
        "SETTLING": 8192, "GAP": 16384, "PARAMETER": 32768,
        "UNHEALTHY": 65536, "JUMPED": 131072}
TOKEN = re.compile(r"""
    (?P<space>\s+) | (?P<comment>\(\*.*?\*\))
  | (?P<real>[0-9][0-9_]*\.[0-9]+([eE][+-]?[0-9]+)?)
  | (?P<integer>[0-9]+)
  | (?P<name>[A-Za-z_][A-Za-z0-9_]*)
  | (?P<sign>:=|<=|>=|<>|\.\.|[-+*/()\[\];:,<>=])""", re.X | re.S)


def tokens_of(text):
    at = 0
    while at < len(text):
        match = TOKEN.match(text, at)
        assert match, "no token: " + text[at:at + 30]
        at = match.end()
        kind = match.lastgroup
        word = match.group()
        if match["comment"]:
            assert "(*" not in word[2:], "nested comment"
        if match["real"]:
            yield "real", word
        elif match["integer"]:
            yield "integer", word
        elif match["name"]:
            assert "__" not in word and not word.endswith("_"), word
            assert not word.startswith("_"), word
            yield ("word", word.upper()) if word.upper() in WORDS else (
                "name", word.upper())
        elif match["sign"]:
            yield "sign", word
        else:
            assert kind in ("space", "comment"), kind
    yield "end", ""


class Reader:
    """Turns a file into Python: functions and one class."""

    def __init__(self, text):
        self.tokens = list(tokens_of(text))
        self.at = 0
        self.functions = {}
        self.inputs = []
        self.scope = {}
        # Of all reals of a file.
        self.real = "REAL" if ("word", "REAL") in self.tokens else "LREAL"

    def rounded(self, text):
        return f"single({text})" if self.real == "REAL" else text

    def peek(self):
        return self.tokens[self.at]

    def take(self, kind, value=None):
        found = self.peek()
        assert found[0] == kind and value in (None, found[1]), (
            found, kind, value, self.tokens[self.at - 8:self.at + 3])
        self.at += 1
        return found[1]

    def accept(self, kind, value):
        if self.peek() == (kind, value):
            self.at += 1
            return True
        return False

    def read(self):
        code = []
        while self.peek() == ("word", "FUNCTION"):
            code += self.function()
        self.take("word", "FUNCTION_BLOCK")
        self.take("name")
        code += self.block()
        self.take("word", "END_FUNCTION_BLOCK")
        self.take("end")
        return "\n".join(code)

    def function(self):
        self.take("word", "FUNCTION")
        name = self.take("name")
        self.take("sign", ":")
        self.take("word", self.real)
        self.scope = {name: self.real}
        self.take("word", "VAR_INPUT")
        parameters = [self.declaration() for _ in range(1)]
        self.take("word", "END_VAR")
        body = self.statements()
        self.take("word", "END_FUNCTION")
        self.functions[name] = parameters[0]
        return [f"def F_{name}({parameters[0]}):",
                "    self = Block.__new__(Block)",
                f"    self.{parameters[0]} = {parameters[0]}",
                *body, f"    return self.{name}", ""]

    def declaration(self, owner=None):
        name = self.take("name")
        assert name not in self.scope, "declared twice: " + name
        self.take("sign", ":")
        if self.accept("word", "ARRAY"):
            self.take("sign", "[")
            assert self.take("integer") == "0"
            self.take("sign", "..")
            size = int(self.take("integer")) + 1
            self.take("sign", "]")
            self.take("word", "OF")
            self.take("word", self.real)
            self.scope[name] = size
            value = f"[0.0] * {size}"
            if self.accept("sign", ":="):
                value = self.initial_values(size)
        else:
            kind = self.take("word")
            assert kind in (self.real, "BOOL", "INT"), kind
            self.scope[name] = kind
            value = {self.real: "0.0", "BOOL": "False", "INT": "0"}[kind]
            if self.accept("sign", ":="):
                value = (self.rounded(self.take("real")) if kind == self.real
                         else str(self.take("word") == "TRUE"))
        self.take("sign", ";")
        if owner is not None:
            owner.append(f"        self.{name} = {value}")
        return name

    def initial_values(self, size):
        self.take("sign", "[")
        values = []
        while True:
            sign = "-" if self.accept("sign", "-") else ""
            values.append(self.rounded(sign + self.take("real")))
            if not self.accept("sign", ","):
                break
        self.take("sign", "]")
        assert len(values) == size, (len(values), size)
        return "[" + ", ".join(values) + "]"

    def block(self):
        self.scope = {}
        initial = []
        for section in ("VAR_INPUT", "VAR_OUTPUT", "VAR", "RETAIN"):
            if section == "RETAIN":
                self.take("word", "VAR")
            self.take("word", section)
            while not self.accept("word", "END_VAR"):
                name = self.declaration(initial)
                if section == "VAR_INPUT":
                    self.inputs.append(name)
        return ["class Block:", "    def __init__(self):", *initial, "",
                "    def call(self):",
                *["    " + line for line in self.statements()]]

    def statements(self):
        lines = []
        while True:
            if self.accept("word", "IF"):
                lines += self.condition()
            elif self.accept("word", "FOR"):
                lines += self.loop()
            elif self.peek()[0] == "name":
                lines.append("    " + self.assignment())
            else:
                return lines or ["    pass"]

    def condition(self):
        lines = [f"    if {self.typed('BOOL')}:"]
        self.take("word", "THEN")
        lines += ["    " + line for line in self.statements()]
        if self.accept("word", "ELSE"):
            lines += ["    else:"]
            lines += ["    " + line for line in self.statements()]
        self.take("word", "END_IF")
        self.take("sign", ";")
        return lines

    def loop(self):
        place, kind = self.variable(self.take("name"))
        assert kind == "INT", kind
        self.take("sign", ":=")
        first = int(self.take("integer"))
        self.take("word", "TO")
        last = int(self.take("integer"))
        self.take("word", "DO")
        lines = [f"    for {place} in range({first}, {last + 1}):"]
        lines += ["    " + line for line in self.statements()]
        self.take("word", "END_FOR")
        self.take("sign", ";")
        return lines

    def assignment(self):
        place, kind = self.variable(self.take("name"))
        self.take("sign", ":=")
        value = self.typed(kind)
        self.take("sign", ";")
        return f"{place} = {value}"

    def variable(self, name):
        kind = self.scope[name]
        if isinstance(kind, int):
            self.take("sign", "[")
            if self.peek()[0] == "integer":
                index = int(self.take("integer"))
                assert index < kind, (name, index)
            else:
                index, of = self.variable(self.take("name"))
                assert of == "INT", of
            self.take("sign", "]")
            return f"self.{name}[{index}]", self.real
        return f"self.{name}", kind

    def typed(self, kind):
        text, found = self.expression()
        assert found == kind, (text, found, kind)
        return text

    # Annex A: OR, then AND, comparison, sum, product, unary.
    def expression(self):
        text, kind = self.conjunction()
        while self.accept("word", "OR"):
            assert kind == "BOOL"
            other, other_kind = self.conjunction()
            assert other_kind == "BOOL"
            text = f"({text} or {other})"
        return text, kind

    def conjunction(self):
        text, kind = self.comparison()
        while self.accept("word", "AND"):
            assert kind == "BOOL"
            other, other_kind = self.comparison()
            assert other_kind == "BOOL"
            text = f"({text} and {other})"
        return text, kind

    def comparison(self):
        text, kind = self.sum()
        for sign in ("<=", ">=", "<", ">", "="):
            if self.accept("sign", sign):
                other, other_kind = self.sum()
                assert kind == other_kind == self.real
                sign = "==" if sign == "=" else sign
                return f"({text} {sign} {other})", "BOOL"
        return text, kind

    def binary(self, signs, part):
        text, kind = part()
        while self.peek() in [("sign", sign) for sign in signs]:
            sign = self.take("sign")
            other, other_kind = part()
            assert kind == other_kind == self.real
            text = self.rounded(f"({text} {sign} {other})")
        return text, kind

    def sum(self):
        return self.binary("+-", self.product)

    def product(self):
        return self.binary("*/", self.unary)

    def unary(self):
        if self.accept("sign", "-"):
            text, kind = self.primary()
            assert kind == self.real
            return f"(-{text})", kind
        if self.accept("word", "NOT"):
            text, kind = self.primary()
            assert kind == "BOOL"
            return f"(not {text})", kind
        return self.primary()

    def primary(self):
        kind, value = self.peek()
        self.at += 1
        if kind == "real":
            return self.rounded(value), self.real
        if (kind, value) == ("sign", "("):
            text, inner = self.expression()
            self.take("sign", ")")
            return f"({text})", inner
        if kind == "word" and value in ("TRUE", "FALSE"):
            return value.capitalize(), "BOOL"
        if kind == "word" and value in ("EXP", "SIN", "COS", "ABS"):
            self.take("sign", "(")
            text = self.typed(self.real)
            self.take("sign", ")")
            function = "abs" if value == "ABS" else "math." + value.lower()
            return self.rounded(f"{function}({text})"), self.real
        assert kind == "name", (kind, value)
        if value in self.functions:
            self.take("sign", "(")
            self.take("name", self.functions[value])
            self.take("sign", ":=")
            text = self.typed(self.real)
            self.take("sign", ")")
            return f"F_{value}({text})", self.real
        return self.variable(value)


def main():
    with open(sys.argv[1], encoding="ascii") as file:
        text = file.read()
    assert max(map(len, text.split("\n"))) <= 200, "a long line"
    reader = Reader(text)
    names = {"math": math, "single": lambda x: ctypes.c_float(x).value}
    taken = names["single"] if reader.real == "REAL" else float
    exec(compile(reader.read(), sys.argv[1], "exec"), names)
    block = names["Block"]()
    for row in sys.stdin:
        start, dt, *inputs = map(float, row.split())
        values = map(taken, inputs)
        for name in reader.inputs:
            if name == "START":
                block.START = start == 1.0
            elif name == "DTSECONDS":
                block.DTSECONDS = {1.0: 1e6, 3.0: 1e6, 4.0: 0.0}.get(start, dt)
            elif name == "AWAYSECONDS":
                block.AWAYSECONDS = dt if start == 4.0 else 1e30
            elif name == "TAKEZERO":
                block.TAKEZERO = start == 2.0
            elif name not in ("MAXERROR", "MAXRATE"):
                setattr(block, name, next(values))
        assert next(values, None) is None
        if start in (3.0, 4.0):
            block.RUNNING = False
        block.call()
        print(repr(block.ERROR), repr(block.COMPENSATION), int(block.VALID),
              int(block.OUTSIDE), int(block.FAR), int(block.CLIPPED),
              sum(bit for name, bit in BITS.items() if getattr(block, name)))


if __name__ == "__main__":
    main()
