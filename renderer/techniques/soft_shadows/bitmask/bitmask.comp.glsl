// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#include "renderer/techniques/soft_shadows/occluder_search.glsl"
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"

void clearGathered() { clearMask(); }
void accumulate(vec2 low, vec2 high) { addToMask(low, high); }
bool isSaturated() { return allCovered(); }
float gatheredVisibility() { return 1.0 - float(samplesCovered()) / float(SAMPLES); }
