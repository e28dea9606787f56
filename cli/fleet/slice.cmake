# A fleet: studies of many components in one store.
errmap_library(fleet
  PUBLIC errmap_study_setup
  PRIVATE fmt::fmt nlohmann_json::nlohmann_json)

errmap_room(fleet fleet/run RUNS_ONCE
  component_pattern.cc
  fleet_plan.cc
  fleet_proposal.cc
  fleet_run.cc)

errmap_room(fleet fleet/store WITH fleet_run
  component_summary.cc
  deployments.cc
  fleet_report.cc
  fleet_table.cc
  merge.cc
  store.cc
  store_folder.cc
  store_schema.cc
  watch_report.cc
  watched_files.cc
  watched_maps.cc)

errmap_room(cli fleet/commands WITH cli_slices
  compare_fleet.cc
  deploy_command.cc
  fleet_slice.cc
  launcher.cc
  merge_command.cc
  submit_command.cc
  watch_command.cc)
target_link_libraries(errmap_cli PUBLIC errmap_fleet)
