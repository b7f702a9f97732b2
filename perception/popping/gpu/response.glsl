// SPDX-License-Identifier: BSD-3-Clause
// Response of the vision model at a level of the contrast pyramid, for groups of 32 x 8 pixels. Call prepare() from
// all of them, then responseDifference().
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/gpu/masking.glsl"
#include "perception/popping/gpu/stages.glsl"
#ifdef TEMPORAL_CHANNELS
#include "perception/popping/gpu/temporal.glsl"
#endif

layout(local_size_x = kPoppingGroupX, local_size_y = kPoppingGroupY) in;

layout(binding = kResponseConesUnit) uniform sampler2DArray cones;          // or A, RG, YV of DKL space; layer: 0 actual, 1 predicted
// Sensitivities at a level's peak: lg v across, lg L down, levels one below the other.
layout(binding = kResponseSensitivitiesUnit) uniform sampler2D sensitivities;
layout(binding = kPoppingCountersBuffer, std430) buffer Counters { PoppingCounters counters; };
layout(binding = kMeanLuminanceBuffer, std430) readonly buffer Mean { float meanLuminance[2]; };

uniform int frameCount;  // 2; a uniform, so that both frames go through the same code, not through copies of it
uniform int level, adaptationLevel, adaptationSource, eyeMovement;
uniform vec2 evenTaps;  // of the upsampler: outer and centre weight at even pixels; odd ones have 1/2, 1/2
uniform vec3 luminanceOfCones;
uniform float epsilon, gain, greyGain, fixedLuminance, leastVelocity, degSPerPx;
struct TableGrid {
  ivec2 size;     // nodes of velocity and luminance
  vec2 low, per;  // log2 of the first node; nodes per octave
};
uniform TableGrid table;
#ifdef CASTLE_KINK
uniform float kinkRow, perAboveKink;  // of ResponseTableGrid
#endif
#ifdef FITTED_WEIGHTS
// Of parts and then levels: their contrasts times these add up to a contrast at the level's peak.
layout(binding = kResponsePartWeightsUnit) uniform sampler2D partWeights;
uniform TableGrid partTable;
#endif

const ivec2 kNeighbours = ivec2(kPoppingGroupX, kPoppingGroupY) / 2 + 2;  // pixels of the next level around a group
const int kNeighbourCount = kNeighbours.x * kNeighbours.y;
shared vec4 next[2 * kNeighbourCount];   // the next level
shared vec4 after[2 * kNeighbourCount];  // the one after it, at the next one's size
shared uint groupGuarded;
#ifdef FITTED_WEIGHTS
const ivec2 kOwn = ivec2(kPoppingGroupX, kPoppingGroupY) + 4;  // pixels of the level itself, two more on each side
const int kOwnCount = kOwn.x * kOwn.y;
shared vec4 ownLevel[2 * kOwnCount];
#endif

// Weights of pixels m - 1, m, m + 1 of the coarser level for a pixel at 2 m or 2 m + 1.
vec3 taps(int position) { return (position & 1) == 0 ? evenTaps.xyx : vec3(0.0, 0.5, 0.5); }

