#include "models/net/net_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "models/net/aligned_matrix.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

using Exact = long double;

Exact ExactLogistic(Exact s) { return 1.0L / (1.0L + std::exp(-s)); }

// Plain and fast versions, so that each is held against the exact figures.
template <typename Scalar>
std::vector<NetKernels<Scalar>> AllKernels() {
  std::vector<NetKernels<Scalar>> all = {PlainNetKernels<Scalar>()};
  for (const auto& kernels : AvailableNetKernels<Scalar>()) {
    all.push_back(kernels);
  }
  return all;
}

template <typename Scalar>
class NetKernelsIn : public ::testing::Test {
 protected:
  static constexpr Scalar kEpsilon = std::numeric_limits<Scalar>::epsilon();
  static constexpr Scalar kInfinity = std::numeric_limits<Scalar>::infinity();
  static constexpr Scalar kNaN = std::numeric_limits<Scalar>::quiet_NaN();
  static constexpr Scalar kNothing = std::numeric_limits<Scalar>::min();
};

using Scalars = ::testing::Types<double, float>;
TYPED_TEST_SUITE(NetKernelsIn, Scalars);

TYPED_TEST(NetKernelsIn, HaveABaselineAndTheFastestLast) {
  const auto available = AvailableNetKernels<TypeParam>();
  ASSERT_FALSE(available.empty());
  EXPECT_EQ(available.front().name, "baseline");
  EXPECT_EQ(FastestNetKernels<TypeParam>().name, available.back().name);
  EXPECT_EQ(PlainNetKernels<TypeParam>().name, "plain");
}

TYPED_TEST(NetKernelsIn, LogisticIsAsExactAsStated) {
  using Scalar = TypeParam;
  // Down to where the result is still a normal number.
  const auto most = static_cast<Scalar>(
      -std::log(static_cast<Exact>(std::numeric_limits<Scalar>::min())) - 1.0L);
  constexpr int kPoints = 200'001;
  std::vector<Scalar> s;
  for (int i = 0; i < kPoints; ++i) {
    s.push_back(most * (Scalar(2) * static_cast<Scalar>(i) / (kPoints - 1) -
                        Scalar(1)));
  }
  stats::Random random(1);
  for (int i = 0; i < kPoints; ++i) {  // most arguments of a net
    s.push_back(static_cast<Scalar>(12.0 * random.Uniform() - 6.0));
  }
  for (int exponent = -40; exponent < 0; ++exponent) {
    s.push_back(std::ldexp(Scalar(1), exponent));
    s.push_back(-std::ldexp(Scalar(1), exponent));
  }
  std::vector<Scalar> y(s.size());
  for (const auto& kernels : AllKernels<Scalar>()) {
    SCOPED_TRACE(std::string(kernels.name));
    kernels.logistic(static_cast<std::ptrdiff_t>(s.size()), s.data(), y.data());
    Exact worst = 0.0L;  // in units of what is stated
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Exact exact = ExactLogistic(s[i]);
      const Exact stated =
          4.0L * this->kEpsilon * (1.0L + std::abs(static_cast<Exact>(s[i])));
      worst = std::max(worst, std::abs(y[i] - exact) / (exact * stated));
    }
    EXPECT_LT(worst, 1.0L);
  }
}

TYPED_TEST(NetKernelsIn, LogisticIsSafeAtAnyArgument) {
  using Scalar = TypeParam;
  const Scalar most = std::numeric_limits<Scalar>::max();
  const Scalar least = std::numeric_limits<Scalar>::denorm_min();
  for (const auto& kernels : AllKernels<Scalar>()) {
    SCOPED_TRACE(std::string(kernels.name));
    const auto logistic = [&](Scalar s) {
      Scalar y = 0;
      kernels.logistic(1, &s, &y);
      return y;
    };
    EXPECT_EQ(logistic(Scalar(0)), Scalar(0.5));
    EXPECT_EQ(logistic(-Scalar(0)), Scalar(0.5));
    EXPECT_EQ(logistic(least), Scalar(0.5));
    EXPECT_EQ(logistic(-least), Scalar(0.5));
    EXPECT_EQ(logistic(most), Scalar(1));
    EXPECT_EQ(logistic(this->kInfinity), Scalar(1));
    EXPECT_EQ(logistic(Scalar(1000)), Scalar(1));
    // 0 but for numbers that are not normal any more.
    for (const Scalar s : {Scalar(-1000), -most, -this->kInfinity}) {
      EXPECT_GE(logistic(s), Scalar(0)) << s;
      EXPECT_LT(logistic(s), this->kNothing) << s;
    }
    EXPECT_TRUE(std::isnan(logistic(this->kNaN)));
    EXPECT_TRUE(std::isnan(logistic(-this->kNaN)));
  }
}

