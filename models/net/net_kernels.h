#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace errmap::models {

/// The widest vectors of any machine; memory begins at one.
inline constexpr std::ptrdiff_t kVectorBytes = 64;

/// Hidden nodes are padded to a multiple of this many bytes: a vector of most
/// machines, half a one of the widest.
inline constexpr std::ptrdiff_t kPaddingBytes = 32;

template <typename Scalar>
constexpr std::ptrdiff_t PaddedHeight(std::ptrdiff_t nodes) {
  constexpr std::ptrdiff_t kLanes =
      kPaddingBytes / static_cast<std::ptrdiff_t>(sizeof(Scalar));
  return (nodes + kLanes - 1) / kLanes * kLanes;
}

/// A block of patterns: hidden quantities are (height x columns), column-major,
/// height a padded one; w2 and p2 (height x outputs), 0 in the padding; output
/// quantities (outputs x columns).
struct BlockSize {
  std::ptrdiff_t height = 0;
  std::ptrdiff_t columns = 0;
  std::ptrdiff_t outputs = 0;
};

/// The work of a net over a block of patterns. What is written must not overlap
/// anything else, except that y may stand in the place of s. Each element of a
/// product is summed in the order of the inner dimension, and those over
/// patterns in theirs, so that a block may be cut into strips and give the
/// same.
template <typename Scalar>
struct NetKernels {
  std::string_view name;  // "plain", "baseline", "avx2" or "avx512"

  /// s = w1 x (Eq. 14): w1 (height x inner), x (inner x columns).
  void (*activate)(BlockSize size,
                   std::ptrdiff_t inner,
                   const Scalar* w1,
                   const Scalar* x,
                   Scalar* s);

  /// d_w1 += delta x', of delta (height x columns) and the same x; where
  /// `anew`, d_w1 counts as 0 before.
  void (*add_products)(BlockSize size,
                       std::ptrdiff_t inner,
                       const Scalar* delta,
                       const Scalar* x,
                       bool anew,
                       Scalar* d_w1);

  /// y = 1 / (1 + e^-s) of n numbers, Eq. 18; 0 and 1 in the limits, NaN for
  /// NaN. Relative error below 4 epsilon (1 + |s|), the size of
  /// what a rounding of s does.
  void (*logistic)(std::ptrdiff_t n, const Scalar* s, Scalar* y);

  /// y = logistic(s), o = w2'y (Eq. 16, 17 less the bias).
  void (*forward)(
      BlockSize size, const Scalar* s, const Scalar* w2, Scalar* y, Scalar* o);

  /// The same a step along a line, y = logistic(s + a t): the very bits that
  /// `forward` finds after `advance`.
  void (*forward_along)(BlockSize size,
                        const Scalar* s,
                        const Scalar* t,
                        Scalar a,
                        const Scalar* w2,
                        Scalar* y,
                        Scalar* o);

  /// That step taken: s += a t.
  void (*advance)(BlockSize size, const Scalar* t, Scalar a, Scalar* s);

  /// First and second derivative by a, at 0, of
  /// o(a) = (w2 + a p2)' logistic(s + a t), where y = logistic(s).
  void (*bend_along)(BlockSize size,
                     const Scalar* y,
                     const Scalar* t,
                     const Scalar* w2,
                     const Scalar* p2,
                     Scalar* first,
                     Scalar* second);

  /// Back propagation of dE/do (outputs x columns): delta = (w2 dE/do) y (1-y),
  /// and d_w2 += y (dE/do)' (Eq. 40-67).
  void (*backward)(BlockSize size,
                   const Scalar* y,
                   const Scalar* w2,
                   const Scalar* d_output,
                   Scalar* delta,
                   Scalar* d_w2);
};

/// The same by the C library's exp and sums in the order of the formulas: what
/// the others are tested against, and the 1995 program's arithmetic.
template <typename Scalar>
const NetKernels<Scalar>& PlainNetKernels();

/// The versions that this machine can run, slowest first.
template <typename Scalar>
std::span<const NetKernels<Scalar>> AvailableNetKernels();

/// The fastest of them, or that whose name the environment variable
/// ERRMAP_NET_KERNELS has when the program begins to use them.
template <typename Scalar>
const NetKernels<Scalar>& FastestNetKernels();

}  // namespace errmap::models