// Fills the shared levels. A neighbour beyond the edge is the one at the edge.
void prepare() {
  int index = int(gl_LocalInvocationIndex);
  if (index == 0) groupGuarded = 0u;
  ivec2 origin = ivec2(gl_WorkGroupID.xy) * ivec2(kPoppingGroupX, kPoppingGroupY) / 2 - 1;
  ivec2 nextSize = textureSize(cones, level + 1).xy, afterSize = textureSize(cones, level + 2).xy;
  for (int i = index; i < frameCount * kNeighbourCount; i += kPoppingGroupX * kPoppingGroupY) {
    int frame = i / kNeighbourCount, neighbour = i % kNeighbourCount;
    ivec2 place =
        clamp(origin + ivec2(neighbour % kNeighbours.x, neighbour / kNeighbours.x), ivec2(0), nextSize - 1);
    next[i] = texelFetch(cones, ivec3(place, frame), level + 1);
    vec3 across = taps(place.x), down = taps(place.y);
    ivec2 centre = place / 2;
    vec4 sum = vec4(0.0);
    for (int dy = -1; dy <= 1; ++dy) {
      vec4 row = vec4(0.0);
      for (int dx = -1; dx <= 1; ++dx)
        row += across[dx + 1] * texelFetch(cones, ivec3(clamp(centre + ivec2(dx, dy), ivec2(0), afterSize - 1), frame),
                                           level + 2);
      sum += down[dy + 1] * row;
    }
    after[i] = sum;
  }
#ifdef FITTED_WEIGHTS
  ivec2 corner = ivec2(gl_WorkGroupID.xy) * ivec2(kPoppingGroupX, kPoppingGroupY) - 2;
  ivec2 ownSize = textureSize(cones, level).xy;
  for (int i = index; i < frameCount * kOwnCount; i += kPoppingGroupX * kPoppingGroupY) {
    int frame = i / kOwnCount, pixel = i % kOwnCount;
    ivec2 place = clamp(corner + ivec2(pixel % kOwn.x, pixel / kOwn.x), ivec2(0), ownSize - 1);
    ownLevel[i] = texelFetch(cones, ivec3(place, frame), level);
  }
#endif
  barrier();
}

float retinalVelocity(float screenDegS) {
  float eye = min(0.82 * screenDegS + 0.15, 80.0);
  if (eyeMovement == EYE_MOVEMENT_LITERAL) return abs(screenDegS - eye);
  if (eyeMovement == EYE_MOVEMENT_FLOOR) return max(abs(screenDegS - eye), leastVelocity);
  if (eyeMovement == EYE_MOVEMENT_MONOTONE) return max(screenDegS - eye, leastVelocity);
  return screenDegS;
}

float luminanceOf(ivec3 texel, int from) { return dot(luminanceOfCones, texelFetch(cones, texel, from).xyz); }

float luminanceAt(int frame, ivec2 pixel) {
  if (adaptationSource == ADAPTATION_FIXED) return fixedLuminance;
  if (adaptationSource == ADAPTATION_MEAN) return meanLuminance[frame];
  int from = max(adaptationLevel, level), shift = from - level;
  ivec2 size = textureSize(cones, from).xy, first = pixel >> shift;
  vec2 weight = vec2(pixel - (first << shift)) / float(1 << shift);
  ivec2 second = min(first + 1, size - 1);
  first = min(first, size - 1);
  precise float above = mix(luminanceOf(ivec3(first, frame), from),
                            luminanceOf(ivec3(second.x, first.y, frame), from), weight.x);
  precise float below = mix(luminanceOf(ivec3(first.x, second.y, frame), from),
                            luminanceOf(ivec3(second, frame), from), weight.x);
  return mix(above, below, weight.y);
}

// Of block `block` of a table over velocity and luminance, at a place in nodes.
vec4 tableAtPlace(sampler2D values, TableGrid grid, vec2 place, int block) {
  place = clamp(place, vec2(0.0), vec2(grid.size - 1));
  ivec2 node = min(ivec2(place), grid.size - 2);
  vec2 t = place - vec2(node);
  node.y += block * grid.size.y;
  vec4 above = mix(texelFetch(values, node, 0), texelFetch(values, node + ivec2(1, 0), 0), t.x);
  vec4 below = mix(texelFetch(values, node + ivec2(0, 1), 0), texelFetch(values, node + ivec2(1, 1), 0), t.x);
  return mix(above, below, t.y);
}

vec4 tableAt(sampler2D values, TableGrid grid, float velocity, float luminance, int block) {
  return tableAtPlace(values, grid, (log2(vec2(velocity, luminance)) - grid.low) * grid.per, block);
}

