// SPDX-License-Identifier: BSD-3-Clause
// Depth of each sample of a pixel, and which of them stands for the pixel. Schwarz 2009, section 4.6.
// A depth is written as it is for a receiver, negated for a surface that turns away from the light or lies behind it, and
// as 0 for the background.
#include "renderer/techniques/soft_shadows/multisample/sample_ids.glsl"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/frame/seen_point.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSamplePointIdsImage, r32ui) uniform writeonly uimage2D outIds;
layout(binding = kSamplePlacesImage, rg32f) uniform writeonly image2D outPlaces;
layout(binding = kSampleChosenDepthsImage, r32f) uniform writeonly image2D outDepths;             // of the samples chosen
layout(binding = kSampleDepthsImage, r32f) uniform writeonly image2DArray outSampleDepths;  // a layer a sample

uniform ivec2 sizePx;
uniform vec2 rayScale;
uniform mat4 anchorToCamera, cameraToLight;
uniform vec2 samplePlaces[SAMPLES];
uniform bool depthAtCentre;  // as a shader run once a pixel would find it, instead of at the sample

const uint kNone = 0xffffffffu;

vec2 placeOf(ivec2 pixel, int i) { return vec2(pixel) + (depthAtCentre ? vec2(0.5) : samplePlaces[i]); }

float signedDepth(uint id, vec2 place) {
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = (anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz;
  const vec3 b = (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz;
  const vec3 c = (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz;
  const SeenPoint seen = pointSeen(a, b, c, placeRay(place, rayScale, sizePx));
  const vec3 p = (cameraToLight * vec4(seen.position, 1.0)).xyz, n = mat3(cameraToLight) * seen.normal;
  return p.z > 0.0 && dot(n, p) < 0.0 ? seen.depth : -seen.depth;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  uint ids[SAMPLES];
  float depths[SAMPLES];
  for (int i = 0; i < SAMPLES; ++i) {
    ids[i] = sampleId(pixel, i);
    // Most pixels see one triangle; at one place it has one depth.
    if (i > 0 && depthAtCentre && ids[i] == ids[i - 1])
      depths[i] = depths[i - 1];
    else
      depths[i] = ids[i] == kNone ? 0.0 : signedDepth(ids[i], placeOf(pixel, i));
    imageStore(outSampleDepths, ivec3(pixel, i), vec4(depths[i]));
  }
  int chosen = 0;
#if REPRESENTATIVE != REPRESENTATIVE_FIRST
  // Of the surfaces alone: rank 0 is the nearest; of equal depths, the first sample's comes first.
  int surfaces = 0;
  for (int i = 0; i < SAMPLES; ++i) surfaces += ids[i] == kNone ? 0 : 1;
#if REPRESENTATIVE == REPRESENTATIVE_NEAREST
  const int wanted = 0;
#elif REPRESENTATIVE == REPRESENTATIVE_FARTHEST
  const int wanted = surfaces - 1;
#else
  const int wanted = (surfaces - 1) / 2;
#endif
  for (int i = 0; i < SAMPLES; ++i) {
    if (ids[i] == kNone) continue;
    int rank = 0;
    for (int j = 0; j < SAMPLES; ++j)
      if (ids[j] != kNone && (abs(depths[j]) < abs(depths[i]) || (abs(depths[j]) == abs(depths[i]) && j < i))) ++rank;
    if (rank == wanted) chosen = i;
  }
#endif
  imageStore(outIds, pixel, uvec4(ids[chosen]));
  imageStore(outPlaces, pixel, vec4(placeOf(pixel, chosen), 0.0, 0.0));
  imageStore(outDepths, pixel, vec4(depths[chosen]));
}
