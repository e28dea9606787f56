// Terms that follow from others: a sensor wired twice, in kelvin, the sum,
// difference or mean of two, a constant, few positions under a high degree.

#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/polynomial/polynomial_basis.h"
#include "models/recipe_catalog.h"
#include "models/regression_record.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using ::testing::HasSubstr;

// Of the target's range.
constexpr double kSame = 1e-9;

enum class Redundancy {
  kCopy,
  kKelvin,
  kFahrenheit,
  kSum,
  kDifference,
  kMean,
  kConstant
};

data::Dataset MakeData(const MatrixXd& inputs, const VectorXd& target) {
  data::Dataset::Parts parts;
  parts.source = "memory";
  for (Index j = 0; j < inputs.cols(); ++j) {
    parts.inputs.push_back({"x" + std::to_string(j), {}});
  }
  parts.input_values = inputs;
  parts.target = {"error", {}};
  parts.target_values = target;
  return data::Dataset(std::move(parts));
}

// As a file of so many decimals has it.
double Rounded(double value, double step) {
  return std::round(value / step) * step;
}

class RandomCase {
 public:
  explicit RandomCase(std::uint64_t seed) : random_(seed) {
    const Index inputs = 1 + Below(3);
    degree = static_cast<int>(1 + Below(inputs == 1 ? 6 : inputs == 2 ? 4 : 3));
    const Index redundant = 1 + Below(3);
    const Index rows = *CountTerms(inputs + redundant, degree) + 1 + Below(20);
    few_ = Below(3) == 0 ? 2 + Below(6) : 0;
    for (Index j = 0; j < inputs; ++j) {
      constexpr double kOffsets[] = {0.0, 20.0, -5.0, 300.0, 4000.0};
      constexpr double kScales[] = {0.2, 1.0, 15.0, 700.0};
      offsets_.push_back(kOffsets[Below(5)]);
      scales_.push_back(kScales[Below(4)]);
    }
    for (Index j = 0; j < redundant; ++j) {
      kinds_.push_back(static_cast<Redundancy>(Below(7)));
      first_.push_back(Below(inputs));
      second_.push_back(Below(inputs));
      // A sum of numbers of very unequal size hardly knows the smaller one,
      // and its cube not at all.
      const double ratio =
          scales_[At(first_.back())] / scales_[At(second_.back())];
      if (std::abs(std::log(ratio)) > std::log(20.0)) {
        second_.back() = first_.back();
      }
    }
    decimals_ = Below(2) == 0;
    base = Draw(rows, few_);
    fresh = Draw(rows, 0);
    target.resize(rows);
    for (Index i = 0; i < rows; ++i) {
      double value = 0.05 * Uniform();
      for (Index j = 0; j < inputs; ++j) {
        const double z = (base(i, j) - offsets_[At(j)]) / scales_[At(j)];
        value += std::sin(1.5 * z + static_cast<double>(j));
      }
      target[i] = value;
    }
    order_.resize(At(inputs + redundant));
    std::iota(order_.begin(), order_.end(), Index{0});
    // The redundant ones last, or anywhere; last with few positions, where the
    // order decides which powers stay and so what lies between positions.
    if (few_ == 0 && Below(2) == 0) {
      for (std::size_t i = order_.size(); i > 1; --i) {
        std::swap(order_[i - 1], order_[At(Below(static_cast<Index>(i)))]);
      }
    }
  }

  // With the redundant columns, in their order.
  MatrixXd All(const MatrixXd& inputs) const {
    MatrixXd all(inputs.rows(), static_cast<Index>(order_.size()));
    all.leftCols(inputs.cols()) = inputs;
    for (std::size_t j = 0; j < kinds_.size(); ++j) {
      const auto a = inputs.col(first_[j]).array();
      const auto b = inputs.col(second_[j]).array();
      auto column = all.col(inputs.cols() + static_cast<Index>(j)).array();
      switch (kinds_[j]) {
        case Redundancy::kCopy:
          column = a;
          break;
        case Redundancy::kKelvin:
          column = a + 273.15;
          break;
        case Redundancy::kFahrenheit:
          column = a * 1.8 + 32.0;
          break;
        case Redundancy::kSum:
          column = a + b;
          break;
        case Redundancy::kDifference:
          column = a - b;
          break;
        case Redundancy::kMean:
          column = 0.5 * (a + b);
          break;
        case Redundancy::kConstant:
          column = 22.5;
          break;
      }
    }
    return all(Eigen::all, order_);
  }

  // The columns without the redundant ones, in the same order.
  MatrixXd Without(const MatrixXd& inputs) const {
    std::vector<Index> kept;
    for (const Index column : order_) {
      if (column < inputs.cols()) kept.push_back(column);
    }
    return inputs(Eigen::all, kept);
  }

  int degree = 1;
  MatrixXd base;   // training
  MatrixXd fresh;  // new rows in range
  VectorXd target;

 private:
  static std::size_t At(Index i) { return static_cast<std::size_t>(i); }
  Index Below(Index bound) {
    return static_cast<Index>(random_.Below(static_cast<std::uint64_t>(bound)));
  }
  double Uniform() { return 2.0 * random_.Uniform() - 1.0; }

