// SPDX-License-Identifier: BSD-3-Clause
// What a pixel sees of triangles that the GPU has listed: LISTED_VERTICES_BUFFER and LISTED_INDICES_BUFFER, TessellatedVertex. The
// including shader declares sizePx, rayScale and anchorToCamera, and includes seen_point.glsl.

// Sixteen bytes are read at once.
layout(std430, binding = LISTED_VERTICES_BUFFER) readonly buffer ListedVertexWords { uvec4 listedVertexWords[]; };
layout(std430, binding = LISTED_INDICES_BUFFER) readonly buffer ListedIndices { uint listedIndices[]; };

#ifdef TEXTURED
#include "renderer/techniques/tessellation/surface_texture.glsl"
#endif

struct ListedPoint {
  vec3 normal;  // interpolated, turned to the viewer's side; of any length
  float depth;  // distance along the view
  uint material;  // with kSurfaceDarkCheck where TEXTURED and on a dark check
};

TessellatedVertex listedVertex(uint at) {
  const uvec4 first = listedVertexWords[2u * at], second = listedVertexWords[2u * at + 1u];
  return TessellatedVertex(uintBitsToFloat(first.xyz), first.w, uintBitsToFloat(second.xyz), second.w);
}

ListedPoint listedPoint(ivec2 pixel, uint triangle) {
  const TessellatedVertex va = listedVertex(listedIndices[3u * triangle]),
                          vb = listedVertex(listedIndices[3u * triangle + 1u]),
                          vc = listedVertex(listedIndices[3u * triangle + 2u]);
  const vec3 a = (anchorToCamera * vec4(va.position, 1.0)).xyz, b = (anchorToCamera * vec4(vb.position, 1.0)).xyz,
             c = (anchorToCamera * vec4(vc.position, 1.0)).xyz;
  const SeenPoint seen = pointSeen(a, b, c, pixelRay(pixel, rayScale, sizePx));
  const vec3 weights = barycentrics(a, b, c, seen.position);
  vec3 normal = weights.x * va.normal + weights.y * vb.normal + weights.z * vc.normal;
  // The triangle decides which side is seen.
  if (dot(cross(b - a, c - a), seen.normal) < 0.0) normal = -normal;
  uint material = va.material;
#ifdef TEXTURED
  if (onDarkCheck(weights.x * unpackUnorm2x16(va.rung) + weights.y * unpackUnorm2x16(vb.rung) +
                  weights.z * unpackUnorm2x16(vc.rung)))
    material |= kSurfaceDarkCheck;
#endif
  return ListedPoint(normal, seen.depth, material);
}
