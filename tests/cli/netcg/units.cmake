list(APPEND slice_units
  cli/netcg/netcg_command
  cli/netcg/netcg_run
  cli/netcg/report_study
  cli/netcg/run_file)
