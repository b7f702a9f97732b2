// SPDX-License-Identifier: BSD-3-Clause
// The scene's triangles as GpuScene binds them from binding 0. Tightly packed floats: a vec3 array would be padded.
layout(std430, binding = 0) readonly buffer Positions { float scenePositions[]; };
layout(std430, binding = 1) readonly buffer Indices { uint sceneIndices[]; };
layout(std430, binding = 2) readonly buffer Albedos { uint sceneAlbedos[]; };

vec3 scenePosition(uint vertex) {
  return vec3(scenePositions[3u * vertex], scenePositions[3u * vertex + 1u], scenePositions[3u * vertex + 2u]);
}

uvec3 sceneTriangle(uint triangle) {
  return uvec3(sceneIndices[3u * triangle], sceneIndices[3u * triangle + 1u], sceneIndices[3u * triangle + 2u]);
}
