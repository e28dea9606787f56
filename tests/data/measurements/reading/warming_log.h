#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"

// Logs of a machine that warms, as text, and how they are read.

namespace errmap::data::warming_log {

// A machine that warms: days of cycles of positions, up or both ways.
struct Log {
  int days = 4;
  int cycles = 5;
  int positions = 6;
  double step = 10.0;      // s
  double pause = 300.0;    // s
  double night = 50000.0;  // s
  bool both_ways = false;

  struct Row {
    int day = 0;
    int cycle = 0;  // in all days
    double time = 0.0;
    double position = 0.0;
    double warm = 0.0;
    double error = 0.0;
  };

  std::vector<Row> Rows() const {
    std::vector<Row> rows;
    double time = 1000.0;
    for (int day = 0; day < days; ++day) {
      const double begin = time;
      for (int cycle = 0; cycle < cycles; ++cycle) {
        const int ways = both_ways ? 2 : 1;
        for (int i = 0; i < ways * positions; ++i) {
          const int at = i < positions ? i : ways * positions - 1 - i;
          const double warm =
              20.0 + 0.3 * day + 5.0 * (1.0 - std::exp((begin - time) / 2000));
          const double noise =
              std::sin(12.9898 * static_cast<double>(rows.size() + 1)) * 1e4;
          rows.push_back({.day = day,
                          .cycle = day * cycles + cycle,
                          .time = time,
                          .position = 50.0 * at,
                          .warm = warm,
                          .error = 2.0 * (warm - 20.0) + 0.5 * at +
                                   (i < positions ? 0.0 : 3.0) + 0.1 * noise -
                                   0.1 * std::floor(noise)});
          time += step;
        }
        time += pause;
      }
      time += night;
    }
    return rows;
  }
};

inline std::string Fixed(double value) {
  return CsvNumber(std::round(1e4 * value) / 1e4);
}

using CellsOfRow = std::function<std::vector<std::string>(const Log::Row&)>;

inline std::string Text(const std::string& header,
                        const std::vector<Log::Row>& rows,
                        const CellsOfRow& cells) {
  std::string text = header + "\n";
  for (const Log::Row& row : rows) {
    std::string line;
    for (const std::string& cell : cells(row)) {
      line += (line.empty() ? "" : ",") + cell;
    }
    text += line + "\n";
  }
  return text;
}

inline Reading Read(const std::string& text,
                    const DatasetSelection& selection = {}) {
  return MakeDataset(ParseCsv(text, "log.csv"), selection).reading;
}

inline std::vector<std::string> TimePositionTempError(const Log::Row& row) {
  return {
      Fixed(row.time), Fixed(row.position), Fixed(row.warm), Fixed(row.error)};
}

}  // namespace errmap::data::warming_log
