#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <gtest/gtest.h>

#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "models/net/feedforward_net.h"
#include "models/net/net_objective.h"
#include "tests/random_matrix.h"

// Every allocation is counted where all of them end, in the C library: operator
// new, aligned or not, and Eigen, which asks malloc itself. One thread.
namespace {
std::int64_t allocations = 0;
}  // namespace

#if defined(__SANITIZE_ADDRESS__)
// Its malloc cannot be replaced, but tells.
extern "C" int __sanitizer_install_malloc_and_free_hooks(
    void (*malloc_hook)(const volatile void*, std::size_t),
    void (*free_hook)(const volatile void*));
namespace {
[[maybe_unused]] const int installed =
    __sanitizer_install_malloc_and_free_hooks(
        [](const volatile void*, std::size_t) { ++allocations; },
        [](const volatile void*) {});
}  // namespace
#elif defined(__GLIBC__)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  ++allocations;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}
#else
#error "how are allocations counted with this C library?"
#endif

namespace errmap::fitting {
namespace {

using Eigen::Index;
using errmap::testing::RandomMatrix;
using models::NetArithmetic;
using models::NetShape;

// The report's size.
constexpr Index kPatterns = 397;
const NetShape kShape{37, 60, 1, models::OutputFunction::kSigmoid};

TEST(Allocations, AreCounted) {
  const std::int64_t before = allocations;
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(100);
  EXPECT_EQ(allocations, before + 1);
  vector.resize(200);
  EXPECT_EQ(allocations, before + 2);
  const auto* number = new volatile double(1.0);
  EXPECT_EQ(allocations, before + 3);
  delete number;
  models::AlignedMatrix<double> aligned(8, 3);
  EXPECT_EQ(allocations, before + 4);
}

template <typename Scalar>
std::int64_t AllocationsOf(ScgVariant variant,
                           NetArithmetic arithmetic,
                           std::int64_t iterations) {
  const models::BasicNetObjective<Scalar> objective(
      kShape,
      RandomMatrix(kPatterns, kShape.inputs, 1),
      RandomMatrix(kPatterns, 1, 2).cwiseAbs(),
      1e-5,
      {},
      arithmetic);
  ScaledConjugateGradientOptions options;
  options.variant = variant;
  options.stopping.iterations = iterations;
  options.stopping.gradient_goal = 0.0;
  const BasicScaledConjugateGradient<Scalar> optimizer(options);
  const VectorOf<Scalar> start =
      models::InitialWeights(kShape, 1).template cast<Scalar>();
  const std::int64_t before = allocations;
  const Minimum minimum = optimizer.Minimize(objective, start);
  const std::int64_t taken = allocations - before;
  EXPECT_EQ(minimum.summary.iterations, iterations);
  return taken;
}

template <typename Scalar>
void ExpectNonePerIteration(ScgVariant variant, NetArithmetic arithmetic) {
  // The first run makes what stays for good, such as OpenBLAS's buffers.
  AllocationsOf<Scalar>(variant, arithmetic, 10);
  const std::int64_t half = AllocationsOf<Scalar>(variant, arithmetic, 100);
  EXPECT_GT(half, 0);
  EXPECT_EQ(AllocationsOf<Scalar>(variant, arithmetic, 200), half);
}

TEST(Allocations, AreNotMadePerIterationByMoller) {
  ExpectNonePerIteration<double>(ScgVariant::kMoller, NetArithmetic::kFast);
  ExpectNonePerIteration<float>(ScgVariant::kMoller, NetArithmetic::kFast);
}

TEST(Allocations, AreNotMadePerIterationByNetcg) {
  ExpectNonePerIteration<double>(ScgVariant::kNetcg, NetArithmetic::kFast);
  ExpectNonePerIteration<float>(ScgVariant::kNetcg, NetArithmetic::kFast);
}

TEST(Allocations, AreNotMadePerIterationByPlainArithmetic) {
  ExpectNonePerIteration<double>(ScgVariant::kNetcg, NetArithmetic::kPlain);
  ExpectNonePerIteration<float>(ScgVariant::kNetcg, NetArithmetic::kPlain);
}

}  // namespace
}  // namespace errmap::fitting
