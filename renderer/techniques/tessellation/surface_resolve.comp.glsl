// SPDX-License-Identifier: BSD-3-Clause
// What surface.frag.glsl writes, from what ComputeRaster has gathered, and clears it for the next frame: curved surfaces and, if
// MESH, the rest of the scene. PACKED: depth and the index's complement of a pixel in two words. See surface_picture.h.
#include "renderer/frame/seen_point.glsl"
#include "renderer/techniques/tessellation/tessellation_bindings.h"
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
#ifdef PACKED
layout(std430, binding = kResolveSurfaceDepthsBuffer) buffer SurfaceGathered { uvec2 surfaceNearest[]; };
layout(std430, binding = kResolveMeshDepthsBuffer) buffer MeshGathered { uvec2 meshNearest[]; };
#else
layout(std430, binding = kResolveSurfaceDepthsBuffer) buffer SurfaceGathered { uint surfaceDepths[]; };
layout(std430, binding = kResolveSurfaceIdsBuffer) buffer SurfaceIds { uint surfaceIds[]; };
layout(std430, binding = kResolveMeshDepthsBuffer) buffer MeshGathered { uint meshDepths[]; };
layout(std430, binding = kResolveMeshIdsBuffer) buffer MeshIds { uint meshIds[]; };
#endif
layout(std430, binding = kResolveSurfaceQueueBuffer) buffer SurfaceQueue { RasterQueueHeader surfaceQueue; };
layout(std430, binding = kResolveMeshQueueBuffer) buffer MeshQueue { RasterQueueHeader meshQueue; };
layout(binding = kResolveIdsImage, r32ui) uniform writeonly uimage2D ids;
layout(binding = kResolveNormalsImage, rgba32f) uniform writeonly image2D normals;
// TessellatedVertex; sixteen bytes are read at once.
layout(std430, binding = kResolveVerticesBuffer) readonly buffer VertexWords { uvec4 vertexWords[]; };
layout(std430, binding = kResolveIndicesBuffer) readonly buffer Indices { uint indices[]; };

uniform ivec2 sizePx;
uniform vec2 rayScale;
uniform mat4 anchorToCamera;

#ifdef TEXTURED
#include "renderer/techniques/tessellation/surface_texture.glsl"
#endif

struct Gathered {
  float depth;  // near / distance; 0: nothing
  uint id;      // 0xffffffff: none
};

Gathered takeSurface(int at) {
#ifdef PACKED
  const uvec2 found = surfaceNearest[at];
  surfaceNearest[at] = uvec2(0u);
  return Gathered(uintBitsToFloat(found.y), ~found.x);
#else
  const Gathered found = Gathered(uintBitsToFloat(surfaceDepths[at]), surfaceIds[at]);
  surfaceDepths[at] = 0u;
  surfaceIds[at] = 0xffffffffu;
  return found;
#endif
}

Gathered takeMesh(int at) {
#if !defined(MESH)
  return Gathered(0.0, 0xffffffffu);
#elif defined(PACKED)
  const uvec2 found = meshNearest[at];
  meshNearest[at] = uvec2(0u);
  return Gathered(uintBitsToFloat(found.y), ~found.x);
#else
  const Gathered found = Gathered(uintBitsToFloat(meshDepths[at]), meshIds[at]);
  meshDepths[at] = 0u;
  meshIds[at] = 0xffffffffu;
  return found;
#endif
}

TessellatedVertex vertexAt(uint at) {
  const uvec4 first = vertexWords[2u * at], second = vertexWords[2u * at + 1u];
  return TessellatedVertex(uintBitsToFloat(first.xyz), first.w, uintBitsToFloat(second.xyz), second.w);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel == ivec2(0)) {
    surfaceQueue.queued = 0u;
#ifdef MESH
    meshQueue.queued = 0u;
#endif
  }
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const int at = pixel.y * sizePx.x + pixel.x;
  const Gathered surface = takeSurface(at), mesh = takeMesh(at);
  const uint triangle = surface.id;
  if (triangle == 0xffffffffu || !(surface.depth > mesh.depth)) {
    imageStore(ids, pixel, uvec4(mesh.id));
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
  uint id = kSurfaceOfPatch | va.material;
#ifdef TEXTURED
  if (onDarkCheck(weights.x * unpackUnorm2x16(va.rung) + weights.y * unpackUnorm2x16(vb.rung) +
                  weights.z * unpackUnorm2x16(vc.rung)))
    id |= kSurfaceDarkCheck;
#endif
  imageStore(ids, pixel, uvec4(id));
  imageStore(normals, pixel, vec4(normal, seen.depth));
}
