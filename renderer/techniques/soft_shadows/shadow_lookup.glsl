// SPDX-License-Identifier: BSD-3-Clause
// What every soft-shadow shader shares: the receiver points, the map's frustum, biases, and where results go.
// VisibilityPass binds all of it.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/frame/shadow_depth.glsl"

// IN_SHADING: within a pass that shades, which finds the receivers itself and calls visibilityOf().
#ifndef IN_SHADING
layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReceiversUnit) uniform sampler2D receivers;
layout(binding = kVisibilityImage, r32f) uniform writeonly image2D outVisibility;
#endif
#ifdef COUNT
layout(binding = kCountsImage, rgba32ui) uniform uimage2D outCounts;
layout(binding = kSearchImage, rgba32ui) uniform writeonly uimage2D outSearch;
#endif

uniform ivec2 sizePx;
// x/z, y/z at the map's lower edge, and the map's extents. MAP_LAYERS: of the layer of a map that is read at present, one of
// several that are read together.
#if MAP_LAYERS > 1
uniform vec2 layerTangentLow[MAP_LAYERS], layerTangentSize[MAP_LAYERS];
int mapLayer = 0;
vec2 tangentLow = vec2(0.0), tangentSize = vec2(1.0);
void readLayer(int layer) {
  mapLayer = layer;
  tangentLow = layerTangentLow[layer];
  tangentSize = layerTangentSize[layer];
}
#else
uniform vec2 tangentLow, tangentSize;
#endif
uniform float near;
uniform vec2 lightSize;  // full extents
uniform vec2 eyeOnLight;  // place that the map is seen from and receivers are relative to, in unit light coordinates
uniform int resolution;
uniform float bias, slopeBias, maxSlope;

#include "renderer/techniques/soft_shadows/pixel_class.h"

// Classes and work of this pixel; the compiler removes them where nobody counts. A level that lies between two stands for
// both.
uint pixelClass = kNotReceiver, occluderCount = 0u, fetchCount = 0u;
float levelUsed = 0.0;
// Texels of level 0 in the search area; micro-occluders that were looked at, and those that covered any of the light.
uint areaTexels = 0u, examinedCount = 0u, usedCount = 0u;

// Position of a point in the map, in texels of level 0.
vec2 mapTexel(vec2 tangent) { return (tangent - tangentLow) / tangentSize * float(resolution); }

// Slope of the receiver's plane, for biases. At grazing light it has no bound, and a bias that followed it would let light
// through whatever lies near.
float boundedSlope(vec4 receiver) { return min(receiver.w, maxSlope * receiver.z); }

#if (defined(BIAS_PLANE) || defined(BIAS_NORMAL_OFFSET)) && !defined(IN_SHADING)
layout(binding = kReceiverPlanesUnit) uniform sampler2D receiverPlanes;
#endif
#ifdef BIAS_PLANE
vec2 receiverPlane = vec2(0.0);  // of this pixel, see receiver_plane.glsl
// EYE_OFF_CENTRE: the map's eye may lie behind the receiver's plane. What lies before the plane as seen from the light is
// beyond it then, as seen from the eye.
#ifdef EYE_OFF_CENTRE
bool eyeIsBehind = false;
#else
const bool eyeIsBehind = false;
#endif
#endif

#ifdef BIAS_NORMAL_OFFSET
uniform float normalOffset;  // texels of level 0
// The receiver off its surface. With g = n.xy / (n . p / p_z), as in receiver_plane.glsl, n is (g, 1 - g . p.xy / p_z) up to a
// negative factor.
vec4 movedOff(vec4 receiver, vec2 plane) {
  const vec3 ray = vec3(receiver.xy / receiver.z, 1.0);
  const vec3 n = -normalize(vec3(plane, 1.0 - dot(plane, ray.xy)));
  const float cosine = dot(n, normalize(ray)), sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution) * receiver.z;
  return vec4(receiver.xyz + min(normalOffset * texel * sine, 0.5 * receiver.z) * n, receiver.w);
}
#endif

