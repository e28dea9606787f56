#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data/measurements/dataset.h"

// What the tests of MakeDataset and of its parts share.

namespace errmap::data {

inline PreparedDataset Make(std::string_view text,
                            const DatasetSelection& selection = {}) {
  return MakeDataset(ParseCsv(text, "f.csv"), selection);
}

// Message of the InputError, or what happened instead.
inline std::string ErrorOf(std::string_view text,
                           const DatasetSelection& selection = {}) {
  try {
    Make(text, selection);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

inline std::vector<std::string> InputNames(const Dataset& dataset) {
  std::vector<std::string> names;
  for (const ColumnInfo& input : dataset.inputs()) names.push_back(input.name);
  return names;
}

inline std::vector<double> Column(const Dataset& dataset, Eigen::Index input) {
  const Eigen::VectorXd values = dataset.input_values().col(input);
  return {values.begin(), values.end()};
}

inline std::vector<std::string> DroppedNames(const PreparedDataset& prepared) {
  std::vector<std::string> names;
  for (const DroppedColumn& d : prepared.dropped) names.push_back(d.column);
  return names;
}

}  // namespace errmap::data
