// SPDX-License-Identifier: BSD-3-Clause
// What a pixel of the reflector sees of a reflected triangle, lit as the reflector sees it (Roger 2008, section 2.2.3).
// Depth is the length of the path from the reflector on; the reflector's back faces hide what is reflected behind them.
#include "renderer/techniques/reflections/vertex_reflection/vertex_reflection_bindings.h"

layout(binding = kReflectorBacksUnit) uniform sampler2D backs;
layout(binding = kReflectorIdsUnit) uniform usampler2D seenTriangles;
layout(std430, binding = kReflectedSourcesBuffer) readonly buffer Sources { uint sources[]; };

uniform ivec2 sizePx;
uniform uint reflectorFirst, reflectorCount;  // its triangles
uniform uint firstTriangle;                   // of the draw
uniform float farthest;                       // path length that depth 1 stands for
uniform float backSlack;                      // share of the depth
uniform vec2 farFade;                         // distances from the centre at which the environment map starts and takes over
uniform vec3 fadeCentre;
#include "renderer/frame/shading.glsl"

in vec3 reflectedPosition, reflectionPoint;
in float pathLength, validity;
layout(location = 0) out vec4 colour;

float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  // A corner without a reflection takes the whole triangle with it: 1 only where all three are 1.
  if (!(validity > 0.99999)) discard;
  const uint seenId = texelFetch(seenTriangles, pixel, 0).x;
  if (seenId < reflectorFirst || seenId - reflectorFirst >= reflectorCount) discard;
#ifdef HIDE_BEHIND_BACKS
  if (gl_FragCoord.z < texelFetch(backs, pixel, 0).x * (1.0 - backSlack)) discard;
#endif
  const float fade = farFade.y > 0.0 ? 1.0 - smoothstep(farFade.x, farFade.y, length(reflectedPosition - fadeCentre)) : 1.0;
  if (fade <= 0.0) discard;
#ifdef DEPTH_OF_FRAGMENT
  const float path = length(reflectedPosition - reflectionPoint);
#else
  const float path = pathLength;
#endif
  gl_FragDepth = clamp(path / farthest, 0.0, 1.0);
  const uint id = sources[firstTriangle + uint(gl_PrimitiveID)];
  const uvec3 corners = sceneTriangle(id);
  const vec3 weights = barycentrics(scenePosition(corners.x), scenePosition(corners.y), scenePosition(corners.z),
                                    reflectedPosition);
#ifdef LIT_AS_FROM_EYE
  const vec3 from = eye;
#else
  const vec3 from = reflectionPoint;
#endif
  const vec3 towards = reflectedPosition - from;
  const vec3 direction = dot(towards, towards) > 0.0 ? normalize(towards) : vec3(0.0, -1.0, 0.0);
  colour = vec4(fade * pointColour(surfaceHit(id, weights, direction), 1.0), fade);
}
