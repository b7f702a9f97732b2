// SPDX-License-Identifier: BSD-3-Clause
// Whether depth images show that there is nothing in a voxel (Gaitatzes 2012, section 7.4.1): the surface that is seen where the
// voxel's middle is lies farther away than the middle, by more than a bias.
#include "renderer/incremental_voxels/depth_views.glsl"

uniform float viewBias[VIEWS];  // world units
uniform bool skyDisproves;      // pixels that see nothing see through the voxel

const int kDisproofStays = 0;     // hidden, beside the image, or behind the eye: unknown
const int kDisproofSurface = 1;   // within the bias of what is seen
const int kDisproofCleared = 2;   // nothing is there

int disproofOfPixel(int view, ivec2 pixel, float z) {
  const float depth = depthAt(view, pixel);
  if (!(depth > 0.0)) return skyDisproves ? kDisproofCleared : kDisproofStays;
  const float seen = viewNear[view] / depth;
  return z < seen - viewBias[view] ? kDisproofCleared : z > seen + viewBias[view] ? kDisproofStays : kDisproofSurface;
}

int disproofByView(int view, ivec3 voxel) {
  const vec3 middle = toView(view, vec3(voxel) + 0.5);
  if (!(middle.z > viewNear[view])) return kDisproofStays;
  const vec2 place = viewPlace(view, middle);
  if (!isInView(view, place)) return kDisproofStays;
  const int atCentre = disproofOfPixel(view, ivec2(place), middle.z);
#if PROOF == PROOF_CENTRE
  return atCentre;
#else
  if (atCentre != kDisproofCleared) return atCentre;
  // Half the extent of the voxel in the image; what reaches beside the image is not looked at.
  const mat3 sides = mat3(viewFromVoxels[view]);
  const vec2 tangent = middle.xy / middle.z;
  vec2 reach = vec2(0.0);
  for (int axis = 0; axis < 3; ++axis) reach += abs(sides[axis].xy - tangent * sides[axis].z);
  reach *= 0.5 / middle.z / viewExtent[view] * vec2(viewSizePx[view]);
  const ivec2 last = viewSizePx[view] - 1;
  const ivec2 low = clamp(ivec2(floor(place - reach)), ivec2(0), last), high = clamp(ivec2(floor(place + reach)), ivec2(0), last);
  const ivec2 steps = min(high - low, ivec2(kFootprintSteps));
  // Without leaving early, so that fetches wait for memory together; the last one is repeated where there are fewer.
  bool stays = false;
  for (int i = 0; i < (kFootprintSteps + 1) * (kFootprintSteps + 1); ++i) {
    const ivec2 at = min(ivec2(i % (kFootprintSteps + 1), i / (kFootprintSteps + 1)), steps);
    const int one = disproofOfPixel(view, low + ((high - low) * at) / max(steps, ivec2(1)), middle.z);
#if PROOF == PROOF_FOOTPRINT
    stays = stays || one != kDisproofCleared;
#else
    stays = stays || one == kDisproofSurface;
#endif
  }
  return stays ? kDisproofStays : kDisproofCleared;
#endif
}

bool isDisproved(ivec3 voxel) {
  for (int view = 0; view < USED_VIEWS; ++view)
    if (disproofByView(view, voxel) == kDisproofCleared) return true;
  return false;
}
