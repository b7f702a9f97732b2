// SPDX-License-Identifier: BSD-3-Clause
// What both reconstructions of sparse visibility read of a pixel, and where its visibility goes. COUNT: how it was found.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D receivers;
layout(binding = 1) uniform sampler2D depths;
layout(binding = 2) uniform sampler2D normals;
layout(binding = 0, r32f) uniform writeonly image2D outVisibility;
#ifdef COUNT
layout(binding = 1, r32ui) uniform writeonly uimage2D outClass;
#endif
uniform ivec2 sizePx;
uniform vec2 rayScale;

// Counted by reconstruction.cpp.
const uint kOther = 0u, kInterpolated = 1u, kFallback = 2u, kAlone = 3u, kOwn = 4u;
const float kLeastWeight = 1e-4;  // below it, weights say that no sample lies on the pixel's surface

void store(ivec2 pixel, float visibility, uint kind) {
  imageStore(outVisibility, pixel, vec4(visibility));
#ifdef COUNT
  imageStore(outClass, pixel, uvec4(kind));
#endif
}
