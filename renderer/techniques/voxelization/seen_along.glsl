// SPDX-License-Identifier: BSD-3-Clause
// A grid seen along AXIS: what lies across it, and where that is in clip space.
#include "renderer/voxels/volume.glsl"
#include "renderer/voxels/voxel_axes.glsl"

vec2 across(vec3 v) { return across(v, AXIS); }

// Row 0 of images is their top.
vec4 onLayerAcross(vec2 at) { return vec4(vec2(2.0, -2.0) * at / across(vec3(gridSize())) + vec2(-1.0, 1.0), 0.5, 1.0); }
vec4 onLayer(vec3 v) { return onLayerAcross(across(v)); }
