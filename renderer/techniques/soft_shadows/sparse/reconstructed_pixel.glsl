// SPDX-License-Identifier: BSD-3-Clause
// What both reconstructions of sparse visibility read of a pixel, and where its visibility goes. COUNT: how it was found.
#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSparseReceiversUnit) uniform sampler2D receivers;
layout(binding = kSparseDepthsUnit) uniform sampler2D depths;
layout(binding = kSparseNormalsUnit) uniform sampler2D normals;
layout(binding = kSparseReconstructVisibilityImage, r32f) uniform writeonly image2D outVisibility;
#ifdef COUNT
layout(binding = kSparseReconstructClassImage, r32ui) uniform writeonly uimage2D outClass;
#endif
uniform ivec2 sizePx;
uniform vec2 rayScale;

// Counted by reconstruction.cpp.
const float kLeastWeight = 1e-4;  // below it, weights say that no sample lies on the pixel's surface

void store(ivec2 pixel, float visibility, uint kind) {
  imageStore(outVisibility, pixel, vec4(visibility));
#ifdef COUNT
  imageStore(outClass, pixel, uvec4(kind));
#endif
}
