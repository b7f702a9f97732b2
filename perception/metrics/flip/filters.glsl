// SPDX-License-Identifier: BSD-3-Clause
// Kernels of both filter passes; RADIUS is defined by the program.
#include "perception/metrics/flip/flip_bindings.h"

layout(std140, binding = kFlipFiltersBlock) uniform Filters {
  vec4 sensitivity[2 * RADIUS + 1];  // achromatic, red-green, blue-yellow in two parts
  vec4 features[2 * RADIUS + 1];     // Gaussian, edge, point
};
