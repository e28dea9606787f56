#include <immintrin.h>

#include "models/net/net_kernels_body.h"
#include "models/net/net_kernels_versions.h"

namespace errmap::models {

const NetKernels<double> kAvx512Double = MakeNetKernels<double>("avx512");
const NetKernels<float> kAvx512Single = MakeNetKernels<float>("avx512");

}  // namespace errmap::models
