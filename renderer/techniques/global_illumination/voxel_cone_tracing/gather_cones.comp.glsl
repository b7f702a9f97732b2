// SPDX-License-Identifier: BSD-3-Clause
// Indirect light of each pixel's point by cones through the pyramid.
#include "renderer/techniques/global_illumination/indirect_picture.glsl"
#include "renderer/techniques/global_illumination/voxel_cone_tracing/radiance.glsl"

vec3 indirectLight(SurfacePoint point, vec3 albedo) { return albedo * conesAbout(toVoxels(point.position), point.flatNormal); }