  MatrixXd Draw(Index rows, Index few) {
    constexpr double kStep = 1e-3;
    MatrixXd inputs(rows, static_cast<Index>(offsets_.size()));
    for (Index j = 0; j < inputs.cols(); ++j) {
      for (Index i = 0; i < rows; ++i) {
        double z = Uniform();
        if (j == 0 && few > 0) {
          z = 2.0 * static_cast<double>(Below(few)) /
                  static_cast<double>(few - 1) -
              1.0;
        }
        const double value = offsets_[At(j)] + scales_[At(j)] * z;
        inputs(i, j) = decimals_ ? Rounded(value, kStep) : value;
      }
    }
    return inputs;
  }

  stats::Random random_;
  std::vector<double> offsets_;
  std::vector<double> scales_;
  std::vector<Redundancy> kinds_;
  std::vector<Index> first_;
  std::vector<Index> second_;
  std::vector<Index> order_;
  Index few_ = 0;  // distinct values of the first input; 0: many
  bool decimals_ = false;
};

FittedModel FitFull(const MatrixXd& inputs,
                    const VectorXd& target,
                    int degree,
                    bool explain = false) {
  FitContext context;
  context.explain = explain;
  return MakeRecipe("poly:full:degree=" + std::to_string(degree))
      ->Fit(MakeData(inputs, target), context);
}

TEST(DependentTerms, ChangeNoPrediction) {
  constexpr std::uint64_t kCases = 1200;
  int wrong = 0;
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= kCases; ++seed) {
    const RandomCase data(seed);
    const FittedModel with =
        FitFull(data.All(data.base), data.target, data.degree);
    const FittedModel without =
        FitFull(data.Without(data.base), data.target, data.degree);
    const double range = data.target.maxCoeff() - data.target.minCoeff();
    for (const MatrixXd& rows : {data.base, data.fresh}) {
      const double off = (with.model->Predict(data.All(rows)) -
                          without.model->Predict(data.Without(rows)))
                             .cwiseAbs()
                             .maxCoeff() /
                         range;
      worst = std::max(worst, off);
      if (!(off <= kSame)) {
        ++wrong;
        ADD_FAILURE() << "case " << seed << ": off by " << off;
      }
    }
    EXPECT_EQ(with.model->num_parameters(), without.model->num_parameters())
        << "case " << seed;
  }
  EXPECT_EQ(wrong, 0);
  RecordProperty("worst", std::to_string(worst));
}

// The coefficient table is of the map that predicts.
TEST(DependentTerms, LeaveTableAndMapTheSame) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const RandomCase data(seed);
    const FittedModel fitted =
        FitFull(data.All(data.base), data.target, data.degree, true);
    const RegressionRecord& report = *fitted.regression;
    const LeastSquaresRecord& fit = *report.least_squares.value;
    const VectorXd residual =
        data.target - fitted.model->Predict(data.All(data.base));
    EXPECT_NEAR(fit.anova.residual_ss,
                residual.squaredNorm(),
                1e-9 * data.target.squaredNorm())
        << "case " << seed;
    EXPECT_EQ(fit.anova.regression_df + 1, fitted.model->num_parameters());
    EXPECT_EQ(report.coefficients.size() - fit.aliased.size(),
              static_cast<std::size_t>(fitted.model->num_parameters()));
    const auto form = std::get<PolynomialForm>(fitted.model->Describe());
    EXPECT_NEAR(report.coefficients.front().estimate,
                form.intercept,
                1e-9 * data.target.cwiseAbs().maxCoeff());
  }
}

MatrixXd TwoSensors() {
  stats::Random random(7);
  MatrixXd inputs(60, 3);
  for (Index i = 0; i < inputs.rows(); ++i) {
    inputs(i, 0) = Rounded(500.0 * random.Uniform(), 0.1);
    inputs(i, 1) = Rounded(20.0 + 0.4 * random.Uniform(), 0.01);
  }
  inputs.col(2) = inputs.col(1).array() + 273.15;
  return inputs;
}

TEST(DependentTerms, TheLaterCopyIsTheOneLeftOutAndIsNamed) {
  const MatrixXd inputs = TwoSensors();
  const VectorXd target = (0.01 * inputs.col(0).array()).sin() +
                          inputs.col(1).array().square() / 400.0;
  const FittedModel fitted = FitFull(inputs, target, 2, true);
  ASSERT_FALSE(fitted.remarks.empty());
  EXPECT_THAT(fitted.remarks[0],
              HasSubstr("4 of 9 terms follow from the others"));
  EXPECT_THAT(fitted.remarks[0], HasSubstr("x2, x0*x2, x1*x2, x2^2"));
  const auto& aliased = fitted.regression->least_squares.value->aliased;
  ASSERT_EQ(aliased.size(), 4U);
  EXPECT_EQ(aliased[0].term, "x2");
  EXPECT_EQ(aliased[0].why, "repeats x1");
  // The copy first: then the degrees Celsius repeat it.
  const MatrixXd turned = inputs(Eigen::all, std::vector<Index>{0, 2, 1});
  const FittedModel other = FitFull(turned, target, 2);
  EXPECT_THAT(other.remarks[0], HasSubstr("x2, x0*x2, x1*x2, x2^2"));
  const double range = target.maxCoeff() - target.minCoeff();
  EXPECT_LT((other.model->Predict(turned) - fitted.model->Predict(inputs))
                .cwiseAbs()
                .maxCoeff(),
            kSame * range);
}

