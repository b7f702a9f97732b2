// SPDX-License-Identifier: BSD-3-Clause
// What surface.frag.glsl writes, from the triangles that ComputeRaster saw: of the mesh and of curved surfaces. See
// surface_picture.h.
#include "renderer/frame/seen_point.glsl"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kResolveMeshIdsUnit) uniform usampler2D meshIds;
layout(binding = kResolveMeshDepthUnit) uniform sampler2D meshDepth;
layout(binding = kResolveSurfaceIdsUnit) uniform usampler2D surfaceIds;
layout(binding = kResolveSurfaceDepthUnit) uniform sampler2D surfaceDepth;
layout(binding = kResolveIdsImage, r32ui) uniform writeonly uimage2D ids;
layout(binding = kResolveNormalsImage, rgba32f) uniform writeonly image2D normals;
// TessellatedVertex; sixteen bytes are read at once.
layout(std430, binding = kResolveVerticesBuffer) readonly buffer VertexWords { uvec4 vertexWords[]; };
layout(std430, binding = kResolveIndicesBuffer) readonly buffer Indices { uint indices[]; };

uniform ivec2 sizePx;
uniform vec2 rayScale;
uniform mat4 anchorToCamera;

TessellatedVertex vertexAt(uint at) {
  const uvec4 first = vertexWords[2u * at], second = vertexWords[2u * at + 1u];
  return TessellatedVertex(uintBitsToFloat(first.xyz), first.w, uintBitsToFloat(second.xyz), second.w);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint triangle = texelFetch(surfaceIds, pixel, 0).x;
  if (triangle == 0xffffffffu || !(texelFetch(surfaceDepth, pixel, 0).x > texelFetch(meshDepth, pixel, 0).x)) {
    imageStore(ids, pixel, uvec4(texelFetch(meshIds, pixel, 0).x));
    return;
  }
  const TessellatedVertex va = vertexAt(indices[3u * triangle]), vb = vertexAt(indices[3u * triangle + 1u]),
                          vc = vertexAt(indices[3u * triangle + 2u]);
  const vec3 a = (anchorToCamera * vec4(va.position, 1.0)).xyz, b = (anchorToCamera * vec4(vb.position, 1.0)).xyz,
             c = (anchorToCamera * vec4(vc.position, 1.0)).xyz;
  const SeenPoint seen = pointSeen(a, b, c, pixelRay(pixel, rayScale, sizePx));
  const vec3 weights = barycentrics(a, b, c, seen.position);
  vec3 normal = weights.x * va.normal + weights.y * vb.normal + weights.z * vc.normal;
  // The triangle decides which side is seen.
  if (dot(cross(b - a, c - a), seen.normal) < 0.0) normal = -normal;
  imageStore(ids, pixel, uvec4(kSurfaceOfPatch | va.material));
  imageStore(normals, pixel, vec4(normal, seen.depth));
}
