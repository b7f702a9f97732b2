// SPDX-License-Identifier: BSD-3-Clause
// What a fragment gives its voxel: 1, or (SUMS) the attachments of a volume with attributes. Signed ones come to 0 to 1 where
// the maximum is kept (BLEND_MAXIMUM): (1 + value / largest) / 2. Where sums are, alpha counts fragments.
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/voxels/voxel_surface.glsl"

#ifdef CONSERVATIVE
layout(location = 3) flat in uint triangle;
#endif
#ifdef SUMS
#ifdef CONSERVATIVE
vec3 point = vec3(0.0);  // given by main()
uint triangleId() { return triangle; }
#else
layout(location = 2) in vec3 point;
#ifdef TRIANGLE_FROM_DRAW  // no geometry shader in between
layout(location = 3) flat in uint first;
uint triangleId() { return first + uint(gl_PrimitiveID); }
#else
layout(location = 3) flat in uint triangle;
uint triangleId() { return triangle; }
#endif
#endif
layout(location = OUT_OCCUPANCY) out vec4 outOccupancy;
#ifdef VOLUME_ALBEDO
layout(location = OUT_ALBEDO) out vec4 outAlbedo;
#endif
#ifdef VOLUME_NORMAL
layout(location = OUT_NORMAL) out vec4 outNormal;
#endif
#ifdef VOLUME_LIGHT
layout(location = OUT_LIGHT) out vec4 outLight;
#endif
#ifdef VOLUME_SH_GREY
layout(location = OUT_SH_GREY) out vec4 outShGrey;
#endif
#ifdef VOLUME_SH_RED
layout(location = OUT_SH_RED) out vec4 outShRed;
layout(location = OUT_SH_GREEN) out vec4 outShGreen;
layout(location = OUT_SH_BLUE) out vec4 outShBlue;
#endif

vec4 kept(vec4 value, float largest) {
#ifdef BLEND_MAXIMUM
  return 0.5 + 0.5 / largest * value;
#else
  return value;
#endif
}

vec3 unitNormal(uint id) {
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = toVoxels(scenePosition(vertices.x)), b = toVoxels(scenePosition(vertices.y)),
             c = toVoxels(scenePosition(vertices.z));
  const vec3 normal = cross(b - a, c - a), size = abs(normal);
  const float reach = max(size.x, max(size.y, size.z));
  return reach > 0.0 ? normalize(normal / reach) : vec3(0.0);
}

void writeFragment() {
  const uint id = triangleId();
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[id]];
  const vec3 normal = unitNormal(id), position = gridOrigin + voxelSize * point;
  const vec3 albedo = entryAlbedo(material, position);
  outOccupancy = vec4(entryOpacity(material), 1.0, 0.0, 0.0);
#ifdef VOLUME_ALBEDO
  outAlbedo = vec4(albedo, 1.0);
#endif
#ifdef VOLUME_NORMAL
  outNormal = vec4(kept(vec4(normal, 0.0), 1.0).xyz, 1.0);
#endif
#ifdef VOXEL_LIT
  const EntryLight light = entryLight(material, albedo, position, normal, id);
  const float largest = 1.0234 * largestLight;
#ifdef VOLUME_LIGHT
  outLight = vec4(min(light.front + light.back, vec3(largestLight)), 1.0);
#endif
#ifdef VOLUME_SH_GREY
  outShGrey = kept(entryLobe(dot(light.front, kLuminance), dot(light.back, kLuminance), normal), largest);
#endif
#ifdef VOLUME_SH_RED
  outShRed = kept(entryLobe(light.front.x, light.back.x, normal), largest);
  outShGreen = kept(entryLobe(light.front.y, light.back.y, normal), largest);
  outShBlue = kept(entryLobe(light.front.z, light.back.z, normal), largest);
#endif
#endif
}
#else
layout(location = 0) out float occupied;
void writeFragment() { occupied = 1.0; }
#endif