// Of a table of ResponseTableGrid.
vec4 responseTableAt(sampler2D values, float velocity, float luminance, int block) {
  vec2 place = (log2(vec2(velocity, luminance)) - table.low) * table.per;
#ifdef CASTLE_KINK
  // ln(L / kink), where it is small without the rounding of L / kink.
  float beyond = (luminance - kPoppingKinkCdM2) / kPoppingKinkCdM2, z = beyond / (2.0 + beyond), zz = z * z;
  float ln = beyond < 0.4 ? 2.0 * z * (1.0 + zz * (1.0 / 3.0 + zz * (1.0 / 5.0 + zz * (1.0 / 7.0 + zz / 9.0))))
                          : log(luminance / kPoppingKinkCdM2);
  float share = ln / log(kPoppingKinkEndCdM2 / kPoppingKinkCdM2);
  if (share >= 1.0)
    place.y = kinkRow + float(kPoppingKinkNodes) + (log2(luminance) - log2(kPoppingKinkEndCdM2)) * perAboveKink;
  else if (share > 0.0)
    place.y = kinkRow + float(kPoppingKinkNodes) * pow(share, kPoppingKinkExponent);
#endif
  return tableAtPlace(values, table, place, block);
}

// Opponent contrasts from those of the planes.
vec3 opponentOf(vec3 cone) {
#ifdef CONTRAST_DKL
  return cone;
#else
  return vec3((2.0 * cone.x + cone.y + cone.z / 20.0) * (1.0 / greyGain),
              cone.x - 12.0 / 11.0 * cone.y + cone.z / 11.0, (cone.x + cone.y - 2.0 * cone.z) / 9.0);
#endif
}

const float kOnce[5] = float[](0.0, 0.25, 0.5, 0.25, 0.0);                // 1 2 1
const float kTwice[5] = float[](0.0625, 0.25, 0.375, 0.25, 0.0625);  // 1 2 1, twice

#ifdef STORE_NORMALISED
layout(binding = kNormalisedImage, rgba32f) uniform writeonly image2DArray normalisedImage;
#endif

// Response of the actual frame minus that of the predicted one, channels A, a, b.
vec3 responseDifference(ivec2 pixel, int shownFrame, out Stages shown) {
  ivec2 m = pixel / 2 - (ivec2(gl_WorkGroupID.xy) * ivec2(kPoppingGroupX, kPoppingGroupY) / 2 - 1);
  vec3 across = taps(pixel.x), down = taps(pixel.y);
  precise vec3 difference = vec3(0.0);
  uint guardedHere = 0u;
#ifdef TEMPORAL_CHANNELS
  vec3 contrasts[2];
  vec2 luminances;
  float screenDegS = 0.0;
  for (int frame = 0; frame < frameCount; ++frame)
    screenDegS += 0.5 * texelFetch(cones, ivec3(pixel, frame), level).w * degSPerPx;
  float retinalDegS = retinalVelocity(screenDegS);  // of the content of both frames
#endif
  for (int frame = 0; frame < frameCount; ++frame) {
    vec4 own = texelFetch(cones, ivec3(pixel, frame), level);
    precise vec3 finer = vec3(0.0);
    precise vec3 coarser = vec3(0.0);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        float weight = across[dx + 1] * down[dy + 1];
        int at = frame * kNeighbourCount + (m.y + dy) * kNeighbours.x + m.x + dx;
        finer = fma(vec3(weight), next[at].xyz, finer);
        coarser = fma(vec3(weight), after[at].xyz, coarser);
      }
#ifdef CONTRAST_DKL
    coarser = coarser.xxx;
#endif
    for (int c = 0; c < 3; ++c)
      if (!(coarser[c] >= epsilon)) ++guardedHere;
    vec3 denominator = max(coarser, vec3(epsilon));
    float luminance = luminanceAt(frame, pixel), velocity = retinalVelocity(own.w * degSPerPx);
#ifdef FITTED_WEIGHTS
    // Relative to the pixel's own value, which keeps the digits that parts of small contrast are made of.
    precise vec3 once = vec3(0.0);
    precise vec3 twice = vec3(0.0);
    precise vec3 coarserNext = vec3(0.0);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        int at = frame * kNeighbourCount + (m.y + dy) * kNeighbours.x + m.x + dx;
        coarserNext = fma(vec3(across[dx + 1] * down[dy + 1]), next[at].xyz - own.xyz, coarserNext);
      }
    ivec2 local = ivec2(gl_LocalInvocationID.xy) + 2;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) {
        vec3 value = ownLevel[frame * kOwnCount + (local.y + dy) * kOwn.x + local.x + dx].xyz - own.xyz;
        twice = fma(vec3(kTwice[dx + 2] * kTwice[dy + 2]), value, twice);
        once = fma(vec3(kOnce[dx + 2] * kOnce[dy + 2]), value, once);
      }
    vec3 weights[3];
    for (int part = 0; part < 3; ++part)
