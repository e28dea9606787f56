#pragma once

#include <functional>
#include <string>

#include "models/error_model.h"
#include "models/export/export_map.h"

namespace errmap::cli {

/// Arguments of `export` about tables.
struct TableArguments {
  std::string increasing;  // model files
  std::string decreasing;
  std::string at;   // NAME=VALUE,...
  std::string log;  // CSV file of the session that led to the thermal state
  int row = -1;     // of the log, from 0; -1: the last
  double resolution = 0.0;
  std::string units = "mm";
  int points = 256;
  std::string over;  // input across the columns of a grid
  std::string grid = "33x9";
};

/// Returns the limits that the user set, in the unit of a target.
using LimitsFor = std::function<models::LimitOptions(const data::Unit&)>;

/// `--linuxcnc`: writes a COMP_FILE and describes its content. If neither
/// direction is named, `model` is used for both.
void ExportLinuxcnc(const std::string& model,
                    const TableArguments& arguments,
                    const LimitsFor& limits,
                    const std::string& out,
                    bool quiet);

/// `--table`: returns the grid of a map. Its description is written to `said`.
models::ExportedFile ExportTable(const models::FittedModel& fitted,
                                 const models::MapExport& map,
                                 const TableArguments& arguments,
                                 std::string* said);

}  // namespace errmap::cli
