# The users' pages in the order in which they are offered. Each is NAME.md here,
# "errmap help NAME" in the program and NAME.html in the manual.
set(manual_pages
  tutorial
  words
  csv
  which-map
  how-sure
  why-not-the-net
  fewer-sensors
  measure-next
  controller
  feeding
  still-holds
  re-zero
  components
  machines
  python
  r
  library
  believe
  limits)
