// SPDX-License-Identifier: BSD-3-Clause
// Works one channel of the G-buffer out of the triangle that each pixel sees.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/frame/seen_point.glsl"
#ifdef CHANNEL_ALBEDO
#include "renderer/frame/surface_buffers.glsl"
#endif

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kGBufferIdsUnit) uniform usampler2D triangleIds;
layout(binding = kGBufferOutImage, OUT_FORMAT) uniform writeonly image2D outImage;
#ifdef CHANNEL_RECEIVER
#include "renderer/frame/receiver.glsl"
layout(binding = kGBufferPlanesImage, rg32f) uniform writeonly image2D outPlanes;
#endif

uniform mat4 anchorToCamera, cameraToAnchor;
uniform vec2 rayScale;  // half the image's extents at distance 1
uniform ivec2 sizePx, pictureSizePx;
#ifdef GIVEN_PLACES
layout(binding = kGBufferPlacesUnit) uniform sampler2D places;
#endif

const uint kNone = 0xffffffffu;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
#ifdef CHANNEL_RECEIVER
  vec4 result = vec4(0.0, 0.0, 0.0, -1.0);
  vec2 plane = vec2(0.0);
#else
  vec4 result = vec4(0.0);
#endif
  if (id != kNone) {
#ifdef CHANNEL_ALBEDO
    result = vec4(surfaceMaterials[surfaceMaterialOf[id]].albedo, 1.0);
#else
    const uvec3 vertices = sceneTriangle(id);
    const vec3 a = (anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz;
    const vec3 b = (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz;
    const vec3 c = (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz;
#ifdef GIVEN_PLACES
    const vec2 place = texelFetch(places, pixel, 0).xy;
#else
    const vec2 place = vec2(pixel) + 0.5;
#endif
    const SeenPoint seen = pointSeen(a, b, c, placeRay(place, rayScale, pictureSizePx));
    const vec3 normal = seen.normal, position = seen.position;
    const float depth = seen.depth;
#ifdef CHANNEL_POSITION
    result = vec4((cameraToAnchor * vec4(position, 1.0)).xyz, 1.0);
#endif
#ifdef CHANNEL_NORMAL
    result = vec4(mat3(cameraToAnchor) * normal, 1.0);
#endif
#ifdef CHANNEL_DEPTH
    result = vec4(depth);
#endif
#ifdef CHANNEL_RECEIVER
    result = receiverAt(position, normal, plane);
#endif
#endif
  }
  imageStore(outImage, pixel, result);
#ifdef CHANNEL_RECEIVER
  imageStore(outPlanes, pixel, vec4(plane, 0.0, 0.0));
#endif
}
