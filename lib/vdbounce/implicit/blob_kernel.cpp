// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/blob_kernel.h"

#include <cmath>

namespace vdbounce {

double kernelValue(BlobKernel kernel, double x)
{
    switch (kernel) {
    case BlobKernel::Gaussian: return std::exp(-x * x);
    case BlobKernel::Compact: {
        const double u = 1.0 - 0.25 * x * x;
        return u > 0.0 ? u * u * u : 0.0;
    }
    case BlobKernel::Sphere: break;
    }
    return x <= 1.0 ? 1.0 : 0.0;
}

double kernelArgument(BlobKernel kernel, double value)
{
    if (value >= 1.0 && kernel != BlobKernel::Sphere) return 0.0;
    switch (kernel) {
    case BlobKernel::Gaussian: return std::sqrt(-std::log(value));
    case BlobKernel::Compact: return 2.0 * std::sqrt(1.0 - std::cbrt(value));
    case BlobKernel::Sphere: break;
    }
    return 1.0;
}

} // namespace vdbounce
