#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "models/export/program/error_curve.h"
#include "models/export/program/safe_names.h"
#include "models/export/program_text.h"

namespace errmap::models {
namespace {

// A name of halcompile as HAL shows it.
std::string HalName(std::string text) {
  std::ranges::replace(text, '_', '-');
  return text;
}

// Names of the readings in the component's source.
std::vector<std::string> PinIdentifiers(const MapProgram& program,
                                        const std::string& component) {
  const std::string prefix = "in_";
  std::vector<std::string> names;
  for (const ProgramReading& reading : program.readings) {
    names.push_back(reading.column.name);
  }
  names = SafeIdentifiers(
      names, kLongestHalName - component.size() - 1 - prefix.size());
  for (std::string& name : names) name.insert(0, prefix);
  const int position = PositionOf(program);
  if (position >= 0) names[static_cast<std::size_t>(position)] = "position";
  return names;
}

constexpr const char* kHalDeclarations = R"(component {0} "{1}";
description """
offset = compensation = -error, in {2}: the motor goes to the commanded position
plus it, never by more than max-offset, and never faster than max-rate but for
the axis' own motion. Readings that are dead, no number, far outside of what was
trained, frozen or contradicted by the others are not taken: for a minute the last
good ones are held where the axis is, then offset goes to 0, and valid is false.
Before the first valid step the offset is 0. Wire healthy to what stops the
program: while it is false the machine must not go on. The .hal files load it
with export_of={8}, and it refuses those of another export.
""";
author "errmap";
license "GPL";
option singleton yes;
option extra_setup yes;
modparam int export_of = 0 "The export that a .hal file is of; 0: not asked";
include <rtapi_math.h>;
{3}pin in bit begin "Rising edge: a session begins, filters steady";
pin in bit zero "Rising edge: take the zero again";
pin in bit step "Rising edge: a step of step-s seconds";
pin in float step_s = 0.0 "0: a step in every period of the thread";
pin in bit machine_on = 1 "For external offsets: on and homed";
pin io float kept_state_###[{7}] "What the map remembers, for a restart";
pin in bit keep_state "Another value: kept-state takes it";
pin out bit state_kept "The same value once it has";
pin in bit restore_state "Rising edge: goes on from kept-state";
pin in float away_s "How old kept-state is then, s";
pin out bit state_restored "It did: neither too old nor of another map";
pin out float offset "-error, {2}";
pin out bit valid "The last step had all its readings, and they were believed";
pin out bit healthy "False: the control must not go on with it; wire this one";
pin out u32 export_id = {8} "Which export this is";
pin out bit outside "A reading is outside of its trained range";
pin out u32 status_ "Bits; the source says which";
pin out float settling_s "s until what filters remember is good again";
pin out u32 steps "Steps made since it was loaded, missing readings or not";
pin out s32 counts "offset / counts-scale while machine-on, else 0";
pin out bit counts_enable "machine-on, a little later";
param rw float max_offset = {4} "Largest offset, {2}; not above 0, or ten times this: this";
param rw float max_rate_ = {5} "Largest change, {2}/s";
param rw float counts_scale = {6} "One count, {2}";
function _ fp;
;;
)";

constexpr const char* kBody = R"(
static {0}_state errmap_kept;
static double silent;       /* s since the last edge of step */
static double errmap_saved[{0}_SAVED];
static int begun, was_begin, was_step, was_zero, was_restore;
static int periods_on, of_reading;
static unsigned made;

EXTRA_SETUP() {{
  if (export_of == 0 || export_of == {0}_EXPORT) return 0;
  rtapi_print_msg(RTAPI_MSG_ERR,
      "{0}: the .hal file is of export %d, the component of %d\n", export_of,
      {0}_EXPORT);
  return -1;
}}

FUNCTION(_) {{
  double x[{2}];
  double error = 0.0;
  int of_moving, i;
{3}  if (!begun) {0}_init(&errmap_kept);
  begun = 1;
  errmap_kept.max_error = max_offset / {1};
  errmap_kept.max_rate = max_rate_ / {1};
  if (restore_state && !was_restore) {{
    for (i = 0; i < {0}_SAVED; ++i) errmap_saved[i] = kept_state(i);
    state_restored = {0}_set_state(&errmap_kept, errmap_saved, away_s) == 0;
  }}
  was_restore = restore_state;
  if (begin && !was_begin) {0}_begin(&errmap_kept);
  was_begin = begin;
  if (zero && !was_zero) {0}_zero(&errmap_kept);
  was_zero = zero;
  silent += fperiod;
  if (step_s > 0.0 && !(step && !was_step)) {{
    /* Who gives the edges has stopped: no reading is believed. */
    if (made > 0 && silent > 3.0 * step_s) {{
      x[0] = NAN;
      of_reading = {0}_read(&errmap_kept, silent, x);
      silent = 0.0;
    }}
  }} else {{
    of_reading = {0}_read(&errmap_kept, step_s > 0.0 ? step_s : fperiod, x);
    silent = 0.0;
    ++made;
  }}
  was_step = step;
  of_moving = {0}_move(&errmap_kept, fperiod, &error);
  if (keep_state != state_kept) {{
    {0}_get_state(&errmap_kept, errmap_saved);
    for (i = 0; i < {0}_SAVED; ++i) kept_state(i) = errmap_saved[i];
    state_kept = keep_state;
  }}
  steps = made;
  status_ = (unsigned)(of_reading | of_moving);
  valid = made > 0 && (of_reading & {0}_NOT_TAKEN) == 0;
  healthy = made > 0 && ((of_reading | of_moving) & {0}_UNHEALTHY) == 0;
  outside = (of_reading & {0}_OUTSIDE) != 0;
  offset = -{1} * error;
{5}
  /* LinuxCNC takes counts for relative to the moment of enabling, and forgets
   * them at machine off: they are 0 until it has seen the enable. */
  if (!machine_on) periods_on = 0;
  else if (periods_on < {4}) ++periods_on;
  counts_enable = periods_on > 1;
  counts = periods_on < {4} ? 0 : (int)floor(offset / counts_scale + 0.5);
}}
)";

