#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stats/bias.h"
#include "stats/eigen.h"
#include "stats/normality/normality.h"
#include "stats/randomness.h"

namespace errmap::models {

/// Residuals in order of measurement with their columns; a column name of ""
/// means that there is no such column.
struct ResidualInputs {
  VectorXd values;  // (n)
  std::string order = "file order";
  std::string group_column = {};
  std::vector<Index> group_codes = {};  // (n) into group_labels
  std::vector<std::string> group_labels = {};
  std::string position_column = {};
  VectorXd positions = {};  // (n)
  std::string fitted_column = {};
  VectorXd fitted = {};  // (n)
};

/// Biases at the levels of one column.
struct NamedBias {
  std::string column;
  std::vector<std::string> labels;  // by level
  stats::BiasByLevel bias;
};

/// All statistics of one set of residuals, the only source of text and JSON.
struct ResidualReport {
  std::string order;
  stats::Normality normality;
  stats::MonteCarloP monte_carlo;            // draws = 0: not requested
  stats::SerialTests whole;                  // over the whole order
  std::string group_column;                  // "": no groups
  std::optional<stats::SerialTests> within;  // within groups
  stats::SerialShuffles whole_shuffles;      // draws = 0: not requested
  stats::SerialShuffles within_shuffles;
  stats::TestResult halves;
  std::optional<NamedBias> by_group;
  std::optional<NamedBias> by_position;
  std::string fitted_column;
  std::optional<stats::TestResult> breusch_pagan;
};

/// Assesses the residuals, with `monte_carlo` simulated samples and shuffles
/// (0: none) from this seed.
ResidualReport AssessResiduals(const ResidualInputs& inputs,
                               Index monte_carlo = 0,
                               std::uint64_t seed = 1);

}  // namespace errmap::models