TYPED_TEST(NetKernelsIn, LogisticNeverFallsAndStaysWithinItsLimits) {
  using Scalar = TypeParam;
  constexpr int kPoints = 100'001;
  std::vector<Scalar> s(kPoints);
  std::vector<Scalar> y(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    s[static_cast<std::size_t>(i)] =
        static_cast<Scalar>(-800.0 + 1600.0 * i / (kPoints - 1));
  }
  for (const auto& kernels : AllKernels<Scalar>()) {
    SCOPED_TRACE(std::string(kernels.name));
    kernels.logistic(kPoints, s.data(), y.data());
    EXPECT_TRUE(std::ranges::is_sorted(y));
    EXPECT_GE(y.front(), Scalar(0));
    EXPECT_LE(y.back(), Scalar(1));
  }
}

// A number's result depends neither on its place nor on those around it, and
// nothing is written beyond the last.
TYPED_TEST(NetKernelsIn, LogisticTakesAnyNumberOfNumbersAndPlace) {
  using Scalar = TypeParam;
  constexpr Scalar kMark = -7;
  stats::Random random(2);
  std::vector<Scalar> s(150);
  for (Scalar& value : s) {
    value = static_cast<Scalar>(20.0 * random.Uniform() - 10.0);
  }
  for (const auto& kernels : AllKernels<Scalar>()) {
    SCOPED_TRACE(std::string(kernels.name));
    std::vector<Scalar> all(s.size());
    kernels.logistic(
        static_cast<std::ptrdiff_t>(s.size()), s.data(), all.data());
    for (std::size_t n = 0; n <= 140; ++n) {
      for (const std::size_t from : {0U, 1U, 5U}) {
        std::vector<Scalar> y(n + 1, kMark);
        kernels.logistic(
            static_cast<std::ptrdiff_t>(n), s.data() + from, y.data());
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(from);
        EXPECT_TRUE(std::equal(y.begin(), y.end() - 1, begin))
            << n << " from " << from;
        EXPECT_EQ(y[n], kMark) << n;
      }
    }
    std::vector<Scalar> in_place = s;
    kernels.logistic(static_cast<std::ptrdiff_t>(in_place.size()),
                     in_place.data(),
                     in_place.data());
    EXPECT_EQ(in_place, all);
  }
}

// A block of random figures as the net makes them, with exact results.
template <typename Scalar>
struct Block {
  Block(BlockSize of, std::uint64_t seed) : size(of), random(seed) {
    const auto hidden = static_cast<std::size_t>(size.height * size.columns);
    const auto second = static_cast<std::size_t>(size.height * size.outputs);
    const auto outputs = static_cast<std::size_t>(size.outputs * size.columns);
    s = Draw(hidden, 4.0);
    t = Draw(hidden, 2.0);
    w2 = Draw(second, 1.0);
    p2 = Draw(second, 1.0);
    d_output = Draw(outputs, 0.1);
    d_w2 = Draw(second, 1.0);
    // The last node may be padding.
    for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
      w2[At(size.height - 1, j)] = p2[At(size.height - 1, j)] = 0;
    }
  }

  std::vector<Scalar> Draw(std::size_t n, double size_of_each) {
    std::vector<Scalar> values(n);
    for (Scalar& value : values) {
      value =
          static_cast<Scalar>(size_of_each * (2.0 * random.Uniform() - 1.0));
    }
    return values;
  }
  std::size_t At(std::ptrdiff_t h, std::ptrdiff_t column) const {
    return static_cast<std::size_t>(column * size.height + h);
  }
  std::size_t OutputAt(std::ptrdiff_t j, std::ptrdiff_t column) const {
    return static_cast<std::size_t>(column * size.outputs + j);
  }

  BlockSize size;
  stats::Random random;
  std::vector<Scalar> s, t, w2, p2, d_output, d_w2;
};

