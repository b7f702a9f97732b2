// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#include "renderer/techniques/soft_shadows/occluder_search.glsl"
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"
#if OCCLUDERS == 1 || OCCLUDERS == 2
#include "renderer/techniques/soft_shadows/bitmask/quad_mask.glsl"
void accumulateQuad(vec2 a, vec2 b, vec2 c, vec2 d) { addQuadToMask(a, b, c, d); }
#endif

void clearGathered() { clearMask(); }
void accumulate(vec2 low, vec2 high) { addToMask(low, high); }
bool isSaturated() { return allCovered(); }
float gatheredVisibility() { return 1.0 - float(samplesCovered()) / float(SAMPLES); }
