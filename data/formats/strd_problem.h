#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

enum class StrdKind { kNonlinear, kLinear, kUnivariate };

/// A certified parameter. All numbers are in NIST's decimal text, since doubles
/// would round them.
struct StrdParameter {
  std::string name;
  std::string start1;  // "" for linear sets
  std::string start2;
  std::string certified;
  std::string standard_deviation;
};

/// The design matrix of a linear set.
enum class StrdDesign {
  kNone,
  kPowers,     // x^low ... x^high of the only predictor
  kIntercept,  // 1 and the predictors
};

/// A Statistical Reference Dataset of NIST: data and certified values.
struct StrdProblem {
  StrdKind kind = StrdKind::kNonlinear;
  std::string name;
  std::string level;  // "lower", "average", "higher": difficulty
  std::vector<StrdParameter> parameters;
  std::string residual_sum_of_squares;
  int degrees_of_freedom = 0;
  StrdDesign design = StrdDesign::kNone;
  int low_power = 0;
  int high_power = 0;
  std::string mean;  // univariate sets
  std::string standard_deviation;
  std::string autocorrelation;       // at lag 1
  std::vector<std::string> columns;  // the response first
  /// One row per observation; univariate: one column.
  std::vector<std::vector<std::string>> rows;
};

/// Reads a problem from the text of its file (data/sets/nist_strd/README.md).
/// `name` is its name in messages. Throws InputError with line and word.
StrdProblem ParseStrdProblem(std::string_view text, const std::string& name);

/// Returns all problems of data/sets/nist_strd, which are built into the
/// program, by kind and name.
const std::vector<StrdProblem>& StrdProblems();

}  // namespace errmap::data
