list(APPEND ERRMAP_PUBLIC_HEADERS
  cli/machine/machine_file.h
  cli/machine/machine_study.h)
