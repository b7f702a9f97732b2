// SPDX-License-Identifier: BSD-3-Clause
// Normal and occupancy; light as a cosine lobe about the normal in two bands of harmonics, in the order 00, y, z, x.
layout(location = 0) flat in vec3 pointNormal;
layout(location = 1) flat in vec3 pointLight;
layout(location = 0) out vec4 normalTarget;
#if TARGETS == 4
layout(location = 1) out vec4 redTarget;
layout(location = 2) out vec4 greenTarget;
layout(location = 3) out vec4 blueTarget;
#endif

void main() {
  normalTarget = vec4(pointNormal, 1.0);
#if TARGETS == 4
  const vec4 lobe = vec4(0.886226925, 1.023326708 * pointNormal.yzx);
  redTarget = pointLight.x * lobe;
  greenTarget = pointLight.y * lobe;
  blueTarget = pointLight.z * lobe;
#endif
}
