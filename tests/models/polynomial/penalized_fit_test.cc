// Ridge and lasso: the penalty that is chosen, and what weighs how much.

#include "models/polynomial/penalized_fit.h"

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/interruption.h"
#include "models/inner_folds.h"
#include "models/recipe_catalog.h"
#include "tests/decompositions.h"
#include "tests/models/history/history_data.h"
#include "tests/models/model_test_data.h"
#include "tests/random_matrix.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::QuadraticData;
using ::testing::SizeIs;

TEST(FitPenalty, SearchesOnWhereTheBasisIsPromising) {
  const data::Dataset dataset = QuadraticData(240);
  const FitContext context;
  const auto viewed = std::make_shared<const ViewedRows>(
      MakeViews(dataset, std::nullopt, 0.0).front());
  const InnerFolds folds = MakeInnerFolds(dataset, context);
  const SummedBasis basis(viewed, PenalizedBasis(), &folds);
  const auto search = [&](double promising, PenaltyRule rule = {}) {
    return FitPenalty(basis, fitting::Penalty::kRidge, rule, 0.0, promising)
        ->candidate;
  };
  const PenalizedCandidate coarse = search(0.0);
  const PenalizedCandidate close = search(coarse.held_out_rmse);
  EXPECT_THAT(coarse.strengths, SizeIs(3));
  EXPECT_THAT(close.strengths, SizeIs(10));
  EXPECT_LE(close.held_out_rmse, coarse.held_out_rmse);
  // One standard error is counted over every decade.
  EXPECT_GE(search(0.0, {.one_standard_error = true}).strengths.size(), 11U);
}

TEST(SummedBasis, ThrowsWhatAnInterruptionThrows) {
  const data::Dataset dataset = QuadraticData(24);
  const std::atomic<bool> stop{true};
  const auto viewed = std::make_shared<const ViewedRows>(
      MakeViews(dataset, std::nullopt, 0.0).front());
  const fitting::InterruptionScope interrupted(&stop);
  EXPECT_THROW(SummedBasis(viewed, PenalizedBasis(), nullptr),
               fitting::Interrupted);
}

// Five sessions of unlike length, each with an offset of its own.
data::Dataset SessionsWithOffsets(bool weighted, Index inputs) {
  const std::vector<Index> lengths = {7, 20, 3, 12, 28};
  std::vector<Index> codes;
  for (std::size_t session = 0; session < lengths.size(); ++session) {
    codes.insert(codes.end(),
                 static_cast<std::size_t>(lengths[session]),
                 static_cast<Index>(session));
  }
  const auto rows = static_cast<Index>(codes.size());
  std::vector<data::ColumnInfo> columns;
  for (Index j = 0; j < inputs; ++j) {
    columns.push_back(
        errmap::testing::ColumnNamed(fmt::format("t{}_degC", j + 1)));
  }
  const Eigen::MatrixXd levels = errmap::testing::RandomMatrix(5, inputs, 71);
  const Eigen::VectorXd offsets = errmap::testing::RandomVector(5, 72);
  const Eigen::VectorXd noise = errmap::testing::RandomVector(rows, 73);
  Eigen::MatrixXd values = errmap::testing::RandomMatrix(rows, inputs, 74);
  for (Index row = 0; row < rows; ++row) {
    values.row(row) += levels.row(codes[static_cast<std::size_t>(row)]);
  }
  const data::Dataset all = errmap::testing::WithLog(
      columns, values, Eigen::VectorXd::LinSpaced(rows, 0.0, 60.0), codes);
  Eigen::VectorXd targets = values.rowwise().sum() + 0.1 * noise;
  for (Index row = 0; row < rows; ++row) {
    targets[row] += offsets[codes[static_cast<std::size_t>(row)]];
  }
  Eigen::VectorXd weights;
  if (weighted) {
    weights = 1.5 + errmap::testing::RandomVector(rows, 75).array();
  }
  return errmap::testing::WithTargets(all, targets, weights);
}

// Minimises the penalised squares within sessions and `between` times those of
// their means: (1 + p) intercept and slopes.
Eigen::VectorXd WithinAndBetween(const data::Dataset& dataset,
                                 double between,
                                 double strength) {
  const std::vector<Index> codes = dataset.session_codes();
  const Index rows = dataset.num_rows();
  const Index p = dataset.num_inputs();
  Eigen::VectorXd weights = dataset.weights();
  if (weights.size() == 0) weights.setOnes(rows);
  Eigen::MatrixXd values(rows, p + 2);  // 1, inputs, target
  values << Eigen::VectorXd::Ones(rows), dataset.input_values(),
      dataset.target_values();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(p + 2, p + 2);
  for (Index session = 0; session < 5; ++session) {
    double of_session = 0.0;
    Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(p + 2);
    for (Index row = 0; row < rows; ++row) {
      if (codes[static_cast<std::size_t>(row)] != session) continue;
      of_session += weights[row];
      mean += weights[row] * values.row(row);
    }
    if (of_session == 0.0) continue;
    mean /= of_session;
    products += between * of_session * mean.transpose() * mean;
    for (Index row = 0; row < rows; ++row) {
      if (codes[static_cast<std::size_t>(row)] != session) continue;
      const Eigen::RowVectorXd less = values.row(row) - mean;
      products += weights[row] * less.transpose() * less;
    }
  }
  Eigen::MatrixXd normal = products.topLeftCorner(p + 1, p + 1);
  for (Index j = 1; j <= p; ++j) {
    const double variance =
        products(j, j) - products(0, j) * products(0, j) / products(0, 0);
    normal(j, j) += strength * variance;
  }
  return testing::SolveSymmetric(normal, products.col(p + 1).head(p + 1));
}