template <typename Scalar>
std::vector<BlockSize> BlockSizes() {
  std::vector<BlockSize> sizes;
  constexpr std::ptrdiff_t kStep = PaddedHeight<Scalar>(1);
  for (std::ptrdiff_t height = kStep; height <= 72; height += kStep) {
    for (const std::ptrdiff_t columns : {1, 2, 3, 7, 16, 31, 50}) {
      for (std::ptrdiff_t outputs = 1; outputs <= 3; ++outputs) {
        sizes.push_back({height, columns, outputs});
      }
    }
  }
  // One pattern by itself is taller than what is worked on together.
  sizes.push_back({1040, 3, 2});
  return sizes;
}

// Sums of `terms` numbers of about `size` in any order, each good to some
// roundings.
template <typename Scalar>
double Roundings(std::ptrdiff_t terms, double size) {
  return 8.0 * static_cast<double>(terms) * size *
         static_cast<double>(std::numeric_limits<Scalar>::epsilon());
}

TYPED_TEST(NetKernelsIn, ProductsAreTheFormulasAndTheLatterAdds) {
  using Scalar = TypeParam;
  for (const BlockSize size : BlockSizes<Scalar>()) {
    if (size.outputs > 1) continue;  // they have no part
    for (const std::ptrdiff_t inner : {1, 5, 12, 38}) {
      Block<Scalar> block(size, 8);
      const auto count = [](std::ptrdiff_t rows, std::ptrdiff_t columns) {
        return static_cast<std::size_t>(rows * columns);
      };
      const auto w1 = block.Draw(count(size.height, inner), 1.0);
      const auto x = block.Draw(count(inner, size.columns), 1.0);
      const auto before = block.Draw(count(size.height, inner), 1.0);
      const auto x_at = [&](std::ptrdiff_t i, std::ptrdiff_t column) {
        return Exact(x[static_cast<std::size_t>(column * inner + i)]);
      };
      for (const auto& kernels : AllKernels<Scalar>()) {
        SCOPED_TRACE(::testing::Message()
                     << kernels.name << " " << size.height << " x " << inner
                     << " x " << size.columns);
        std::vector<Scalar> s(block.s.size());
        kernels.activate(size, inner, w1.data(), x.data(), s.data());
        std::vector<Scalar> d_w1 = before;
        kernels.add_products(
            size, inner, block.s.data(), x.data(), false, d_w1.data());
        std::vector<Scalar> added(before.size());
        kernels.add_products(
            size, inner, block.s.data(), x.data(), false, added.data());
        std::vector<Scalar> anew = before;
        kernels.add_products(
            size, inner, block.s.data(), x.data(), true, anew.data());
        EXPECT_EQ(anew, added);
        double worst_s = 0.0;
        double worst_sum = 0.0;
        for (std::ptrdiff_t h = 0; h < size.height; ++h) {
          for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
            Exact sum = 0.0L;
            for (std::ptrdiff_t i = 0; i < inner; ++i) {
              sum += w1[block.At(h, i)] * x_at(i, column);
            }
            worst_s = std::max(
                worst_s,
                static_cast<double>(std::abs(s[block.At(h, column)] - sum)));
          }
          for (std::ptrdiff_t i = 0; i < inner; ++i) {
            Exact sum = before[block.At(h, i)];
            for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
              sum += block.s[block.At(h, column)] * x_at(i, column);
            }
            worst_sum = std::max(
                worst_sum,
                static_cast<double>(std::abs(d_w1[block.At(h, i)] - sum)));
          }
        }
        EXPECT_LE(worst_s, Roundings<Scalar>(inner, 1.0));
        EXPECT_LE(worst_sum, Roundings<Scalar>(size.columns + 1, 4.0));
      }
    }
  }
}

