# The simulator of a machine whose truth is known.
errmap_library(turning_centre
  PUBLIC errmap_data
  PRIVATE fmt::fmt)

errmap_room(turning_centre turning_centre
  component_errors.cc
  day_programme.cc
  machine.cc
  portable_math.cc
  simulation.cc
  simulation_files.cc
  thermal_network.cc
  thermocouples.cc)
set_property(GLOBAL APPEND PROPERTY errmap_public_slices turning_centre)
set_property(GLOBAL APPEND PROPERTY errmap_public_libraries
  errmap_turning_centre)

errmap_room(cli turning_centre/commands WITH cli_slices
  simulate_command.cc)
target_link_libraries(errmap_cli PUBLIC errmap_turning_centre)
