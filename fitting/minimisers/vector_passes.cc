#include "fitting/minimisers/vector_passes.h"

#include <cassert>
#include <cstring>

#include "fitting/multiversion.h"

namespace errmap::fitting {
namespace {

// A function that multiversion.h compiles several times takes with it what it
// calls, if that is inlined.
#define ERRMAP_INLINE __attribute__((always_inline)) inline

// The lanes of a sum, in the portable vectors of GCC and Clang: left to itself
// the compiler shuffles elements of many steps together.
constexpr Index kBytes = 32;
template <typename Scalar>
constexpr Index kLanes = kBytes / static_cast<Index>(sizeof(Scalar));
template <typename Scalar>
struct LanesOf;
template <>
struct LanesOf<double> {
  using Type = double __attribute__((vector_size(kBytes)));
};
template <>
struct LanesOf<float> {
  using Type = float __attribute__((vector_size(kBytes)));
};
template <typename Scalar>
using Lanes = typename LanesOf<Scalar>::Type;

template <typename Scalar>
ERRMAP_INLINE void Load(const Scalar* from, Lanes<Scalar>* lanes) {
  std::memcpy(lanes, from, sizeof *lanes);
}

// The lanes from `half` on added to those below.
template <typename Scalar>
ERRMAP_INLINE void Fold(Index half, Lanes<Scalar>* lanes) {
  for (Index l = 0; l < half; ++l) (*lanes)[l] += (*lanes)[l + half];
}

// Adds all lanes, then the `rest` terms: half of the lanes at once if there are
// so many, the others one by one.
template <typename Scalar, typename Term>
ERRMAP_INLINE Scalar Total(Lanes<Scalar> lanes, Index rest, Term term) {
  constexpr Index kHalf = kLanes<Scalar> / 2;
  Index i = 0;
  Fold<Scalar>(kHalf, &lanes);
  if (rest >= kHalf) {
    for (; i < kHalf; ++i) lanes[i] += term(i);
  }
  for (Index half = kHalf / 2; half > 0; half /= 2) Fold<Scalar>(half, &lanes);
  Scalar sum = lanes[0];
  for (; i < rest; ++i) sum += term(i);
  return sum;
}

template <typename Scalar>
ERRMAP_INLINE VectorSums<Scalar> SumsOf(Index n,
                                        const Scalar* x,
                                        const Scalar* y) {
  Lanes<Scalar> squares = {};
  Lanes<Scalar> products = {};
  Index i = 0;
  for (; i + kLanes<Scalar> <= n; i += kLanes<Scalar>) {
    Lanes<Scalar> a;
    Lanes<Scalar> b;
    Load(x + i, &a);
    Load(y + i, &b);
    squares += a * a;
    products += a * b;
  }
  return {Total<Scalar>(
              squares, n - i, [&](Index k) { return x[i + k] * x[i + k]; }),
          Total<Scalar>(
              products, n - i, [&](Index k) { return x[i + k] * y[i + k]; })};
}

}  // namespace

ERRMAP_MULTIVERSION
VectorSums<double> SquaresAndProduct(const VectorOf<double>& x,
                                     const VectorOf<double>& y) {
  assert(x.size() == y.size());
  return SumsOf(x.size(), x.data(), y.data());
}

ERRMAP_MULTIVERSION
VectorSums<float> SquaresAndProduct(const VectorOf<float>& x,
                                    const VectorOf<float>& y) {
  assert(x.size() == y.size());
  return SumsOf(x.size(), x.data(), y.data());
}

}  // namespace errmap::fitting
