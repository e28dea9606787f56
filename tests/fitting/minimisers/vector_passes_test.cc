#include "fitting/minimisers/vector_passes.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;

template <typename Scalar>
class VectorPasses : public ::testing::Test {
 protected:
  using Vector = VectorOf<Scalar>;

  // Every way to fill the lanes of a sum, or not.
  static constexpr Index kMost = 37;

  static Vector Random(Index size, std::uint64_t seed) {
    return testing::RandomMatrix(size, 1, seed).template cast<Scalar>();
  }

  static double Exact(const Vector& x, const Vector& y) {
    return x.template cast<double>().dot(y.template cast<double>());
  }

  // What the roundings of a sum of these products may come to.
  static double Bound(const Vector& x, const Vector& y) {
    return static_cast<double>(x.size() + 1) *
           static_cast<double>(std::numeric_limits<Scalar>::epsilon()) *
           x.template cast<double>().cwiseAbs().dot(
               y.template cast<double>().cwiseAbs());
  }
};

using Scalars = ::testing::Types<double, float>;
TYPED_TEST_SUITE(VectorPasses, Scalars);

TYPED_TEST(VectorPasses, SumsSquaresAndProducts) {
  for (Index size = 0; size <= this->kMost; ++size) {
    const auto x = this->Random(size, 1);
    const auto y = this->Random(size, 2);
    const auto sums = SquaresAndProduct(x, y);
    EXPECT_NEAR(sums.squares, this->Exact(x, x), this->Bound(x, x)) << size;
    EXPECT_NEAR(sums.product, this->Exact(x, y), this->Bound(x, y)) << size;
  }
}

}  // namespace
}  // namespace errmap::fitting