#ifdef TEMPORAL_CHANNELS
      weights[part] = tableAt(partWeights, partTable, retinalDegS, luminance, 3 * level + part).xyz;
#else
      weights[part] = tableAt(partWeights, partTable, velocity, luminance, 3 * level + part).xyz;
#endif
    precise vec3 atPeak = opponentOf(-once / denominator) * weights[0];
    atPeak = fma(opponentOf((once - twice) / denominator), weights[1], atPeak);
    atPeak = fma(opponentOf((twice - coarserNext) / denominator), weights[2], atPeak);
    precise vec3 normalised =
        atPeak * max(responseTableAt(sensitivities, velocity, luminance, level).xyz, vec3(LEAST_SENSITIVITY));
#ifdef TEMPORAL_CHANNELS
    contrasts[frame] = atPeak;
#endif
    vec3 contrast = opponentOf((own.xyz - finer) / denominator) * (1.0 / gain);
#else
    precise vec3 contrast = opponentOf((own.xyz - finer) / denominator) * (1.0 / gain);
    precise vec3 normalised = contrast * responseTableAt(sensitivities, velocity, luminance, level).xyz;
#ifdef TEMPORAL_CHANNELS
    contrasts[frame] = contrast;
#endif
#endif
#if defined(STORE_NORMALISED)
#ifndef TEMPORAL_CHANNELS
    imageStore(normalisedImage, ivec3(pixel, frame), vec4(normalised, 0.0));
#endif
#else
    precise vec3 response =
        vec3(transducer(normalised.x), transducer(normalised.y), transducer(normalised.z));
    difference = frame == 0 ? response : difference - response;
#endif
#ifdef SHOW_STAGES
    if (frame == shownFrame) shown = Stages(contrast, response, luminance, velocity);
#endif
#ifdef TEMPORAL_CHANNELS
    luminances[frame] = luminance;
#endif
  }
#ifdef TEMPORAL_CHANNELS
  SwitchContent contents[2];
  for (int frame = 0; frame < frameCount; ++frame) {
    vec4 steady = responseTableAt(steadyGains, retinalDegS, luminances[frame], level),
         onset = responseTableAt(onsetGains, retinalDegS, luminances[frame], level);
    contents[frame] = SwitchContent(contrasts[frame], steady, max(steady, onset));
  }
  SwitchExtremes extremes = switchExtremes(contents, holdBlur(max(0.0, screenDegS - retinalDegS)));
#ifdef STORE_NORMALISED
  imageStore(normalisedImage, ivec3(pixel, 0), extremes.after);
  imageStore(normalisedImage, ivec3(pixel, 1), extremes.before);
#else
  difference = switchDifference(extremes);
#endif
#endif
  if (guardedHere != 0u) atomicAdd(groupGuarded, guardedHere);
  return difference;
}

// Call from all of the group after responseDifference().
void countGuarded() {
  barrier();
  if (gl_LocalInvocationIndex == 0u && groupGuarded != 0u) atomicAdd(counters.guarded, groupGuarded);
}
