list(APPEND slice_units
  cli/turning_centre/component_errors
  cli/turning_centre/day_programme
  cli/turning_centre/machine
  cli/turning_centre/portable_math
  cli/turning_centre/simulate_command
  cli/turning_centre/simulation
  cli/turning_centre/simulation_files
  cli/turning_centre/thermal_network
  cli/turning_centre/thermocouples)
