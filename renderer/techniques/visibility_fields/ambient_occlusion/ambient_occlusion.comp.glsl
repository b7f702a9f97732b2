// SPDX-License-Identifier: BSD-3-Clause
// Mean visibility over a pixel's rays, their distances looked up in the objects' fields.
#include "renderer/techniques/visibility_fields/occlusion_rays.glsl"
#include "renderer/techniques/visibility_fields/object_lookup.glsl"
#include "renderer/techniques/visibility_fields/near_receivers/near_list.glsl"
#include "renderer/techniques/visibility_fields/doubtful_rays/doubtful_list.glsl"

layout(binding = kFieldOutImage, rgba32f) uniform image2D outImage;
uniform uint passObject;  // of a pass for each object

float seenAt(float distance) { return visibilityAt(distance); }

float openShareOf(FieldReceiver receiver, OcclusionFrame frame, uint object) {
  float open = 0.0;
#if FIELD_FETCH == 0
  for (int i = 0; i < raySide * raySide; ++i) open += countedRay(i, seenPast(receiver, object, occlusionDirection(frame, i)));
#else
  // In the object's axes once for all rays.
  const FieldObject of = fieldObjects[object];
  const FieldView view = fieldView(of, receiver.origin, slackOf(receiver, of));
  const OcclusionFrame own = OcclusionFrame(fieldToObject(of, frame.x), fieldToObject(of, frame.y), fieldToObject(of, frame.z), frame.within);
  for (int i = 0; i < raySide * raySide; ++i) open += countedRay(i, fieldSeen(view, occlusionDirection(own, i)));
#endif
  return open / float(raySide * raySide);
}

float openShare(FieldReceiver receiver, OcclusionFrame frame) {
#if COMBINE == 0
  if (fieldObjectCount == 1u) return canBlock(receiver, 0u) ? openShareOf(receiver, frame, 0u) : 1.0;
  float open = 0.0;
  for (int i = 0; i < raySide * raySide; ++i) open += countedRay(i, seenPastAll(receiver, occlusionDirection(frame, i)));
  return open / float(raySide * raySide);
#else
  float open = 1.0;
  for (uint object = 0u; object < fieldObjectCount; ++object) {
    if (!canBlock(receiver, object)) continue;
#if COMBINE == 1
    open *= openShareOf(receiver, frame, object);
#else
    open -= 1.0 - openShareOf(receiver, frame, object);
#endif
  }
  return max(open, 0.0);
#endif
}

void main() {
  makeRayTable();
  beginRays();
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, sizePx))) {
    FieldReceiver receiver;
    const bool shown = fieldReceiver(pixel, receiver);
#if COMBINE == 3
    // GL_FUNC_REVERSE_SUBTRACT: what is there less what this object hides.
    float open = passObject == 0u ? 1.0 : imageLoad(outImage, pixel).x;
    if (shown && passObject < fieldObjectCount && canBlock(receiver, passObject))
      open = max(open - (1.0 - openShareOf(receiver, occlusionFrame(pixel, receiver), passObject)), 0.0);
#else
    const float open = shown ? openShare(receiver, occlusionFrame(pixel, receiver)) : 1.0;
#endif
    imageStore(outImage, pixel, vec4(vec3(open), 1.0));
    listIfNear(pixel);
    countLookUps(pixel);
  }
  endRays(pixel);
}
