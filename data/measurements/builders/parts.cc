#include "data/measurements/builders/parts.h"

#include <cstddef>
#include <utility>

namespace errmap::data {

using Eigen::Index;

void KeepRows(const std::vector<Index>& kept, Dataset::Parts* parts) {
  if (kept.size() == parts->rows.size()) return;
  std::vector<Index> rows;
  for (const Index i : kept) {
    rows.push_back(parts->rows[static_cast<std::size_t>(i)]);
  }
  parts->rows = std::move(rows);
  parts->target_values = parts->target_values(kept).eval();
  parts->input_values = parts->input_values(kept, Eigen::all).eval();
  if (parts->weights.size() != 0) parts->weights = parts->weights(kept).eval();
}

std::vector<Index> LeaveOutInputs(const std::vector<bool>& left_out,
                                  Dataset::Parts* parts) {
  std::vector<Index> kept;
  std::vector<ColumnInfo> inputs;
  std::vector<Index> places(left_out.size(), -1);
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    if (left_out[i]) continue;
    places[i] = static_cast<Index>(kept.size());
    kept.push_back(static_cast<Index>(i));
    inputs.push_back(std::move(parts->inputs[i]));
  }
  parts->inputs = std::move(inputs);
  if (kept.size() < left_out.size()) {
    parts->input_values = parts->input_values(Eigen::all, kept).eval();
  }
  return places;
}

}  // namespace errmap::data
