// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#include "renderer/techniques/soft_shadows/occluder_search.glsl"

float occludedArea = 0.0;

void clearGathered() {}
void accumulate(vec2 low, vec2 high) { occludedArea += (high.x - low.x) * (high.y - low.y); }
bool isSaturated() { return occludedArea >= 1.0; }
float gatheredVisibility() { return 1.0 - min(occludedArea, 1.0); }
