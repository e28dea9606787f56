list(APPEND slice_units
  cli/machine/iso230_command
  cli/machine/machine_figures
  cli/machine/machine_study
  cli/machine/volumetric_command)
