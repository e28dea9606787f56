#include <immintrin.h>

#include "models/net/net_kernels_body.h"
#include "models/net/net_kernels_versions.h"

namespace errmap::models {

const NetKernels<double> kAvx2Double = MakeNetKernels<double>("avx2");
const NetKernels<float> kAvx2Single = MakeNetKernels<float>("avx2");

}  // namespace errmap::models
