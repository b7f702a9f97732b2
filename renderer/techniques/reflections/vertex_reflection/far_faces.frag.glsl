// SPDX-License-Identifier: BSD-3-Clause
// What a reflector's centre sees of surfaces farther away than the distance at which vertices begin to fade.
#include "renderer/techniques/reflections/vertex_reflection/vertex_reflection_bindings.h"

uniform ivec2 sizePx;
uniform float fadeStart;
uniform uint reflectorFirst, reflectorCount;  // its own triangles are not in the map
#include "renderer/frame/shading.glsl"

in vec3 fromCentre;
uniform vec3 faceCentre;
flat in uint first;
layout(location = 0) out vec4 colour;

float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }

void main() {
  const uint id = first + uint(gl_PrimitiveID);
  if (length(fromCentre) < fadeStart || (id >= reflectorFirst && id - reflectorFirst < reflectorCount)) discard;
  const uvec3 corners = sceneTriangle(id);
  const vec3 weights = barycentrics(scenePosition(corners.x), scenePosition(corners.y), scenePosition(corners.z),
                                    faceCentre + fromCentre);
  colour = vec4(pointColour(surfaceHit(id, weights, normalize(fromCentre)), 1.0), 1.0);
}
