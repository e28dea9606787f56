#pragma once

#include "models/net/net_kernels.h"

// The versions of models/net/net_kernels.h. Those for AVX exist on x86-64 only;
// call them only on machines with these instructions.

namespace errmap::models {

extern const NetKernels<double> kBaselineDouble;
extern const NetKernels<float> kBaselineSingle;
extern const NetKernels<double> kAvx2Double;
extern const NetKernels<float> kAvx2Single;
extern const NetKernels<double> kAvx512Double;
extern const NetKernels<float> kAvx512Single;

}  // namespace errmap::models
