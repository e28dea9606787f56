#include "models/polynomial/polynomial_basis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"

namespace errmap::models {
namespace {

using ::testing::ElementsAre;

TEST(PolynomialBasis, ListsTermsByOrderWithEarlierInputsFirst) {
  EXPECT_THAT(AllTerms(2, 2),
              ElementsAre(TermPowers{1, 0},
                          TermPowers{0, 1},
                          TermPowers{2, 0},
                          TermPowers{1, 1},
                          TermPowers{0, 2}));
  EXPECT_TRUE(AllTerms(0, 3).empty());
}

TEST(PolynomialBasis, CountsTheTermsThatTheReportShrinksFrom) {
  // 41 inputs: 41 linear, 41 squares, 820 products.
  EXPECT_EQ(CountTerms(41, 2), 902);
  EXPECT_EQ(CountTerms(2, 6), 27);
  EXPECT_EQ(CountTerms(3, 4), static_cast<Eigen::Index>(AllTerms(3, 4).size()));
  EXPECT_EQ(CountTerms(1'000'000, 12), std::nullopt);
}

TEST(PolynomialBasis, NamesTermsAsASpecWritesThem) {
  const std::vector<std::string> names = {"position_mm", "t12_degC"};
  EXPECT_EQ(TermName({2, 1}, names), "position_mm^2*t12_degC");
  EXPECT_EQ(TermName({0, 1}, names), "t12_degC");
}

TEST(PolynomialBasis, EvaluatesProductsOfPowers) {
  Eigen::MatrixXd inputs(2, 2);
  inputs << 2.0, 3.0, -1.0, 0.5;
  const Eigen::MatrixXd matrix = TermMatrix(inputs, {{1, 0}, {2, 1}, {0, 3}});
  EXPECT_EQ(matrix(0, 0), 2.0);
  EXPECT_EQ(matrix(0, 1), 12.0);
  EXPECT_EQ(matrix(1, 1), 0.5);
  EXPECT_EQ(matrix(1, 2), 0.125);
}

TEST(PolynomialBasis, MultipliesScaledTermsOutToPhysicalUnits) {
  // 5 + 2 u v with u = (x - 10) / 4 and v = (y + 1) * 3:
  // 2 u v = 1.5 (x y + x - 10 y - 10).
  PolynomialForm form{Eigen::Vector2d(10.0, -1.0),
                      Eigen::Vector2d(0.25, 3.0),
                      5.0,
                      {{{1, 1}, 2.0}}};
  const auto terms = ExpandToPhysicalUnits(form);
  ASSERT_EQ(terms.size(), 4U);
  EXPECT_EQ(terms[0].powers, (TermPowers{0, 0}));
  EXPECT_DOUBLE_EQ(terms[0].coefficient, -10.0);
  EXPECT_DOUBLE_EQ(terms[1].coefficient, 1.5);    // x
  EXPECT_DOUBLE_EQ(terms[2].coefficient, -15.0);  // y
  EXPECT_DOUBLE_EQ(terms[3].coefficient, 1.5);    // x y
  const data::ColumnInfo target{"error_mm", data::UnitOfColumn("error_mm")};
  const std::vector<TrainedInput> inputs{{{"x", {}}, 6.0, 14.0, 10.0, 1.0},
                                         {{"y", {}}, -2.0, 0.0, -1.0, 1.0}};
  EXPECT_EQ(EquationText(form, target, inputs, 1.0),
            "error_mm = -1.00000000e+01 + 1.50000000e+00*x - "
            "1.50000000e+01*y + 1.50000000e+00*x*y");
  // The terms reach 10 + 21 + 30 + 42: half a unit of the 16th digit of that
  // is a millionth of this error.
  EXPECT_EQ(EquationText(form, target, inputs, 6e-8),
            "error_mm = -1.000000000000000e+01 + 1.500000000000000e+00*x - "
            "1.500000000000000e+01*y + 1.500000000000000e+00*x*y");
}

}  // namespace
}  // namespace errmap::models
