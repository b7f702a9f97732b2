// SPDX-License-Identifier: BSD-3-Clause
// The scene's triangles as GpuScene binds them. Tightly packed floats: a vec3 array would be padded.
#include "renderer/frame/frame_bindings.h"

layout(std430, binding = kScenePositionsBuffer) readonly buffer Positions { float scenePositions[]; };
layout(std430, binding = kSceneIndicesBuffer) readonly buffer Indices { uint sceneIndices[]; };

#ifndef POSITION_WORDS
#define POSITION_WORDS 3u  // floats of a vertex; the first three are its position
#endif

vec3 scenePosition(uint vertex) {
  const uint first = POSITION_WORDS * vertex;
  return vec3(scenePositions[first], scenePositions[first + 1u], scenePositions[first + 2u]);
}

uvec3 sceneTriangle(uint triangle) {
  return uvec3(sceneIndices[3u * triangle], sceneIndices[3u * triangle + 1u], sceneIndices[3u * triangle + 2u]);
}
