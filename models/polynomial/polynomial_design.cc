#include "models/polynomial/polynomial_design.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "fitting/interruption.h"
#include "fitting/least_squares/triangular_reduction.h"
#include "models/error_model.h"
#include "models/shared_work.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

using data::Dataset;
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

template <typename Number>
void AppendBytes(const Number* from, std::size_t count, std::string* to) {
  to->append(reinterpret_cast<const char*>(from), count * sizeof(Number));
}

// All that the triangle of a design depends on, but for the rows.
std::string KeyOf(const PolynomialDesign& design) {
  std::string key = "triangle";
  for (const Index input : design.inputs()) {
    const auto& info = design.dataset().inputs();
    key += ' ' + info[static_cast<std::size_t>(input)].name;
  }
  for (const VectorXd* numbers :
       {&design.scaling().offset, &design.scaling().scale}) {
    AppendBytes(
        numbers->data(), static_cast<std::size_t>(numbers->size()), &key);
  }
  for (const TermPowers& powers : design.terms()) {
    AppendBytes(powers.data(), powers.size(), &key);
  }
  return key;
}

}  // namespace

ColumnScaling PolynomialScaling(const Dataset& training,
                                const std::vector<Index>& inputs,
                                const std::vector<TermPowers>& terms,
                                Centring centring) {
  if (centring == Centring::kStandardised) {
    return StandardScaling(training.input_values()(Eigen::all, inputs));
  }
  const auto count = std::ssize(inputs);
  ColumnScaling scaling{VectorXd(count), VectorXd(count)};
  // With very many terms the set alone would take seconds.
  const std::set<TermPowers> set =
      centring == Centring::kHarmless
          ? std::set<TermPowers>(terms.begin(), terms.end())
          : std::set<TermPowers>();
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

std::vector<std::string> PolynomialDesign::InputNames() const {
  std::vector<std::string> names;
  for (const Index input : inputs_) {
    names.push_back(dataset_.inputs()[static_cast<std::size_t>(input)].name);
  }
  return names;
}

std::vector<std::string> PolynomialDesign::TermNames() const {
  const std::vector<std::string> inputs = InputNames();
  std::vector<std::string> names;
  for (const TermPowers& term : terms_) names.push_back(TermName(term, inputs));
  return names;
}

std::string PolynomialDesign::NameOf(Index term) const {
  return TermName(terms_[static_cast<std::size_t>(term)], InputNames());
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

fitting::ExtendedSystem PolynomialDesign::Exact() const {
  using stats::DoubleDouble;
  const auto decimal = [](double value) { return stats::DecimalOf(value); };
  const auto scaled = [&](Index k) -> fitting::ExtendedVector {
    fitting::ThrowIfInterrupted();
    const DoubleDouble offset = scaling_.offset[k];
    const DoubleDouble scale = scaling_.scale[k];
    return dataset_.input_values()
        .col(inputs_[static_cast<std::size_t>(k)])
        .unaryExpr([&](double value) -> DoubleDouble {
          return (stats::DecimalOf(value) - offset) * scale;
        });
  };
  fitting::ExtendedMatrix inputs(rows(), std::ssize(inputs_));
  for (Index k = 0; k < inputs.cols(); ++k) inputs.col(k) = scaled(k);
  fitting::ExtendedSystem system{
      fitting::ExtendedMatrix::Constant(rows(), num_terms() + 1, 1.0),
      dataset_.target_values().unaryExpr(decimal)};
  for (Index j = 0; j < num_terms(); ++j) {
    fitting::ThrowIfInterrupted();
    auto product = system.design.col(j + 1);
    const TermPowers& powers = terms_[static_cast<std::size_t>(j)];
    for (Index k = 0; k < inputs.cols(); ++k) {
      for (int power = powers[static_cast<std::size_t>(k)]; power > 0;
           --power) {
        product = product.cwiseProduct(inputs.col(k));
      }
    }
  }
  return system;
}

double PolynomialDesign::Noise(const VectorXd& combination) const {
  constexpr double kHalfUnit = 0.5 * std::numeric_limits<double>::epsilon();
  constexpr Index kBlockRows = 4096;
  double squares = 0.0;
  for (Index first = 0; first < rows(); first += kBlockRows) {
    fitting::ThrowIfInterrupted();
    const Index count = std::min(kBlockRows, rows() - first);
    const MatrixXd inputs =
        dataset_.input_values().middleRows(first, count)(Eigen::all, inputs_);
    const MatrixXd scaled = scaling_.Apply(inputs);
    VectorXd noise = VectorXd::Zero(count);
    for (std::size_t k = 0; k < inputs_.size(); ++k) {
      // The slope in input k times the rounding of that input.
      std::vector<TermPowers> slopes;
      std::vector<double> factors;
      for (std::size_t j = 0; j < terms_.size(); ++j) {
        const double factor = combination[static_cast<Index>(j) + 1];
        if (terms_[j][k] == 0 || factor == 0.0) continue;
        factors.push_back(factor * terms_[j][k]);
        slopes.push_back(terms_[j]);
        --slopes.back()[k];
      }
      const VectorXd slope =
          TermMatrix(scaled, slopes) *
          Eigen::Map<const VectorXd>(factors.data(), std::ssize(factors));
      const auto column = static_cast<Index>(k);
      noise += slope.cwiseAbs().cwiseProduct(
          inputs.col(column).cwiseAbs() * (kHalfUnit * scaling_.scale[column]));
    }
    if (dataset_.weights().size() != 0) {
      noise = noise.cwiseProduct(
          dataset_.weights().segment(first, count).cwiseSqrt());
    }
    squares += noise.squaredNorm();
  }
  return std::sqrt(squares);
}

bool NeedsTriangle(Index rows, Index terms, double most_values) {
  // A triangle of more columns than rows would save nothing.
  return static_cast<double>(rows) * static_cast<double>(terms) > most_values &&
         rows > 2 * (terms + 2);
}

FitContext PreferTriangle(const PolynomialDesign& design,
                          double most_values,
                          const FitContext& context) {
  // The triangle takes a time that grows with their square.
  constexpr Index kMostRotatedTerms = 64;
  FitContext preferring = context;
  if (design.num_terms() <= kMostRotatedTerms) {
    preferring.most_design_values =
        std::min(context.most_design_values, most_values);
  }
  return preferring;
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
  const std::vector<std::vector<Index>> members = stats::IndicesByCode(parts);
  const std::size_t triangles = std::max<std::size_t>(1, members.size());
  const Index stacked = static_cast<Index>(triangles) * columns;
  rows.terms.resize(stacked, terms);
  rows.response.resize(stacked);
  rows.intercept.resize(stacked);
  for (std::size_t part = 0; part < triangles; ++part) {
    const auto fill = [&](Index first, Eigen::Ref<MatrixXd> block) {
      fitting::ThrowIfInterrupted();
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
    const Index count =
        members.empty() ? design.rows() : std::ssize(members[part]);
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

DesignRows CollectRows(const PolynomialDesign& design,
                       const std::vector<Index>& parts,
                       const FitContext& context) {
  const auto collect = [&] {
    return CollectRows(
        design, parts, context.most_design_values, context.threads);
  };
  if (context.shared == nullptr || !parts.empty() ||
      !NeedsTriangle(
          design.rows(), design.num_terms(), context.most_design_values)) {
    return collect();
  }
  return *context.shared->Get<DesignRows>(KeyOf(design), [&] {
    return std::make_shared<const DesignRows>(collect());
  });
}

}  // namespace errmap::models
