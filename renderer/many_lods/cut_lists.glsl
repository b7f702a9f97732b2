// SPDX-License-Identifier: BSD-3-Clause
// The lists of a multi-cut and what controls its steps. See listed_cuts.h.
#include "renderer/many_lods/many_lods_bindings.h"

layout(std430, binding = kCutListBuffer) buffer List { uvec2 list[]; };
layout(std430, binding = kCutControlBuffer) buffer Control {
  CutControl control;
  CutStep steps[];
};

#ifdef MARGINS
layout(std430, binding = kCutMarginsBuffer) buffer Margins { uint margins[]; };  // of the list's entries
#endif

uniform uint step_, capacity;

uint groupsFor(uint count, uint each) { return min((count + each - 1u) / each, uint(kMostCutGroups)); }
