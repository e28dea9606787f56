#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/measurements/column_faults.h"
#include "data/measurements/dataset.h"
#include "models/record.h"

// The data of a component, the unit of display, and how its rows are held
// out.

namespace errmap::models {

/// Faulty readings; data::ColumnFault.
struct FaultRecord {
  data::FaultKind kind = data::FaultKind::kOutlying;
  std::string column;
  std::vector<std::int64_t> rows;  // 0-based data rows
  bool of_cells = false;
  double value = kNotKnown;
  double low = kNotKnown;
  double high = kNotKnown;
};

struct DataRecord {
  std::string file;
  std::string sha256;
  std::int64_t rows = 0;
  std::string target;
  std::string unit;  // "": none
  std::vector<std::string> inputs;
  std::int64_t sensors = 0;  // how many of these are read by a sensor
  std::optional<std::string> group = {};
  std::int64_t groups = 0;
  std::optional<std::string> session = {};
  std::optional<std::string> time;
  std::string time_unit;
  std::int64_t sessions = 0;
  data::Alignment align = data::Alignment::kNone;
  std::vector<data::DroppedColumn> dropped;
  std::vector<FaultRecord> faults;
  std::vector<std::string> remarks;  // on columns and rows, one line each
  std::vector<std::string> doubts;   // of these, shown with every answer
  data::Reading reading;
};

/// The displayed value is value * scale, in this unit.
struct DisplayRecord {
  std::string unit;
  double scale = 1.0;
};

using RowsOfFolds = std::vector<std::vector<std::int64_t>>;

struct HoldoutRecord {
  std::string name;
  std::int64_t folds = 0;
  bool whole_groups = false;
  bool whole_sessions = false;
  bool among_neighbours = false;
  bool another_file = false;
  LeftOut<std::int64_t> rows_of_training = {};  // in the test file
  std::int64_t repeats = 1;
  /// For each fold: how its training rows are held out for choices in a fit.
  std::vector<std::string> inner = {};
  RowsOfFolds train_rows = {};
  RowsOfFolds test_rows = {};
  std::string unit_of_analysis;
  std::int64_t units = 0;
  std::vector<std::string> unit_labels;
};

}  // namespace errmap::models