// HAL's user part.
constexpr const char* kStateFile = R"(#!/usr/bin/python3
"""Keeps what {0} remembers in a file, to go on there after a restart.

  loadusr -Wn {1}-state python3 ./{0}_state.py FILE [SECONDS]

FILE is written every 10 SECONDS and at the end. One that is too old, or of
another map, is not taken: the component then says how long it settles.
"""

import json
import os
import signal
import sys
import time

import hal

NUMBERS = {2}
EXPORT = {3}


def get(pin):
    return hal.get_value("{1}." + pin)


def put(pin, value):
    hal.set_p("{1}." + pin, repr(value))


def restore(file):
    """Before the thread starts, which then takes it."""
    try:
        with open(file, encoding="utf-8") as text:
            kept = json.load(text)
        numbers = [float(number) for number in kept["state"]]
        away = time.time() - float(kept["time"])
    except (OSError, ValueError, TypeError, KeyError):
        return
    if len(numbers) != NUMBERS:
        return
    for i, number in enumerate(numbers):
        put("kept-state-%03d" % i, number)
    put("away-s", away)
    put("restore-state", 1)


def keep(file):
    """Nothing where the thread does not run."""
    turn = int(not get("state-kept"))
    put("keep-state", turn)
    end = time.monotonic() + 0.5
    while int(get("state-kept")) != turn:
        if time.monotonic() > end:
            return
        time.sleep(0.001)
    kept = {{"time": time.time(),
            "state": [get("kept-state-%03d" % i) for i in range(NUMBERS)]}}
    with open(file + ".new", "w", encoding="utf-8") as text:
        json.dump(kept, text)
        text.flush()
        os.fsync(text.fileno())
    os.replace(file + ".new", file)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    file = sys.argv[1]
    seconds = float(sys.argv[2]) if len(sys.argv) == 3 else 10.0
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    part = hal.component("{1}-state")
    if int(get("export-id")) != EXPORT:
        sys.exit("%s is of export %d, the component of %d"
                 % (sys.argv[0], EXPORT, int(get("export-id"))))
    restore(file)
    part.ready()
    try:
        while True:
            time.sleep(seconds)
            keep(file)
    finally:
        keep(file)


