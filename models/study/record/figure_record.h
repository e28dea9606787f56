#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/record.h"

// The rows behind the figures.

namespace errmap::models {

struct FigureInputRecord {
  std::string name;
  std::string unit;
};

/// Rows of a data set, which may come from several files; thinned evenly beyond
/// 5000. `file` is its name in messages.
struct FigureTableRecord {
  std::string file;
  std::int64_t rows_total = 0;
  std::vector<std::int64_t> rows;  // 0-based data rows
  std::vector<std::string> labels;
  std::vector<std::int64_t> groups;  // index into labels
  std::vector<double> target;
  std::vector<std::vector<double>> inputs;  // one list for each input
  LeftOut<std::vector<std::string>> session_labels;
  LeftOut<std::vector<std::int64_t>> sessions;  // index into them
  LeftOut<std::vector<double>> time;  // in data.time_unit, if that is s
};

struct FigureHoldoutRecord {
  std::string name;
  std::int64_t table = 0;
  ByName<std::vector<double>> predictions = {};  // NaN: not held out
  /// Table entries at which an input of the recommended map was outside the
  /// range of its fold's training rows.
  LeftOut<std::vector<std::int64_t>> outside = {};
};

struct CorrelationRecord {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> matrix;
};

struct FiguresRecord {
  std::vector<FigureInputRecord> inputs;
  std::int64_t inputs_left_out = 0;
  std::optional<std::string> position;
  std::optional<std::string> group;
  std::vector<FigureTableRecord> tables;
  std::vector<FigureHoldoutRecord> holdouts;
  /// Predictions of the recommended map, fitted to all rows, for the first
  /// table.
  LeftOut<std::vector<double>> fitted;
};

}  // namespace errmap::models
