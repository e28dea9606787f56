#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace errmap::models {

/// Size of the widest vectors of any machine, and alignment of the memory.
inline constexpr std::ptrdiff_t kVectorBytes = 64;

/// Hidden nodes are padded to a multiple of this many bytes: a full vector on
/// most machines, half of one on the widest.
inline constexpr std::ptrdiff_t kPaddingBytes = 32;

template <typename Scalar>
constexpr std::ptrdiff_t PaddedHeight(std::ptrdiff_t nodes) {
  constexpr std::ptrdiff_t kLanes =
      kPaddingBytes / static_cast<std::ptrdiff_t>(sizeof(Scalar));
  return (nodes + kLanes - 1) / kLanes * kLanes;
}

/// A block of patterns. Hidden quantities are (height x columns), column-major,
/// with height padded; w2 and p2 are (height x outputs), 0 in the padding;
/// output quantities are (outputs x columns).
struct BlockSize {
  std::ptrdiff_t height = 0;
  std::ptrdiff_t columns = 0;
  std::ptrdiff_t outputs = 0;
};

/// Operations of a net on a block of patterns. Outputs must not overlap other
/// arguments, except that y may be s. Each element of a product is summed in
/// the order of the inner dimension, and sums over patterns in the order of
/// patterns. So cutting a block into strips does not change the bits.
template <typename Scalar>
struct NetKernels {
  std::string_view name;  // "plain", "baseline", "avx2" or "avx512"

  /// Computes s = w1 x (Eq. 14): w1 (height x inner), x (inner x columns).
  void (*activate)(BlockSize size,
                   std::ptrdiff_t inner,
                   const Scalar* w1,
                   const Scalar* x,
                   Scalar* s);

  /// Computes d_w1 += delta x' for delta (height x columns) and the same x. If
  /// `anew`, d_w1 is first set to 0.
  void (*add_products)(BlockSize size,
                       std::ptrdiff_t inner,
                       const Scalar* delta,
                       const Scalar* x,
                       bool anew,
                       Scalar* d_w1);

  /// Computes y = 1 / (1 + e^-s) of n numbers, Eq. 18, with 0 and 1 at the
  /// limits, and NaN for NaN. Relative error is below 4 epsilon (1 + |s|), the
  /// size of the effect of rounding s.
  void (*logistic)(std::ptrdiff_t n, const Scalar* s, Scalar* y);

  /// Computes y = logistic(s), o = w2'y (Eq. 16, 17 without the bias).
  void (*forward)(
      BlockSize size, const Scalar* s, const Scalar* w2, Scalar* y, Scalar* o);

  /// Computes the same one step along a line, y = logistic(s + a t), with the
  /// same bits as `forward` after `advance`.
  void (*forward_along)(BlockSize size,
                        const Scalar* s,
                        const Scalar* t,
                        Scalar a,
                        const Scalar* w2,
                        Scalar* y,
                        Scalar* o);

  /// Takes the step: s += a t.
  void (*advance)(BlockSize size, const Scalar* t, Scalar a, Scalar* s);

  /// Computes the first and second derivatives with respect to a, at 0, of o(a)
  /// = (w2 + a p2)' logistic(s + a t), given y = logistic(s).
  void (*bend_along)(BlockSize size,
                     const Scalar* y,
                     const Scalar* t,
                     const Scalar* w2,
                     const Scalar* p2,
                     Scalar* first,
                     Scalar* second);

  /// Back-propagates dE/do (outputs x columns): delta = (w2 dE/do) y (1-y), and
  /// d_w2 += y (dE/do)' (Eq. 40-67).
  void (*backward)(BlockSize size,
                   const Scalar* y,
                   const Scalar* w2,
                   const Scalar* d_output,
                   Scalar* delta,
                   Scalar* d_w2);
};

/// Returns kernels that use the C library's exp and sum in the order of the
/// formulas, as the 1995 program does; also the reference for tests.
template <typename Scalar>
const NetKernels<Scalar>& PlainNetKernels();

/// Returns the kernels that this machine can run, slowest first.
template <typename Scalar>
std::span<const NetKernels<Scalar>> AvailableNetKernels();

/// Returns the fastest of them, or the one named by the environment variable
/// ERRMAP_NET_KERNELS at the first call.
template <typename Scalar>
const NetKernels<Scalar>& FastestNetKernels();

}  // namespace errmap::models
