# The report's program NETCG, run again, and its files.
errmap_library(netcg
  PUBLIC errmap_models
  PRIVATE fmt::fmt)

errmap_room(netcg netcg RUNS_ONCE
  netcg_files.cc
  netcg_run.cc
  report_study.cc
  run_file.cc
  run_report.cc
  weights_file.cc)

errmap_room(cli netcg/commands WITH cli_slices
  convert_command.cc
  netcg_command.cc)
target_link_libraries(errmap_cli PUBLIC errmap_netcg)
