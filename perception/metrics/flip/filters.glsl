// SPDX-License-Identifier: BSD-3-Clause
// Kernels of both filter passes; RADIUS is defined by the program.

layout(std140, binding = 0) uniform Filters {
  vec4 sensitivity[2 * RADIUS + 1];  // achromatic, red-green, blue-yellow in two parts
  vec4 features[2 * RADIUS + 1];     // Gaussian, edge, point
};
