#include "models/net/net_kernels_body.h"
#include "models/net/net_kernels_versions.h"

namespace errmap::models {

const NetKernels<double> kBaselineDouble = MakeNetKernels<double>("baseline");
const NetKernels<float> kBaselineSingle = MakeNetKernels<float>("baseline");

}  // namespace errmap::models