if __name__ == "__main__":
    main()
)";

class HalWriter {
 public:
  HalWriter(const MapExport& map, const HalOptions& options)
      : map_(map),
        options_(options),
        name_("errmap_" + SafeIdentifier(map.name, kLongestMap)),
        pins_(PinIdentifiers(map.program, name_)) {
    if (!data::AreConvertible(map.program.target.unit, options.unit)) {
      throw std::invalid_argument(
          fmt::format("'{}' is not a length that can be written in {}",
                      CommentText(map.program.target.name),
                      options.unit.symbol));
    }
  }

  HalExport Write() const {
    HalExport made{.component = name_, .pins = {}, .files = {}};
    for (std::size_t i = 0; i < pins_.size(); ++i) {
      made.pins.push_back(
          {HalName(pins_[i]), map_.program.readings[i].column.name});
    }
    // The component last: with a newer .hal file an older one does not load.
    made.files = {{name_ + ".hal", OffsetWiring()},
                  {name_ + "_eoffset.hal", ExternalOffsetWiring()},
                  {name_ + "_state.py",
                   fmt::format(kStateFile,
                               name_,
                               HalName(name_),
                               NumSaved(map_.program),
                               static_cast<int>(map_.program.export_id))},
                  {name_ + ".comp", Component()}};
    return made;
  }

 private:
  // The longest name of a pin of the component is as long as `counts-enable`;
  // the sensors' names share what is left.
  static constexpr std::size_t kLongestMap = 16;

  double InMachine(double value, const data::Unit& unit) const {
    return data::Converted(value, unit, options_.unit);
  }

  // A reading's pin: the position comes in the machine's unit.
  std::string Reading(std::size_t i) const {
    const data::Unit& unit = map_.program.readings[i].column.unit;
    const bool converts = pins_[i] == "position" &&
                          data::AreConvertible(options_.unit, unit) &&
                          unit.symbol != options_.unit.symbol;
    return converts ? fmt::format(
                          "position * {}",
                          RealText(data::Converted(1.0, options_.unit, unit)))
                    : pins_[i];
  }

  std::string PinUnit(std::size_t i) const {
    const data::Unit& unit = map_.program.readings[i].column.unit;
    return pins_[i] == "position" && data::AreConvertible(options_.unit, unit)
               ? options_.unit.symbol
               : unit.symbol;
  }

  std::string Component() const {
    const MapProgram& program = map_.program;
    std::string pins;
    std::string readings;
    for (std::size_t i = 0; i < pins_.size(); ++i) {
      pins += fmt::format("pin in float {} \"{}, {}\";\n",
                          pins_[i],
                          CommentText(program.readings[i].column.name),
                          CommentText(PinUnit(i)));
      readings += fmt::format("  x[{}] = {};\n", i, Reading(i));
    }
    const double scale = InMachine(1.0, program.target.unit);
    const double count = InMachine(1e-6, data::UnitOfSymbol("mm"));
    const std::string map_name = SafeIdentifier(map_.name, kLongestMap);
    return fmt::format(kHalDeclarations,
                       name_,
                       fmt::format("Minus the error that the map {} predicts",
                                   CommentText(program.model)),
                       options_.unit.symbol,
                       pins,
                       RealText(scale * program.limits.max_error),
                       RealText(scale * program.limits.max_rate),
                       RealText(count),
                       NumSaved(program),
                       static_cast<int>(program.export_id)) +
           CFragment(program, map_name) +
           fmt::format(kBody,
                       map_name,
                       RealText(scale),
                       std::max<std::size_t>(pins_.size(), 1),
                       pins_.empty() ? "  x[0] = 0.0;\n" : readings,
                       10,
                       program.Uses(Cell::kSettling)
                           ? "  settling_s = errmap_kept.settles_in;\n"
                           : "");
  }

