list(APPEND slice_units
  cli/fleet/component_pattern
  cli/fleet/component_summary
  cli/fleet/fleet
  cli/fleet/fleet_watch
  cli/fleet/launcher)