TEST(FitPenalty, WeighsWhatDiffersBetweenSessions) {
  for (const bool weighted : {false, true}) {
    // The latter are more than rows.
    for (const Index inputs : {3, 80}) {
      const data::Dataset dataset = SessionsWithOffsets(weighted, inputs);
      const FitContext context{.inner_holdout = InnerHoldout::kWholeSessions};
      const InnerFolds folds = MakeInnerFolds(dataset, context);
      const auto viewed = std::make_shared<const ViewedRows>(
          MakeViews(dataset, std::nullopt, 0.0).front());
      for (const double between : {0.0001, 0.25, 1.0}) {
        PenalizedBasis basis;
        basis.between = between;
        for (const double strength : {1e-3, 0.1}) {
          const auto fit = FitPenalty({viewed, basis, &folds},
                                      fitting::Penalty::kRidge,
                                      {.strength = strength},
                                      0.0,
                                      0.0);
          const FittedModel map = MapOfCandidate("map",
                                                 dataset,
                                                 *viewed,
                                                 fit->DesignOf(*viewed),
                                                 fit->candidate,
                                                 false);
          const Eigen::VectorXd expected =
              WithinAndBetween(dataset, between, strength);
          const Eigen::VectorXd predicted =
              (dataset.input_values() * expected.tail(inputs)).array() +
              expected[0];
          EXPECT_LT((map.Predict(dataset) - predicted).cwiseAbs().maxCoeff(),
                    1e-9)
              << inputs << " inputs, between " << between << ", strength "
              << strength;
        }
      }
    }
  }
}

// In a view a quarter; rows as they are measured count as anywhere else.
TEST(PenalizedRecipe, WeighsSessionsInViewsAlone) {
  const data::Dataset dataset = SessionsWithOffsets(false, 3);
  const FitContext context{.inner_holdout = InnerHoldout::kWholeSessions};
  const auto slopes = [&](const std::string& spec) {
    const FittedModel map = MakeRecipe(spec)->Fit(dataset, context);
    return map.Predict(dataset).eval();
  };
  const std::string raw = "poly:ridge:terms=linear:penalty=0.01";
  EXPECT_EQ(slopes(raw), slopes(raw + ":between=1"));
  EXPECT_EQ(slopes(raw + ":view=raw"), slopes(raw + ":view=raw:between=0.25"));
  EXPECT_GT((slopes(raw + ":view=raw") - slopes(raw)).cwiseAbs().maxCoeff(),
            0.01);
  EXPECT_THROW(MakeRecipe("blend:between=0"), std::invalid_argument);
}

// Five inputs whose product of the last two is the error.
std::string TermsChosen(const std::string& first_input) {
  constexpr Index kRows = 100;
  const Eigen::MatrixXd values = testing::RandomMatrix(kRows, 5, 7);
  std::vector<data::ColumnInfo> inputs = {testing::ColumnNamed(first_input)};
  for (const char* name : {"a_degC", "b_degC", "c_degC", "d_degC"}) {
    inputs.push_back(testing::ColumnNamed(name));
  }
  std::vector<Index> codes;
  for (Index row = 0; row < kRows; ++row) codes.push_back(row / 20);
  const data::Dataset made = testing::WithLog(
      inputs, values, Eigen::VectorXd::LinSpaced(kRows, 0.0, 99.0), codes);
  const Eigen::VectorXd errors = values.col(3).cwiseProduct(values.col(4));
  const FittedModel map = MakeRecipe("poly:ridge:view=raw")
                              ->Fit(testing::WithTargets(made, errors), {});
  for (const auto& choice : map.choices) {
    if (choice.key == "terms") return std::get<std::string>(choice.value);
  }
  return "";
}

TEST(PenalizedRecipe, TriesProductsOfTemperaturesWhereThereIsNoPosition) {
  EXPECT_EQ(TermsChosen("e_degC"), "full");
  EXPECT_NE(TermsChosen("position_mm"), "full");
}

}  // namespace
}  // namespace errmap::models