  std::string OffsetWiring() const {
    std::string text = fmt::format(
        R"(# {0}.hal: compensates joint {1} by {2}, offset = -error in {3}.
# After the machine's own HALFILE, less its nets of joint.{1}.motor-pos-cmd and
# joint.{1}.motor-pos-fb. Between the two stands the stock component offset, so
# that LinuxCNC sees no following error; it holds through machine off and on.
loadrt {0} export_of={4}
loadrt offset names={2}-add

addf {2}-add.update-feedback servo-thread 1
addf {2} servo-thread
addf {2}-add.update-output servo-thread

)",
        name_,
        options_.joint,
        HalName(name_),
        options_.unit.symbol,
        static_cast<int>(map_.program.export_id));
    return text + InputWiring() + StateComment() +
           fmt::format(
               R"(
net {0}-cmd joint.{1}.motor-pos-cmd => {0}-add.in
net {0}-by {0}.offset => {0}-add.offset
net {0}-fb {0}-add.fb-out => joint.{1}.motor-pos-fb
# A simulated motor; on a machine add.out goes to the drive and the encoder
# comes to add.fb-in.
net {0}-motor {0}-add.out => {0}-add.fb-in
)",
               HalName(name_),
               options_.joint);
  }

  std::string ExternalOffsetWiring() const {
    constexpr const char* kAxes = "xyzabcuvw";
    const char axis = kAxes[options_.joint];
    const std::string hal = HalName(name_);
    std::string text = fmt::format(
        R"(# {0}_eoffset.hal: the same as an external offset, in place of {0}.hal.
# The INI file needs, in [AXIS_{1}]:  OFFSET_AV_RATIO = 0.2
# Counts are whole numbers of counts-scale, relative to the moment when the
# machine is on and homed, and lost at machine off: {2} holds them at 0
# until then, each time. LinuxCNC stops a little short of them.
loadrt {0} export_of={3}
loadrt and2 names={2}-ready
addf {2}-ready servo-thread
addf {2} servo-thread

)",
        name_,
        static_cast<char>(axis - 'a' + 'A'),
        hal,
        static_cast<int>(map_.program.export_id));
    return text + InputWiring() + StateComment() +
           fmt::format(
               R"(
setp axis.{1}.eoffset-scale {2}
setp {0}.counts-scale {2}
net {0}-on motion.motion-enabled => {0}-ready.in0
net {0}-homed motion.is-all-homed => {0}-ready.in1
net {0}-set {0}-ready.out => {0}.machine-on
net {0}-enable {0}.counts-enable => axis.{1}.eoffset-enable
net {0}-counts {0}.counts => axis.{1}.eoffset-counts
)",
               hal,
               axis,
               RealText(InMachine(1e-6, data::UnitOfSymbol("mm"))));
  }

  std::string InputWiring() const {
    std::string text;
    const MapProgram& program = map_.program;
    if (PositionOf(program) >= 0) {
      text = fmt::format("net {0}-at joint.{1}.pos-cmd => {0}.position\n",
                         HalName(name_),
                         options_.joint);
    }
    for (std::size_t i = 0; i < pins_.size(); ++i) {
      if (pins_[i] == "position") continue;
      text += fmt::format("# net SENSOR{0} => {1}.{2} # {3}, {4}\n",
                          i,
                          HalName(name_),
                          HalName(pins_[i]),
                          CommentText(program.readings[i].column.name),
                          CommentText(PinUnit(i)));
    }
    return text;
  }

  std::string StateComment() const {
    return fmt::format(
        "# To go on where it was after a restart:\n"
        "# loadusr -Wn {}-state python3 ./{}_state.py FILE\n",
        HalName(name_),
        name_);
  }

  const MapExport& map_;
  const HalOptions& options_;
  std::string name_;
  std::vector<std::string> pins_;
};

}  // namespace

HalExport HalComponent(const MapExport& map, const HalOptions& options) {
  return HalWriter(map, options).Write();
}

}  // namespace errmap::models
