# The users' pages in the order in which they are offered. Each is NAME.md here,
# or that of a slice, ../SLICE/NAME; "errmap help NAME" in the program and
# NAME.html in the manual.
set(manual_pages
  tutorial
  words
  csv
  which-map
  how-sure
  hold-outs
  why-not-the-net
  model-options
  fewer-sensors
  measure-next
  controller
  feeding
  still-holds
  re-zero
  components
  study-files
  ../fleet/machines
  python
  r
  library
  believe
  limits)
