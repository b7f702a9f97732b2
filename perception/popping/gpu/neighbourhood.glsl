// SPDX-License-Identifier: BSD-3-Clause
// Response of the vision model where contrasts are masked by those around them, as perception/popping/neighbourhood.h,
// in place of response.glsl; contrasts over thresholds were made by normalise.comp.glsl. Include masking.glsl and
// stages.glsl before.
layout(local_size_x = kPoppingGroupX, local_size_y = kPoppingGroupY) in;

// Layers: actual and predicted frame, A, a, b; over time after and before the switch, four mechanisms.
layout(binding = kResponseNormalisedUnit) uniform sampler2DArray normalisedContrasts;

uniform int frameCount;  // 2
uniform int level;

const ivec2 kTile = ivec2(kPoppingGroupX, kPoppingGroupY) + 2 * MASKING_RADIUS;
const int kTileCount = kTile.x * kTile.y;
shared vec4 maskers[2 * kTileCount];

vec4 maskerOf(vec4 contrast) {
  vec4 masker = vec4(0.0);
#ifdef TEMPORAL_CHANNELS
  const int kChannels = 4;
#else
  const int kChannels = 3;
#endif
  for (int c = 0; c < kChannels; ++c)
    if (abs(contrast[c]) > MASKING_DEAD_ZONE) masker[c] = pow(abs(contrast[c]), MASKING_BETA) - MASKING_LEAST;
  return masker;
}

// Fills the shared maskers. A neighbour beyond the edge is the one at the edge.
void prepare() {
  ivec2 corner = ivec2(gl_WorkGroupID.xy) * ivec2(kPoppingGroupX, kPoppingGroupY) - MASKING_RADIUS;
  ivec2 last = textureSize(normalisedContrasts, level).xy - 1;
  for (int i = int(gl_LocalInvocationIndex); i < frameCount * kTileCount; i += kPoppingGroupX * kPoppingGroupY) {
    int pixel = i % kTileCount;
    ivec2 place = clamp(corner + ivec2(pixel % kTile.x, pixel / kTile.x), ivec2(0), last);
    maskers[i] = maskerOf(texelFetch(normalisedContrasts, ivec3(place, i / kTileCount), level));
  }
  barrier();
}

// Response of the actual frame minus that of the predicted one, channels A, a, b.
vec3 responseDifference(ivec2 pixel, int shownFrame, out Stages shown) {
  ivec2 local = ivec2(gl_LocalInvocationID.xy) + MASKING_RADIUS;
  const float kCount = float((2 * MASKING_RADIUS + 1) * (2 * MASKING_RADIUS + 1) - 1);
  precise vec4 difference = vec4(0.0);
  for (int frame = 0; frame < frameCount; ++frame) {
    vec4 contrast = texelFetch(normalisedContrasts, ivec3(pixel, frame), level);
    precise vec4 sum = vec4(0.0);
    for (int dy = -MASKING_RADIUS; dy <= MASKING_RADIUS; ++dy)
      for (int dx = -MASKING_RADIUS; dx <= MASKING_RADIUS; ++dx)
        if (dx != 0 || dy != 0) sum += maskers[frame * kTileCount + (local.y + dy) * kTile.x + local.x + dx];
    precise vec4 response =
        vec4(transducer(contrast.x), transducer(contrast.y), transducer(contrast.z), transducer(contrast.w)) /
        (1.0 + MASKING_STRENGTH * sum / kCount);
    difference = frame == 0 ? response : difference - response;
#ifdef SHOW_STAGES
    if (frame == shownFrame) shown.response = response.xyz;
#endif
  }
#ifdef TEMPORAL_CHANNELS
  return vec3(difference.x + difference.y, difference.zw);
#else
  return difference.xyz;
#endif
}

void countGuarded() {}  // normalise.comp.glsl has
