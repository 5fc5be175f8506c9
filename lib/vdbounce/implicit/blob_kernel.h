// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vdbounce {

/// How much a particle adds at x = |p - centre| / radius.
enum class BlobKernel {
    Gaussian, ///< exp(-x^2), without end: Blinn, "A generalization of algebraic surface drawing", 1982
    Compact,  ///< (1 - x^2/4)^3 up to x = 2, nothing beyond: Wyvill, McPheeters, Wyvill, "Data structure for soft
              ///< objects", 1986; its first two derivatives vanish at the end
    Sphere,   ///< no sum: the particles are balls of their radius, and the surface is that of their union
};

/// The kernel's value at x; for Sphere 1 up to x = 1.
double kernelValue(BlobKernel kernel, double x);

/// Where the kernel has the value `value`, above 0: the inverse, 0 where it is nowhere so large.
double kernelArgument(BlobKernel kernel, double value);

} // namespace vdbounce