TYPED_TEST(NetKernelsIn, ForwardIsTheFormula) {
  using Scalar = TypeParam;
  for (const BlockSize size : BlockSizes<Scalar>()) {
    Block<Scalar> block(size, 3);
    const auto a = static_cast<Scalar>(0.37);
    const double bound = Roundings<Scalar>(size.height, 1.0);
    for (const auto& kernels : AllKernels<Scalar>()) {
      SCOPED_TRACE(::testing::Message()
                   << kernels.name << " " << size.height << " x "
                   << size.columns << " x " << size.outputs);
      std::vector<Scalar> y(block.s.size());
      std::vector<Scalar> o(block.d_output.size());
      const auto expect = [&](Exact step) {
        double worst_y = 0.0;
        double worst_o = 0.0;
        for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
          for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
            Exact sum = 0.0L;
            for (std::ptrdiff_t h = 0; h < size.height; ++h) {
              const std::size_t i = block.At(h, column);
              const Exact exact = ExactLogistic(block.s[i] + step * block.t[i]);
              sum += block.w2[block.At(h, j)] * exact;
              worst_y = std::max(worst_y,
                                 static_cast<double>(std::abs(y[i] - exact)));
            }
            worst_o = std::max(worst_o,
                               static_cast<double>(std::abs(
                                   o[block.OutputAt(j, column)] - sum)));
          }
        }
        EXPECT_LE(worst_y, Roundings<Scalar>(1, 1.0));
        EXPECT_LE(worst_o, bound);
      };
      kernels.forward(
          size, block.s.data(), block.w2.data(), y.data(), o.data());
      expect(0.0L);
      const std::vector<Scalar> y_apart = y;
      std::vector<Scalar> in_place = block.s;
      kernels.forward(
          size, in_place.data(), block.w2.data(), in_place.data(), o.data());
      EXPECT_EQ(in_place, y_apart);
      kernels.forward_along(size,
                            block.s.data(),
                            block.t.data(),
                            a,
                            block.w2.data(),
                            y.data(),
                            o.data());
      expect(a);
      std::vector<Scalar> s_new = block.s;
      kernels.advance(size, block.t.data(), a, s_new.data());
      for (std::size_t i = 0; i < s_new.size(); ++i) {
        ASSERT_NEAR(
            s_new[i], block.s[i] + a * block.t[i], Roundings<Scalar>(1, 1.0));
      }
      std::vector<Scalar> y_there(y.size());
      std::vector<Scalar> o_there(o.size());
      kernels.forward(
          size, s_new.data(), block.w2.data(), y_there.data(), o_there.data());
      EXPECT_EQ(y, y_there);
      EXPECT_EQ(o, o_there);
    }
  }
}

// Sums over patterns go on where those of the strip before have ended. The
// plain products are Eigen's, which takes its own order.
TYPED_TEST(NetKernelsIn, StripsGiveTheBitsOfTheWholeBlock) {
  using Scalar = TypeParam;
  constexpr std::ptrdiff_t kInner = 38;
  constexpr std::ptrdiff_t kColumns = 50;
  constexpr std::ptrdiff_t kStrip = 12;
  for (std::ptrdiff_t height = PaddedHeight<Scalar>(1); height <= 72;
       height += PaddedHeight<Scalar>(1)) {
    const BlockSize whole{height, kColumns, 2};
    Block<Scalar> block(whole, 9);
    const auto x = block.Draw(static_cast<std::size_t>(kInner * kColumns), 1.0);
    const auto y = block.Draw(block.s.size(), 1.0);
    for (const auto& kernels : AvailableNetKernels<Scalar>()) {
      const auto sums = [&](std::ptrdiff_t strip) {
        std::vector<Scalar> d_w1(static_cast<std::size_t>(height * kInner));
        std::vector<Scalar> d_w2 = block.d_w2;
        std::vector<Scalar> delta(block.s.size());
        for (std::ptrdiff_t begin = 0; begin < kColumns; begin += strip) {
          const BlockSize size{
              height, std::min(strip, kColumns - begin), whole.outputs};
          kernels.backward(size,
                           y.data() + begin * height,
                           block.w2.data(),
                           block.d_output.data() + begin * whole.outputs,
                           delta.data(),
                           d_w2.data());
          kernels.add_products(size,
                               kInner,
                               delta.data(),
                               x.data() + begin * kInner,
                               begin == 0,
                               d_w1.data());
        }
        return std::pair(d_w1, d_w2);
      };
      EXPECT_EQ(sums(kStrip), sums(kColumns)) << kernels.name << " " << height;
    }
  }
}