#ifdef IN_SHADING
// Makes a receiver, with the gradient of its plane, the one that is looked up.
vec4 takeReceiver(vec4 receiver, vec2 plane) {
#ifdef BIAS_PLANE
  receiverPlane = plane;
#endif
#ifdef BIAS_NORMAL_OFFSET
  return receiver.w < 0.0 ? receiver : movedOff(receiver, plane);
#else
  return receiver;
#endif
}
#else
// The receiver of a pixel; w < 0: none.
vec4 loadReceiver(ivec2 pixel) {
#ifdef BIAS_PLANE
  receiverPlane = texelFetch(receiverPlanes, pixel, 0).xy;
#endif
  const vec4 receiver = texelFetch(receivers, pixel, 0);
#if defined(BIAS_PLANE) && defined(EYE_OFF_CENTRE)
  eyeIsBehind = receiver.w > 1.5e6 * receiver.z;
#endif
#ifdef BIAS_NORMAL_OFFSET
  return receiver.w < 0.0 ? receiver : movedOff(receiver, texelFetch(receiverPlanes, pixel, 0).xy);
#else
  return receiver;
#endif
}
#endif

// Depth that a blocker must undercut to count, for texels of the given level: a constant share of the distance plus the
// change of the receiver's own plane over `slopeBias` texels (the slope sums both axes). BIAS_BY_LEVEL: a constant that grows
// with the level by a factor, instead. BIAS_STORED: texels bring what they need beyond the constant (blocks()). BIAS_PLANE:
// a blocker must lie before the receiver's own plane besides (beforePlane()). BIAS_NORMAL_OFFSET: the receiver has been moved.
#ifdef BIAS_BY_LEVEL
uniform float biasGrowth;
#endif
float biasedDepth(vec4 receiver, int level) {
#if defined(BIAS_BY_LEVEL)
  float share = bias;
  for (int i = 0; i < level; ++i) share *= biasGrowth;
  return receiver.z - share * receiver.z;
#elif defined(BIAS_STORED) || defined(BIAS_PLANE) || defined(BIAS_NORMAL_OFFSET)
  return receiver.z - bias * receiver.z;
#else
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution) * float(1 << level);
  return receiver.z - bias * receiver.z - slopeBias * boundedSlope(receiver) * texel;
#endif
}

#ifdef BIAS_PLANE
// Share of the receiver's depth by which a depth must undercut its plane: the constant, and the change of the plane over
// `texels` on both axes, which `maxSlope` bounds.
float planeMargin(float texels) {
  const vec2 perTexel = tangentSize / float(resolution);
  return bias + texels * min(dot(abs(receiverPlane), perTexel), maxSlope * max(perTexel.x, perTexel.y));
}

// Whether depth z at a place of the map, in texels of level 0, lies before the receiver's plane. `limit` = p_z (1 - margin).
bool beforePlane(float z, vec2 place, vec4 receiver, float limit) {
  const vec2 away = tangentLow + place * (tangentSize / float(resolution)) - receiver.xy / receiver.z;
  const float scaled = z * (1.0 + dot(receiverPlane, away));
  return eyeIsBehind ? scaled > 2.0 * receiver.z - limit : scaled < limit;
}

// Whether some of the light's rectangle is behind the receiver's plane.
bool planeCutsLight(vec4 receiver) {
  const vec2 perUnit = receiverPlane * lightSize;
  const float middle = dot(perUnit, 0.5 - eyeOnLight), reach = 0.5 * (abs(perUnit.x) + abs(perUnit.y));
  return eyeIsBehind ? middle - reach < receiver.z : middle + reach > receiver.z;
}
#endif

#ifndef IN_SHADING
void store(ivec2 pixel, float visibility) {
  imageStore(outVisibility, pixel, vec4(visibility));
#ifdef COUNT
  imageStore(outCounts, pixel, uvec4(pixelClass, occluderCount, fetchCount, uint(ceil(levelUsed))));
  imageStore(outSearch, pixel, uvec4(areaTexels, examinedCount, usedCount, floatBitsToUint(levelUsed)));
#endif
}
#endif

float visibilityOf(vec4 receiver, ivec2 pixel);

// Techniques that split their work into passes have entry points of their own.
#if !defined(SPLIT_CLASSIFY) && !defined(SPLIT_GATHER) && !defined(LEVEL_STEPS) && !defined(IN_SHADING)
void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 receiver = loadReceiver(pixel);
  store(pixel, receiver.w < 0.0 ? 1.0 : visibilityOf(receiver, pixel));
}
#endif
