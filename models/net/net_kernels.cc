#include "models/net/net_kernels.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "models/net/net_kernels_versions.h"

namespace errmap::models {
namespace {

template <typename Scalar>
std::vector<NetKernels<Scalar>> Versions(
    const NetKernels<Scalar>& baseline,
    [[maybe_unused]] const NetKernels<Scalar>* avx2,
    [[maybe_unused]] const NetKernels<Scalar>* avx512) {
  std::vector<NetKernels<Scalar>> versions = {baseline};
#if defined(__x86_64__)
  const bool has_avx2 =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (has_avx2) versions.push_back(*avx2);
  if (has_avx2 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    versions.push_back(*avx512);
  }
#endif
  return versions;
}

}  // namespace

#if defined(__x86_64__)
#define ERRMAP_ADDRESS(version) &version
#else
#define ERRMAP_ADDRESS(version) nullptr
#endif

template <>
std::span<const NetKernels<double>> AvailableNetKernels<double>() {
  static const std::vector<NetKernels<double>> versions =
      Versions<double>(kBaselineDouble,
                       ERRMAP_ADDRESS(kAvx2Double),
                       ERRMAP_ADDRESS(kAvx512Double));
  return versions;
}

template <>
std::span<const NetKernels<float>> AvailableNetKernels<float>() {
  static const std::vector<NetKernels<float>> versions =
      Versions<float>(kBaselineSingle,
                      ERRMAP_ADDRESS(kAvx2Single),
                      ERRMAP_ADDRESS(kAvx512Single));
  return versions;
}

#undef ERRMAP_ADDRESS

namespace {

template <typename Scalar>
const NetKernels<Scalar>& WantedNetKernels() {
  const auto available = AvailableNetKernels<Scalar>();
  const char* wanted = std::getenv("ERRMAP_NET_KERNELS");
  if (wanted != nullptr) {
    const auto found =
        std::ranges::find(available, wanted, &NetKernels<Scalar>::name);
    if (found != available.end()) return *found;
  }
  return available.back();
}

}  // namespace

template <typename Scalar>
const NetKernels<Scalar>& FastestNetKernels() {
  static const NetKernels<Scalar>& kernels = WantedNetKernels<Scalar>();
  return kernels;
}
template const NetKernels<double>& FastestNetKernels();
template const NetKernels<float>& FastestNetKernels();

}  // namespace errmap::models