TYPED_TEST(NetKernelsIn, BendIsTheFirstAndSecondDerivative) {
  using Scalar = TypeParam;
  for (const BlockSize size : BlockSizes<Scalar>()) {
    Block<Scalar> block(size, 4);
    std::vector<Scalar> y(block.s.size());
    PlainNetKernels<Scalar>().logistic(
        static_cast<std::ptrdiff_t>(y.size()), block.s.data(), y.data());
    const double bound = Roundings<Scalar>(size.height, 2.0);
    for (const auto& kernels : AllKernels<Scalar>()) {
      SCOPED_TRACE(::testing::Message()
                   << kernels.name << " " << size.height << " x "
                   << size.columns << " x " << size.outputs);
      std::vector<Scalar> first(block.d_output.size());
      std::vector<Scalar> second(block.d_output.size());
      kernels.bend_along(size,
                         y.data(),
                         block.t.data(),
                         block.w2.data(),
                         block.p2.data(),
                         first.data(),
                         second.data());
      double worst = 0.0;
      for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
        for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
          // o(a) = (w + a p) f(s + a t): o' = p f + w f' t, o'' = 2 p f' t +
          // w f'' t^2, with f' = f (1-f) and f'' = f' (1-2f).
          Exact sum1 = 0.0L;
          Exact sum2 = 0.0L;
          for (std::ptrdiff_t h = 0; h < size.height; ++h) {
            const Exact f = y[block.At(h, column)];
            const Exact t = block.t[block.At(h, column)];
            const Exact w = block.w2[block.At(h, j)];
            const Exact p = block.p2[block.At(h, j)];
            const Exact slope = f * (1.0L - f);
            sum1 += p * f + w * slope * t;
            sum2 +=
                2.0L * p * slope * t + w * slope * (1.0L - 2.0L * f) * t * t;
          }
          const std::size_t i = block.OutputAt(j, column);
          worst = std::max({worst,
                            static_cast<double>(std::abs(first[i] - sum1)),
                            static_cast<double>(std::abs(second[i] - sum2))});
        }
      }
      EXPECT_LE(worst, bound);
    }
  }
}

TYPED_TEST(NetKernelsIn, BackwardIsTheFormulaAndAdds) {
  using Scalar = TypeParam;
  for (const BlockSize size : BlockSizes<Scalar>()) {
    Block<Scalar> block(size, 5);
    std::vector<Scalar> y(block.s.size());
    PlainNetKernels<Scalar>().logistic(
        static_cast<std::ptrdiff_t>(y.size()), block.s.data(), y.data());
    for (const auto& kernels : AllKernels<Scalar>()) {
      SCOPED_TRACE(::testing::Message()
                   << kernels.name << " " << size.height << " x "
                   << size.columns << " x " << size.outputs);
      std::vector<Scalar> delta(block.s.size());
      std::vector<Scalar> d_w2 = block.d_w2;
      kernels.backward(size,
                       y.data(),
                       block.w2.data(),
                       block.d_output.data(),
                       delta.data(),
                       d_w2.data());
      std::vector<Exact> sum(block.d_w2.begin(), block.d_w2.end());
      double worst_delta = 0.0;
      for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
        for (std::ptrdiff_t h = 0; h < size.height; ++h) {
          const Exact f = y[block.At(h, column)];
          Exact back = 0.0L;
          for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
            const Exact d = block.d_output[block.OutputAt(j, column)];
            back += block.w2[block.At(h, j)] * d;
            sum[block.At(h, j)] += f * d;
          }
          worst_delta =
              std::max(worst_delta,
                       static_cast<double>(std::abs(delta[block.At(h, column)] -
                                                    back * f * (1.0L - f))));
        }
      }
      double worst_sum = 0.0;
      for (std::size_t i = 0; i < sum.size(); ++i) {
        worst_sum = std::max(worst_sum,
                             static_cast<double>(std::abs(d_w2[i] - sum[i])));
      }
      EXPECT_LE(worst_delta, Roundings<Scalar>(size.outputs, 0.1));
      EXPECT_LE(worst_sum, Roundings<Scalar>(size.columns + 10, 0.1));
    }
  }
}

