// SPDX-License-Identifier: BSD-3-Clause
// Radiance of the points of a tree in the light of the scene's first light, taken as a point that sends light with the cosine of its
// direction, as virtual_lights.comp.glsl does; seen along a ray. Fourth: the mean of the channels, negative where it leaves the back.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/ray_tracing/trace.glsl"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kLeafColoursGroup) in;
layout(std430, binding = kSurfaceTriangleMaterialsBuffer) readonly buffer TriangleMaterials { uint surfaceMaterialOf[]; };
layout(std430, binding = kSurfaceMaterialsBuffer) readonly buffer Materials { SurfaceMaterial surfaceMaterials[]; };
layout(std430, binding = kLitSamplesBuffer) readonly buffer Samples { uvec2 samples[]; };
layout(std430, binding = kLitColoursBuffer) writeonly buffer Colours { uvec2 colours[]; };

uniform uint leaves;
uniform vec3 lightCentre, lightZ, intensity;  // along its direction

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return true; }

void main() {
  const uint leaf = gl_GlobalInvocationID.x;
  if (leaf >= leaves) return;
  const uvec2 at = samples[leaf];
  const float s = float(at.y & 0xffffu) / 65535.0, t = float(at.y >> 16u) / 65535.0;
  const uvec3 corners = sceneTriangle(at.x);
  const vec3 a = scenePosition(corners.x), b = scenePosition(corners.y), c = scenePosition(corners.z);
  const vec3 position = a * (1.0 - s - t) + b * s + c * t;
  const vec3 winding = cross(b - a, c - a), path = lightCentre - position;
  const float distance2 = dot(path, path), area = length(winding);
  vec3 light = vec3(0.0);
  float front = 0.0;
  const float emitted = -dot(path, lightZ);
  if (emitted > 0.0 && distance2 > 0.0 && area > 0.0 &&
      !rayAnyHit(Ray(position, path, 1e-4, 1.0 - 1e-4, at.x))) {
    // The side that faces the light is lit: that of the winding, or the other one.
    front = sign(dot(path, winding));
    const float cosines = emitted * abs(dot(path, winding)) / (area * distance2);
    light = intensity * surfaceMaterials[surfaceMaterialOf[at.x]].albedo * (cosines / (distance2 * 3.14159265));
  }
  if (rayCutShort) light = vec3(uintBitsToFloat(0x7fc00000u));
  light = min(light, vec3(65504.0));
  colours[leaves + leaf] = uvec2(packHalf2x16(light.xy), packHalf2x16(vec2(light.z, front * (light.r + light.g + light.b) / 3.0)));
}
