// SPDX-License-Identifier: BSD-3-Clause
// Scans over whole arrays. See scan.h. NUMBER: uint or float; OPERATION; IDENTITY, bits of the operator's. One of LOAD, DOUBLING
// (a step of Hillis and Steele), UP and DOWN (steps of Blelloch), STORE.
#include "renderer/compute/reduction_bindings.h"

layout(local_size_x = kScanStepGroup) in;

layout(std430, binding = kScanInBuffer) readonly buffer In { NUMBER values[]; };
layout(std430, binding = kScanOutBuffer) writeonly buffer Out { NUMBER results[]; };
#if defined(UP) || defined(DOWN)
layout(std430, binding = kScanToBuffer) buffer To { NUMBER to[]; };
#else
layout(std430, binding = kScanFromBuffer) readonly buffer From { NUMBER from[]; };
layout(std430, binding = kScanToBuffer) writeonly buffer To { NUMBER to[]; };
#endif

uniform uint count, padded, distance_;
uniform int shift;  // STORE: < 0: results are made exclusive; > 0: inclusive

#if OPERATION == OPERATION_ADD
NUMBER joined(NUMBER a, NUMBER b) { return a + b; }
#elif OPERATION == OPERATION_MULTIPLY
NUMBER joined(NUMBER a, NUMBER b) { return a * b; }
#elif OPERATION == OPERATION_MINIMUM
NUMBER joined(NUMBER a, NUMBER b) { return min(a, b); }
#else
NUMBER joined(NUMBER a, NUMBER b) { return max(a, b); }
#endif

NUMBER identity() {
#ifdef FLOATS
  return uintBitsToFloat(IDENTITY);
#else
  return IDENTITY;
#endif
}

void main() {
  const uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kScanStepGroup) + gl_LocalInvocationIndex;
#ifdef LOAD
  if (i < padded) to[i] = i < count ? values[i] : identity();
#elif defined(DOUBLING)
  if (i >= padded) return;
  NUMBER sum = from[i];
  if (i >= distance_) sum = joined(from[i - distance_], sum);
  to[i] = sum;
#elif defined(UP)
  const uint right = (i + 1u) * 2u * distance_ - 1u;
  if (right < padded) to[right] = joined(to[right - distance_], to[right]);
#elif defined(DOWN)
  const uint right = (i + 1u) * 2u * distance_ - 1u;
  if (right >= padded) return;
  // The root receives the identity: nothing lies before the whole array.
  const NUMBER before = 2u * distance_ == padded ? identity() : to[right];
  const NUMBER left = to[right - distance_];
  to[right - distance_] = before;
  to[right] = joined(before, left);
#else
  if (i >= count) return;
  if (shift < 0)
    results[i] = i == 0u ? identity() : from[i - 1u];
  else if (shift > 0)
    results[i] = joined(from[i], values[i]);
  else
    results[i] = from[i];
#endif
}
