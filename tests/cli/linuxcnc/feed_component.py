"""Feeds an exported HAL component and checks what it says. Run by halrun:

  feed_component.py COMPONENT CASE.json RESULT.json

CASE has the pins in the order of the rows, rows (seconds since the row before,
readings) and the errors that `errmap predict` gives for them. The stock
component integ.0 counts the seconds of the thread, for to wait by.
"""

import json
import math
import sys
import time

import hal


class Component:
    def __init__(self, name, pins):
        self.name = name
        self.pins = pins

    def get(self, pin):
        return hal.get_value(self.name + "." + pin)

    def set(self, pin, value):
        hal.set_p(self.name + "." + pin, repr(value))

    def wait(self, seconds):
        """Until the thread has run for as long."""
        end = hal.get_value("integ.0.out") + seconds
        for _ in range(20000):
            if hal.get_value("integ.0.out") >= end:
                return
            time.sleep(0.0005)
        raise RuntimeError("the thread stands still")

    def periods(self, count=3):
        self.wait(0.001 * count)

    def readings(self, values):
        for pin, value in zip(self.pins, values):
            self.set(pin, value)

    def row(self, dt, values):
        """One rising edge of step."""
        self.readings(values)
        self.set("step-s", dt)
        before = self.get("steps")
        self.set("step", 1)
        for _ in range(20000):
            if self.get("steps") != before:
                break
            time.sleep(0.0005)
        assert self.get("steps") == before + 1, "one step per edge"
        self.set("step", 0)
        self.periods()

    def pulse(self, pin):
        self.set(pin, 1)
        self.periods()
        self.set(pin, 0)
        self.periods()


def session(component, case, result):
    """Row by row, limits off."""
    component.periods()
    result["offset_before"] = component.get("offset")
    result["valid_before"] = component.get("valid")
    worst = 0.0
    for (dt, *readings), error in zip(case["rows"], case["predicted"]):
        component.row(max(dt, 1.0), readings)
        worst = max(worst, abs(component.get("offset") + error))
        assert component.get("valid"), readings
    result["worst"] = worst
    result["steps"] = component.get("steps")


def failures(component, case, result):
    """Sessions whose sensors fail: what is given in each row."""
    result["given"] = []
    for rows in case["sessions"]:
        component.pulse("begin")
        given = []
        for dt, *readings in rows:
            component.row(dt, readings)
            given.append([component.get("offset"), component.get("status")])
        result["given"].append(given)


def leave(component, case, result):
    """Rows, and time for the user part to keep what they left."""
    component.pulse("begin")
    for dt, *readings in case["rows"]:
        component.row(max(dt, 1.0), readings)
    time.sleep(1.0)


def go_on(component, case, result):
    """Rows without a session that begins."""
    component.periods()
    result["away"] = component.get("away-s")
    result["restored"] = bool(component.get("state-restored"))
    result["given"] = []
    for dt, *readings in case["rows"]:
        component.row(dt, readings)
        result["given"].append([component.get("offset"),
                                component.get("settling-s")])


def missing(component, case, result):
    """A sensor that fails keeps the last good offset where the axis stands; the
    gap is one step."""
    rows, predicted = case["rows"], case["predicted"]
    component.row(1.0, rows[0][1:])
    component.row(rows[1][0], rows[1][1:])
    good = component.get("offset")
    held = []
    waited = 0.0
    for row, broken in ((2, math.nan), (3, math.inf), (4, 0.0), (5, 1e4)):
        dt, *readings = rows[row]
        readings[0] = rows[1][1]
        readings[-1] = broken
        component.row(dt, readings)
        waited += dt
        held.append(component.get("offset") == good
                    and not component.get("valid"))
    result["held"] = held
    component.row(rows[6][0], rows[6][1:])
    result["after_gap"] = component.get("offset") + case["predicted_with_gap"]
    result["valid_again"] = component.get("valid")
    # A little outside, an hour later, is extrapolated and said, not missing.
    readings = list(rows[6][1:])
    readings[-1] = case["a_little_outside"]
    component.row(3600.0, readings)
    result["outside"] = [component.get("outside"), component.get("valid")]


def zero(component, case, result):
    """The zero taken anew where nothing moves: a session that begins there."""
    rows = case["rows"]
    component.row(1.0, rows[0][1:])
    component.row(1.0, rows[-1][1:])
    component.row(1e9, rows[-1][1:])  # all filters have arrived
    component.set("zero", 1)
    component.periods()
    component.row(1e9, rows[-1][1:])
    result["zeroed"] = component.get("offset") + case["predicted_fresh"]
    component.set("zero", 0)


def limits(component, case, result):
    component.set("max-offset", 0.002)
    component.row(1.0, case["rows"][0][1:])
    result["most"] = abs(component.get("offset"))
    component.set("max-offset", 1.0)
    component.periods()
    full = component.get("offset")
    result["unlimited"] = full + case["predicted"][0]
    # A limit that is lowered holds at once; on the way back a rate of 0.01 mm/s
    # takes its time.
    component.set("max-rate", 0.01)
    component.set("max-offset", 1e-9)
    component.periods()
    start = component.get("offset")
    result["lowered"] = abs(start)
    begin = hal.get_value("integ.0.out")
    component.set("max-offset", 1.0)
    fastest = 0.0
    for _ in range(40):
        component.periods(10)
        now, at = component.get("offset"), hal.get_value("integ.0.out")
        # The two are read one after the other: 20 periods of slack.
        fastest = max(fastest, abs(now - start) / (at - begin + 0.02))
    result["fastest"] = fastest
    result["moved"] = abs(now - start)


def machine(component, case, result):
    """Counts: 0 until enabled, lost at off, right again after on."""
    component.row(1.0, case["rows"][0][1:])
    component.set("counts-scale", 1e-6)
    seen = []
    for on in (0, 1, 0, 1):
        component.set("machine-on", on)
        component.periods(15)
        seen.append([on, component.get("counts"),
                     component.get("counts-enable")])
    result["machine"] = seen
    result["counts"] = round(component.get("offset") / 1e-6)


def main():
    name, case_file, result_file = sys.argv[1:]
    with open(case_file, encoding="utf-8") as file:
        case = json.load(file)
    feeder = hal.component("feeder")
    feeder.ready()
    result = {}
    component = Component(name, case["pins"])
    try:
        globals()[case["what"]](component, case, result)
    except Exception as error:  # the caller has no stderr of ours
        result["failed"] = repr(error)
    with open(result_file, "w", encoding="utf-8") as file:
        json.dump(result, file)


if __name__ == "__main__":
    main()