// Rows that are too many to hold are reduced to a triangle first.
TEST(DependentTerms, ChangeNoPredictionByATriangle) {
  for (const double spread : {0.4, 0.01}) {
    stats::Random random(11);
    MatrixXd inputs(400, 3);
    VectorXd target(400);
    for (Index i = 0; i < inputs.rows(); ++i) {
      inputs(i, 0) = 500.0 * random.Uniform();
      inputs(i, 1) = 20.0 + spread * random.Uniform();
      inputs(i, 2) = inputs(i, 1) + 273.15;
      target[i] = std::sin(0.01 * inputs(i, 0)) +
                  inputs(i, 1) / spread * random.Uniform();
    }
    FitContext context;
    context.most_design_values = 100.0;
    const auto recipe = MakeRecipe("poly:full:degree=3");
    const FittedModel with = recipe->Fit(MakeData(inputs, target), context);
    const MatrixXd two = inputs.leftCols(2);
    const FittedModel without = recipe->Fit(MakeData(two, target), context);
    EXPECT_EQ(with.model->num_parameters(), without.model->num_parameters());
    EXPECT_LT((with.model->Predict(inputs) - without.model->Predict(two))
                  .cwiseAbs()
                  .maxCoeff(),
              kSame * (target.maxCoeff() - target.minCoeff()));
  }
}

TEST(DependentTerms, FivePositionsCarryFourPowers) {
  VectorXd position(40);
  for (Index i = 0; i < 40; ++i) {
    position[i] = 100.0 * static_cast<double>(i % 5);
  }
  const VectorXd target = (0.01 * position.array()).sin();
  const FittedModel four = FitFull(position, target, 4);
  const VectorXd between = VectorXd::LinSpaced(81, 0.0, 400.0);
  for (int degree = 5; degree <= 12; ++degree) {
    const FittedModel more = FitFull(position, target, degree);
    EXPECT_EQ(more.model->num_parameters(), 5) << degree;
    EXPECT_LT((more.model->Predict(between) - four.model->Predict(between))
                  .cwiseAbs()
                  .maxCoeff(),
              kSame);
  }
}

// What such a sum leaves was rounded where it was larger.
TEST(DependentTerms, ASumRoundedInStepsIsStillOne) {
  stats::Random random(5);
  MatrixXd inputs(140, 2);
  for (Index i = 0; i < inputs.rows(); ++i) {
    const double x = 24000.0 + 240.0 * (2.0 * random.Uniform() - 1.0);
    inputs(i, 0) = x;
    inputs(i, 1) = (1.2 * x + 0.3) - 1.145 * x;
  }
  const VectorXd target =
      (inputs.col(0).array() / 100.0).sin() + inputs.col(0).array() / 1000.0;
  const FittedModel fitted = FitFull(inputs, target, 1);
  EXPECT_EQ(fitted.model->num_parameters(), 2);
  EXPECT_LT((fitted.model->Predict(inputs) -
             FitFull(inputs.col(0), target, 1).model->Predict(inputs.col(0)))
                .cwiseAbs()
                .maxCoeff(),
            kSame);
}

// Powers about a far centre all but depend on each other; they are not copies,
// and R's rule in double would drop some of them.
TEST(DependentTerms, WhatOnly106BitsTellApartIsKept) {
  MatrixXd inputs(80, 1);
  stats::Random random(3);
  for (Index i = 0; i < 80; ++i) {
    inputs(i, 0) = Rounded(1000.0 + 10.0 * random.Uniform(), 1e-3);
  }
  const VectorXd z = (inputs.col(0).array() - 1005.0) / 5.0;
  const VectorXd target = z.array().cube() - 0.5 * z.array().square();
  const FittedModel fitted =
      MakeRecipe("poly:formula=x0+x0^2+x0^3+x0^4:centred=no")
          ->Fit(MakeData(inputs, target), {.explain = true});
  EXPECT_EQ(fitted.model->num_parameters(), 5);
  EXPECT_EQ(fitted.regression->least_squares.value->bits, 106);
  EXPECT_THAT(fitted.remarks,
              ::testing::Contains(HasSubstr("distinguished in 106 bits")));
  EXPECT_THAT(fitted.remarks,
              ::testing::Contains(HasSubstr("condition number")));
  // Raw powers of 1000 evaluated in double keep about this much.
  EXPECT_LT((fitted.model->Predict(inputs) - target).cwiseAbs().maxCoeff(),
            1e-4);
}

}  // namespace
}  // namespace errmap::models
