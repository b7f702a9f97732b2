// SPDX-License-Identifier: BSD-3-Clause
// One invocation traces a listed ray, from a pixel's point to the middle of the empty voxel beyond a face of one of those around it.
#include "renderer/techniques/global_illumination/indirect_point.glsl"

layout(local_size_x = kAskedGroup) in;
#include "renderer/techniques/global_illumination/voxel_propagation/gather_light.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/asked_lists.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/seen_voxel.glsl"

void main() {
  const uint place = listedPlace();
  if (place >= asked.rays.listed) return;
  const uint entry = askedRays[place];
  if (entry == kNoRay) return;
  const uint number = entry >> kAskedCornerBits, bit = entry & (1u << kAskedCornerBits) - 1u;
  const int corner = int(bit & 7u), face = int(bit >> 3);
  SurfacePoint point;
  if (!pixelSees(pixelOf(number), point)) return;
  const ivec3 voxel = ivec3(floor(toVoxels(point.position) - 0.5)) + cornerStep(corner) + faceStep(face);
  const bool seen = seesVoxel(point, voxel);
  if (rayCutShort)
    atomicOr(seenCorners[number].y, kSeenCutShort);
  else if (seen && bit < 32u)
    atomicOr(seenCorners[number].x, 1u << bit);
  else if (seen)
    atomicOr(seenCorners[number].y, 1u << (bit - 32u));
}
