#include "models/polynomial/polynomial_design.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "fitting/least_squares/triangular_reduction.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Moving input i keeps the span of the terms if with each term the same term
// with one power of i less is there (the intercept always is).
bool IsClosedUnder(const std::set<TermPowers>& terms, std::size_t input) {
  return std::all_of(terms.begin(), terms.end(), [&](TermPowers term) {
    if (term[input] == 0) return true;
    --term[input];
    const bool constant = std::all_of(
        term.begin(), term.end(), [](int power) { return power == 0; });
    return constant || terms.contains(term);
  });
}

}  // namespace

ColumnScaling PolynomialScaling(const Dataset& training,
                                const std::vector<Index>& inputs,
                                const std::vector<TermPowers>& terms,
                                Centring centring) {
  if (centring == Centring::kStandardised) {
    return StandardScaling(training.input_values()(Eigen::all, inputs));
  }
  const auto count = static_cast<Index>(inputs.size());
  ColumnScaling scaling{VectorXd(count), VectorXd(count)};
  const std::set<TermPowers> set(terms.begin(), terms.end());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto column = training.input_values().col(inputs[i]);
    const bool centred =
        centring == Centring::kAll ||
        (centring == Centring::kHarmless && IsClosedUnder(set, i));
    double offset = 0.0;
    double size = column.cwiseAbs().maxCoeff();
    if (centred) {
      const double range = column.maxCoeff() - column.minCoeff();
      offset = column.minCoeff() + 0.5 * range;
      size = 0.5 * range;
    }
    scaling.offset[static_cast<Index>(i)] = offset;
    scaling.scale[static_cast<Index>(i)] = size > 0.0 ? 1.0 / size : 1.0;
  }
  return scaling;
}

PolynomialDesign::PolynomialDesign(const Dataset& dataset,
                                   std::vector<Index> inputs,
                                   ColumnScaling scaling,
                                   std::vector<TermPowers> terms)
    : dataset_(dataset),
      inputs_(std::move(inputs)),
      scaling_(std::move(scaling)),
      terms_(std::move(terms)) {}

std::vector<std::string> PolynomialDesign::TermNames() const {
  std::vector<std::string> inputs;
  for (const Index input : inputs_) {
    inputs.push_back(dataset_.inputs()[static_cast<std::size_t>(input)].name);
  }
  std::vector<std::string> names;
  for (const TermPowers& term : terms_) names.push_back(TermName(term, inputs));
  return names;
}

MatrixXd PolynomialDesign::ScaledInputs() const {
  MatrixXd inputs = dataset_.input_values()(Eigen::all, inputs_);
  for (Index j = 0; j < inputs.cols(); ++j) {
    inputs.col(j) =
        (inputs.col(j).array() - scaling_.offset[j]) * scaling_.scale[j];
  }
  return inputs;
}

MatrixXd PolynomialDesign::Rows(const std::vector<Index>& rows) const {
  const MatrixXd inputs = dataset_.input_values()(rows, inputs_);
  return TermMatrix(scaling_.Apply(inputs), terms_);
}

MatrixXd PolynomialDesign::Rows(Index first, Index count) const {
  const MatrixXd inputs =
      dataset_.input_values().middleRows(first, count)(Eigen::all, inputs_);
  return TermMatrix(scaling_.Apply(inputs), terms_);
}

bool NeedsTriangle(Index rows, Index terms, double most_values) {
  // A triangle of more columns than rows would save nothing.
  return static_cast<double>(rows) * static_cast<double>(terms) > most_values &&
         rows > 2 * (terms + 2);
}

DesignRows CollectRows(const PolynomialDesign& design,
                       const std::vector<Index>& parts,
                       double most_values,
                       int threads) {
  const Dataset& dataset = design.dataset();
  const Index terms = design.num_terms();
  DesignRows rows;
  rows.observations = static_cast<double>(design.rows());
  if (!NeedsTriangle(design.rows(), terms, most_values)) {
    rows.terms = design.Rows(0, design.rows());
    rows.response = dataset.target_values();
    rows.weights = dataset.weights();
    rows.parts = parts;
    return rows;
  }
  const Index columns = terms + 2;  // intercept, terms, response
  std::vector<std::vector<Index>> members;
  if (!parts.empty()) {
    members.resize(static_cast<std::size_t>(
        *std::max_element(parts.begin(), parts.end()) + 1));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      members[static_cast<std::size_t>(parts[i])].push_back(
          static_cast<Index>(i));
    }
  }
  const std::size_t triangles = std::max<std::size_t>(1, members.size());
  const Index stacked = static_cast<Index>(triangles) * columns;
  rows.terms.resize(stacked, terms);
  rows.response.resize(stacked);
  rows.intercept.resize(stacked);
  for (std::size_t part = 0; part < triangles; ++part) {
    const auto fill = [&](Index first, Eigen::Ref<MatrixXd> block) {
      std::vector<Index> chosen(static_cast<std::size_t>(block.rows()));
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        const Index place = first + static_cast<Index>(i);
        chosen[i] = members.empty()
                        ? place
                        : members[part][static_cast<std::size_t>(place)];
      }
      block.col(0).setOnes();
      block.middleCols(1, terms) = design.Rows(chosen);
      block.col(columns - 1) = dataset.target_values()(chosen);
      if (dataset.weights().size() != 0) {
        const VectorXd roots = dataset.weights()(chosen).cwiseSqrt();
        block.array().colwise() *= roots.array();
      }
    };
    const Index count = members.empty()
                            ? design.rows()
                            : static_cast<Index>(members[part].size());
    const MatrixXd triangle =
        fitting::ReduceToTriangle(count, columns, fill, {.threads = threads});
    const Index first = static_cast<Index>(part) * columns;
    rows.intercept.segment(first, columns) = triangle.col(0);
    rows.terms.middleRows(first, columns) = triangle.middleCols(1, terms);
    rows.response.segment(first, columns) = triangle.col(columns - 1);
    if (!parts.empty()) {
      rows.parts.insert(rows.parts.end(),
                        static_cast<std::size_t>(columns),
                        static_cast<Index>(part));
    }
  }
  return rows;
}

}  // namespace errmap::models
