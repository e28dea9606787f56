"""A LinuxCNC component as plain C, for exports_hold_test.py: its pins are
variables and its function is called row by row, as the thread would do it. What
halcompile and the real LinuxCNC make of it, linuxcnc_test.py tries.
"""

import re

DRIVER = """#include <math.h>
#include <stdio.h>
#define EXTRA_SETUP() int component_setup(void)
#define FUNCTION(name) static void component(void)
#define rtapi_print_msg(level, ...) fprintf(stderr, __VA_ARGS__)
#define kept_state(i) kept_state_[i]
static double fperiod;
{pins}
{body}
static void reload(void) {{
  begun = was_begin = was_step = was_zero = was_restore = 0;
  made = 0;
  silent = 0.0;
}}
/* Goes on from what was kept, of which a number was changed. */
static void restart(int changed, double value) {{
  keep_state = !state_kept;
  step = 0;
  fperiod = 0.0;
  component();
  if (changed >= 0) kept_state_[changed] = value;
  reload();
  away_s = 1.0;
  restore_state = 1;
}}
int main(void) {{
  double start, dt, value, max_error, max_rate;
  while (scanf("%lf %lf %lf %lf", &start, &dt, &max_error, &max_rate) == 4) {{
    int changed;
{reads}    if (start == 9.0) {{
      if (scanf("%d %lf", &changed, &value) != 2) return 1;
      restart(changed, value);
    }}
    if (start == 1.0) reload();
    begin = start == 1.0 || start == 5.0;
    max_offset = max_error;
    max_rate_ = max_rate;
    fperiod = step_s = dt;
    step = dt > 0.0;
    component();
    printf("%.17g %d\\n", -offset, (int)status_);
    step = restore_state = 0;
    fperiod = 0.0;
    if (dt > 0.0) component();
  }}
  return 0;
}}
"""
PIN = re.compile(r"^(?:pin (?:in|out|io)|param rw|modparam) (\w+) "
                 r"(\w+?)(?:###\[(\d+)\])?(?: = ([^ ]+))? \"", re.M)


def component_in_c(text, inputs):
    """(its C, how many numbers it keeps); `inputs` are the map's."""
    head, body = text.split("\n;;\n", 1)
    pins, kept, given = [], 0, []
    for kind, name, size, default in PIN.findall(head):
        kind = "double" if kind == "float" else "int"
        pins.append(f"static {kind} {name}" + (
            f"[{size}];" if size else f" = {default or 0};"))
        kept = int(size) if size else kept
        if name == "position" or name.startswith("in_"):
            given.append(name)
    assert len(given) == inputs, given
    reads = "".join(f'    if (scanf("%lf", &{name}) != 1) return 1;\n'
                    for name in given)
    return DRIVER.format(pins="\n".join(pins), body=body, reads=reads), kept
