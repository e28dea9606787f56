#!/usr/bin/python3
"""The display of a headless LinuxCNC: moves joint 0 and notes what the motor is
told beyond the command. Named in the INI file:

  DISPLAY = /path/move_axis.py CASE.json RESULT.json
"""

import json
import sys
import time

import hal
import linuxcnc

command = linuxcnc.command()
status = linuxcnc.stat()


def wait_until(what, condition, seconds=60.0):
    end = time.time() + seconds
    while time.time() < end:
        status.poll()
        if condition():
            return
        time.sleep(0.002)
    raise RuntimeError("waited in vain: " + what)


def pin(name):
    return hal.get_value("joint.0." + name)


def switch_on():
    command.state(linuxcnc.STATE_ESTOP_RESET)
    wait_until("estop", lambda: status.task_state != linuxcnc.STATE_ESTOP)
    command.state(linuxcnc.STATE_ON)
    wait_until("on", lambda: status.task_state == linuxcnc.STATE_ON)
    if not all(status.homed[:3]):
        command.mode(linuxcnc.MODE_MANUAL)
        command.wait_complete()
        command.home(-1)
        wait_until("home", lambda: all(status.homed[:3]))
    command.mode(linuxcnc.MODE_MDI)
    command.wait_complete()


def move_to(position):
    command.mdi("G53 G0 X%.9f" % position)
    command.wait_complete(60)
    # The command of a joint has the external offset in it.
    wait_until("position", lambda: status.inpos and abs(
        pin("pos-cmd") - hal.get_value("axis.x.eoffset") - position) < 1e-9)


def compensation(case, result):
    """What a COMP_FILE adds, from both sides of each position."""
    switch_on()
    found = []
    for position in case["positions"]:
        for side in (-1.0, 1.0):
            move_to(position + 0.5 * side)
            move_to(position)
            wait_until("settled", lambda: abs(
                pin("backlash-filt") - pin("backlash-corr")) < 1e-10)
            added = (pin("motor-pos-cmd") - pin("pos-cmd")
                     - pin("motor-offset"))
            # Coming from below is motion towards increasing positions.
            found.append([position, side < 0.0, pin("backlash-filt"), added])
    result["found"] = found


def offset(case, result):
    """The stock offset component: the motor goes to command + offset."""
    name = case["component"]
    switch_on()
    found = []
    for position in case["positions"]:
        move_to(position)
        time.sleep(0.1)
        found.append([position, hal.get_value(name + ".offset"),
                      hal.get_value(name + "-add.out") - pin("motor-pos-cmd"),
                      pin("f-error")])
    command.state(linuxcnc.STATE_OFF)
    wait_until("off", lambda: status.task_state != linuxcnc.STATE_ON)
    time.sleep(0.2)
    result["off"] = [hal.get_value(name + ".offset"), pin("f-error")]
    switch_on()
    time.sleep(0.2)
    result["on_again"] = [hal.get_value(name + ".offset"), pin("f-error")]
    result["found"] = found


def external(case, result):
    """External offsets, through machine off and on."""
    name = case["component"]
    switch_on()
    found = []
    for position in case["positions"]:
        move_to(position)
        time.sleep(1.0)
        found.append([hal.get_value(name + ".offset"),
                      hal.get_value("axis.x.eoffset")])
    command.state(linuxcnc.STATE_OFF)
    wait_until("off", lambda: status.task_state != linuxcnc.STATE_ON)
    time.sleep(0.3)
    result["off"] = hal.get_value("axis.x.eoffset")
    switch_on()
    time.sleep(1.5)
    result["on_again"] = [hal.get_value(name + ".offset"),
                          hal.get_value("axis.x.eoffset")]
    result["found"] = found


def main():
    # LinuxCNC adds `-ini FILE` before or after our words.
    words = [word for word in sys.argv[1:] if word.endswith(".json")]
    with open(words[0], encoding="utf-8") as file:
        case = json.load(file)
    result = {}
    mover = hal.component("mover")  # pins can be read while it lives
    mover.ready()
    try:
        globals()[case["what"]](case, result)
    except Exception as error:
        result["failed"] = repr(error)
    with open(words[1], "w", encoding="utf-8") as file:
        json.dump(result, file)


if __name__ == "__main__":
    main()
