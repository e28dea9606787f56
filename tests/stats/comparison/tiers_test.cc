#include "stats/comparison/tiers.h"

#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/numbers.h"

namespace errmap::stats {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

// Bounds as if every difference were known to +- `error`.
MatrixXd Bounds(const VectorXd& rmse, double error) {
  MatrixXd bounds(rmse.size(), rmse.size());
  for (Eigen::Index i = 0; i < rmse.size(); ++i) {
    for (Eigen::Index j = 0; j < rmse.size(); ++j) {
      bounds(i, j) = rmse[i] - rmse[j] + (i == j ? 0.0 : error);
    }
  }
  return bounds;
}

TEST(FormTiers, AdmitsWhatIsSurelyWithinTheMarginOfTheBest) {
  const VectorXd rmse{{2.00, 1.00, 1.02, 2.05, 5.0}};
  EXPECT_THAT(
      FormTiers(rmse, Bounds(rmse, 0.02), {.share = 0.05}),
      ElementsAre(ElementsAre(1, 2), ElementsAre(0, 3), ElementsAre(4)));
}

TEST(FormTiers, DoesNotAdmitForLackOfSignificance) {
  // The difference may be 0 (error 0.5), but may also be half the RMSE.
  const VectorXd rmse{{1.00, 1.001}};
  EXPECT_THAT(FormTiers(rmse, Bounds(rmse, 0.5), {.share = 0.05}),
              ElementsAre(ElementsAre(0), ElementsAre(1)));
}

TEST(FormTiers, TakesTheLargerOfShareAndIndifference) {
  const VectorXd rmse{{0.10, 0.115, 0.14}};
  const MatrixXd bounds = Bounds(rmse, 0.004);
  EXPECT_THAT(FormTiers(rmse, bounds, {.share = 0.05, .indifference = 0.02}),
              ElementsAre(ElementsAre(0, 1), ElementsAre(2)));
  EXPECT_THAT(FormTiers(rmse, bounds, {.share = 0.05}),
              ElementsAre(ElementsAre(0), ElementsAre(1), ElementsAre(2)));
}

// 1.04 is within 5 % of 1.00 and 1.08 of 1.04, but not of the best.
TEST(FormTiers, MeasuresFromTheBestAndNotFromTheNeighbour) {
  const VectorXd rmse{{1.08, 1.00, 1.04}};
  EXPECT_THAT(FormTiers(rmse, Bounds(rmse, 0.0), {.share = 0.05}),
              ElementsAre(ElementsAre(1, 2), ElementsAre(0)));
}

TEST(FormTiers, WithoutBoundsOnlyEqualModelsShareATier) {
  const VectorXd rmse{{1.0, 1.0 + 1e-15, 1.001, 1.0}};
  EXPECT_THAT(FormTiers(rmse, MatrixXd::Constant(4, 4, kNaN), {.share = 0.5}),
              ElementsAre(ElementsAre(0, 3, 1), ElementsAre(2)));
}

TEST(FormTiers, OfOneModelAndOfNone) {
  EXPECT_THAT(FormTiers(VectorXd{{0.0}}, MatrixXd::Zero(1, 1), {}),
              ElementsAre(ElementsAre(0)));
  EXPECT_THAT(FormTiers(VectorXd(), MatrixXd(), {}), IsEmpty());
}

TEST(FormTiers, RefusesOtherShapesAndValuesThatAreNotFinite) {
  EXPECT_THAT([] { FormTiers(VectorXd::Ones(2), MatrixXd::Zero(2, 3), {}); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("bounds of 2 x 3 models for 2 RMSE")));
  EXPECT_THAT(
      [] {
        FormTiers(VectorXd{{1.0, kNaN}}, MatrixXd::Zero(2, 2), {});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("not finite")));
}

TEST(Margin, IsCheckedFieldByField) {
  EXPECT_NO_THROW(Margin().Validate());
  EXPECT_THAT([] { Margin{.share = -0.1}.Validate(); },
              ThrowsMessage<std::invalid_argument>(HasSubstr(
                  "share must be finite and at least 0, found -0.1")));
  EXPECT_THAT([] { Margin{.indifference = kNaN}.Validate(); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("indifference")));
}

}  // namespace
}  // namespace errmap::stats
