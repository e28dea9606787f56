# A machine: its kinematic chain, the error at the tool, ISO 230.
errmap_room(report machine/record WITH report_slices
  machine_figures.cc
  machine_record.cc
  machine_tables.cc)

errmap_room(study_setup machine RUNS_ONCE
  machine_file.cc
  machine_judge.cc
  machine_points.cc
  machine_study.cc
  true_poses.cc)
set_property(GLOBAL APPEND PROPERTY errmap_public_slices machine)

errmap_room(cli machine/commands WITH cli_slices
  iso230_command.cc
  machine_slice.cc
  volumetric_command.cc)
