// SPDX-License-Identifier: BSD-3-Clause
// The list of pixels whose rays found an object too near for its field (NearReceivers). NEAR_LIST; otherwise there is none.
#ifdef NEAR_LIST
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
layout(std430, binding = kNearListBuffer) buffer NearList {
  NearListHeader nearList;
  uint nearPixels[];
};
#endif

void listIfNear(ivec2 pixel) {
#ifdef NEAR_LIST
  if (fieldNear) nearPixels[atomicAdd(nearList.pixels, 1u)] = uint(pixel.x) | uint(pixel.y) << 16;
#endif
}