// Padding must not leak: a node whose outgoing weights are 0 changes nothing.
TYPED_TEST(NetKernelsIn, NodesOfNoWeightHaveNoPart) {
  using Scalar = TypeParam;
  const std::ptrdiff_t height = 2 * PaddedHeight<Scalar>(1);
  const BlockSize size{height, 9, 2};
  Block<Scalar> block(size, 6);
  Block<Scalar> other = block;
  for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
    other.s[other.At(height - 1, column)] += Scalar(3);
  }
  for (const auto& kernels : AllKernels<Scalar>()) {
    std::vector<Scalar> y(block.s.size());
    std::vector<Scalar> o(block.d_output.size());
    std::vector<Scalar> o_other(block.d_output.size());
    kernels.forward(size, block.s.data(), block.w2.data(), y.data(), o.data());
    kernels.forward(
        size, other.s.data(), block.w2.data(), y.data(), o_other.data());
    EXPECT_EQ(o, o_other) << kernels.name;
  }
}

TEST(PaddedHeight, IsTheNextHalfOfTheWidestVector) {
  EXPECT_EQ(PaddedHeight<double>(1), 4);
  EXPECT_EQ(PaddedHeight<double>(8), 8);
  EXPECT_EQ(PaddedHeight<double>(9), 12);
  EXPECT_EQ(PaddedHeight<float>(1), 8);
  EXPECT_EQ(PaddedHeight<float>(60), 64);
}

template <typename Scalar>
void ExpectAlignedZeros(Eigen::Index rows, Eigen::Index cols) {
  AlignedMatrix<Scalar> matrix(rows, cols);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(matrix.data()) % kVectorBytes, 0U);
  EXPECT_EQ(matrix.rows(), rows);
  EXPECT_EQ(matrix.cols(), cols);
  EXPECT_TRUE(matrix.all().isZero(Scalar(0)));
}

TEST(AlignedMatrix, BeginsAtAWholeVectorAndIsZero) {
  for (const Eigen::Index cols : {1, 2, 3, 17, 397}) {
    ExpectAlignedZeros<double>(PaddedHeight<double>(5), cols);
    ExpectAlignedZeros<float>(PaddedHeight<float>(5), cols);
    ExpectAlignedZeros<double>(3, cols);
    ExpectAlignedZeros<float>(1, cols);
  }
}

TEST(AlignedMatrix, GivesItsColumnsInPlace) {
  AlignedMatrix<double> matrix(8, 4);
  matrix.columns(1, 2).setConstant(3.0);
  EXPECT_EQ(matrix.column(1)[0], 3.0);
  EXPECT_EQ(matrix.column(2)[7], 3.0);
  EXPECT_EQ(matrix.all().sum(), 48.0);
  EXPECT_EQ(matrix.column(3), matrix.data() + 24);
  AlignedMatrix<double> moved = std::move(matrix);
  EXPECT_EQ(moved.all()(4, 1), 3.0);
  const AlignedMatrix<double> none;
  EXPECT_EQ(none.rows(), 0);
  EXPECT_EQ(none.data(), nullptr);
}

}  // namespace
}  // namespace errmap::models
