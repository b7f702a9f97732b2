// SPDX-License-Identifier: BSD-3-Clause
// Main step, instanced: a vertex of the pattern is a row of the tables, an instance a patch.
#include "renderer/techniques/subdivision/tables.glsl"

uniform mat4 anchorToClip;
out vec3 normal;
out float distance_;
flat out uint material;
#ifdef TEXTURED
out vec2 texturePlace;
#endif

void main() {
  const uint patchNumber = uint(gl_InstanceID), row = uint(gl_VertexID);
  const uvec2 source = sourceOf(patchNumber, placeOfRow(row));
  precise const vec4 clip = anchorToClip * vec4(tablePosition(source.x, source.y), 1.0);
  gl_Position = clip;
  normal = tableNormal(patchNumber, row);
  distance_ = clip.w;
  material = patches[patchNumber].material;
#ifdef TEXTURED
  texturePlace = tableTexture(patchNumber, row);
#endif
}
