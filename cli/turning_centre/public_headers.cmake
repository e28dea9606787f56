list(APPEND ERRMAP_PUBLIC_HEADERS
  cli/turning_centre/machine.h
  cli/turning_centre/simulation.h)
