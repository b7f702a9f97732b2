// SPDX-License-Identifier: BSD-3-Clause
layout(location = 0) in vec3 position;
layout(location = 1) in uint materialOfVertex;
layout(location = 2) in vec3 normalOfVertex;
uniform mat4 anchorToClip;
out vec3 normal;
out float distance_;
flat out uint material;
#ifdef TRIMMED
layout(location = 3) in vec3 trimOfVertex;
out vec2 trimPlace;
flat out int trimRegion;
#endif
#ifdef TEXTURED
layout(location = 4) in uint lastWordOfVertex;
out vec2 texturePlace;
#endif

void main() {
  precise const vec4 clip = anchorToClip * vec4(position, 1.0);
  gl_Position = clip;
  normal = normalOfVertex;
  distance_ = clip.w;
  material = materialOfVertex;
#ifdef TEXTURED
  texturePlace = unpackUnorm2x16(lastWordOfVertex);
#endif
#ifdef TRIMMED
  trimPlace = trimOfVertex.xy;
  trimRegion = int(trimOfVertex.z);
#endif
}
