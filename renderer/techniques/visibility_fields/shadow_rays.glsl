// SPDX-License-Identifier: BSD-3-Clause
// Rays from a receiver to points of a light, the same for fields and for tracers. Set up by LightRays::configure().
#include "renderer/techniques/visibility_fields/field_receiver.glsl"

layout(binding = kFieldReceiversUnit) uniform sampler2D receivers;  // in light space; w < 0: the light does not reach it
uniform int raySide, turned, lightForm;
uniform uint seed;
uniform vec3 lightCentre, lightX, lightY;  // relative to the anchor; half the extents of a rectangle
uniform float lightRadius;                 // of a sphere

bool isLit(ivec2 pixel) { return texelFetch(receivers, pixel, 0).w >= 0.0; }

// Of the light: in cell `cell`, at its middle or the pixel's place in it or, turned, anywhere.
vec3 lightPoint(ivec2 pixel, FieldReceiver receiver, ivec2 cell) {
  const vec2 within = turned == 0 ? placeInCell(pixel) : pixelPlace(pixel, uint(cell.y * raySide + cell.x), seed);
  const vec2 place = (vec2(cell) + within) / float(raySide);
  if (lightForm == kLightRectangle) {
    const vec2 p = 2.0 * place - 1.0;
    return lightCentre + p.x * lightX + p.y * lightY;
  }
  // The sphere as the receiver sees it: a disc about its centre, across the line of sight.
  const vec3 away = lightCentre - receiver.origin, z = normalize(away);
  const vec2 disc = fieldConcentricDisc(place);
  return lightCentre + lightRadius * (disc.x * fieldTangent(z) + disc.y * fieldBitangent(z));
}
