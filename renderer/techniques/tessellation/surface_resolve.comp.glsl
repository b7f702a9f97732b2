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
uniform ivec2 sizePx;
uniform vec2 rayScale;  // half the image's extents at distance 1
uniform mat4 anchorToCamera;

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

#define LISTED_VERTICES_BUFFER kResolveVerticesBuffer
#define LISTED_INDICES_BUFFER kResolveIndicesBuffer
#include "renderer/techniques/tessellation/listed_surface.glsl"

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
  const ListedPoint seen = listedPoint(pixel, triangle);
  imageStore(ids, pixel, uvec4(kSurfaceOfPatch | seen.material));
  imageStore(normals, pixel, vec4(seen.normal, seen.depth));
}
