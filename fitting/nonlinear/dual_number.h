#pragma once

#include <array>
#include <cmath>

namespace errmap::fitting {

/// A value with its derivatives with respect to N parameters: forward-mode
/// automatic differentiation over Scalar (double, stats::DoubleDouble).
template <typename Scalar, int N>
struct Dual {
  Scalar value = Scalar(0.0);
  std::array<Scalar, static_cast<std::size_t>(N)> slope{};

  Dual() = default;
  // Implicit, like constants in a formula.
  Dual(const Scalar& constant) : value(constant) {}

  /// Parameter `index` itself.
  static Dual Parameter(const Scalar& at, int index) {
    Dual dual(at);
    dual.slope[static_cast<std::size_t>(index)] = Scalar(1.0);
    return dual;
  }

  /// f(x) with f' = `derivative` at x (chain rule).
  static Dual Chain(const Dual& x, const Scalar& f, const Scalar& derivative) {
    Dual result(f);
    for (std::size_t i = 0; i < N; ++i) {
      result.slope[i] = derivative * x.slope[i];
    }
    return result;
  }

  friend Dual operator-(const Dual& a) {
    return Chain(a, -a.value, Scalar(-1.0));
  }
  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual sum(a.value + b.value);
    for (std::size_t i = 0; i < N; ++i) sum.slope[i] = a.slope[i] + b.slope[i];
    return sum;
  }
  friend Dual operator-(const Dual& a, const Dual& b) { return a + -b; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual product(a.value * b.value);
    for (std::size_t i = 0; i < N; ++i) {
      product.slope[i] = a.slope[i] * b.value + a.value * b.slope[i];
    }
    return product;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual quotient(a.value / b.value);
    for (std::size_t i = 0; i < N; ++i) {
      quotient.slope[i] = (a.slope[i] - quotient.value * b.slope[i]) / b.value;
    }
    return quotient;
  }

  friend Dual exp(const Dual& x) {
    using std::exp;
    const Scalar f = exp(x.value);
    return Chain(x, f, f);
  }
  friend Dual log(const Dual& x) {
    using std::log;
    return Chain(x, log(x.value), Scalar(1.0) / x.value);
  }
  friend Dual sin(const Dual& x) {
    using std::cos;
    using std::sin;
    return Chain(x, sin(x.value), cos(x.value));
  }
  friend Dual cos(const Dual& x) {
    using std::cos;
    using std::sin;
    return Chain(x, cos(x.value), -sin(x.value));
  }
  friend Dual atan(const Dual& x) {
    using std::atan;
    return Chain(
        x, atan(x.value), Scalar(1.0) / (Scalar(1.0) + x.value * x.value));
  }
  /// x^y for x > 0.
  friend Dual pow(const Dual& x, const Dual& y) { return exp(y * log(x)); }
};

}  // namespace errmap::fitting
