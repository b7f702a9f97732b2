// SPDX-License-Identifier: BSD-3-Clause
// How far each view and the tree have moved since cuts were last found: x: eye and nodes towards or from each other, y: and anything in
// the view across it, which the view's turning adds to. World units, rounded up.
#include "renderer/many_lods/many_lods_bindings.h"

layout(local_size_x = kCutGroup) in;
layout(std430, binding = kCutNodesBuffer) readonly buffer Nodes { vec4 nodes[]; };
layout(std430, binding = kCutViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kMotionLastViewsBuffer) buffer LastViews { LastView lastViews[]; };
layout(std430, binding = kMotionTravelBuffer) readonly buffer Travel { TreeTravel travel; };
layout(std430, binding = kCutMotionsBuffer) writeonly buffer Motions { vec2 motions[]; };

uniform uint viewCount;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= viewCount) return;
  const CutView now = views[i], before = lastViews[i].view;
  const float centres = float(travel.centres - lastViews[i].centres), radii = float(travel.radii - lastViews[i].radii);
  lastViews[i].view = now;
  lastViews[i].centres = travel.centres;
  lastViews[i].radii = travel.radii;
  const bool isAlike = now.eye.w == before.eye.w && now.axisX.w == before.axisX.w && now.axisY.w == before.axisY.w &&
                       now.axisZ.w == before.axisZ.w && now.frustum.xy == before.frustum.xy;
  // A sphere's size is q >= 1 radii.
  const float by = distance(now.eye.xyz, before.eye.xyz) + centres + sqrt(now.eye.w) * radii;
  float turned = distance(now.axisZ.xyz, before.axisZ.xyz);
  if (now.axisZ.w != float(kViewHemisphere))
    turned += distance(now.axisX.xyz, before.axisX.xyz) + distance(now.axisY.xyz, before.axisY.xyz);
  const float reach = distance(nodes[kRootNode].xyz, now.eye.xyz) + nodes[kRootNode].w + by;
  // What gives way in a test for culling moves by less than 1e-4 of this; roundings are smaller still.
  const float most = 1.0002;
  motions[i] = isAlike ? most * vec2(by, by + reach * turned) : vec2(uintBitsToFloat(0x7f800000u));
}
