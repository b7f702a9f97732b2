// SPDX-License-Identifier: BSD-3-Clause
// Main step (Holländer 2013, section 2.2.3) in compute. The first work groups make the vertices at corners of patches, the next
// those along fine edges, each from the patch that is its source; all others those inside patches, LANES invocations a patch and four
// rows an invocation: control vertices lie in shared memory, weights of four rows come in one read, and vertices go out
// through shared memory, so that neighbouring invocations write neighbouring bytes.
#include "renderer/techniques/tessellation/tessellation_bindings.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"

#ifndef LANES
#define LANES 32
#endif
#ifndef PATCHES
#define PATCHES 1
#endif
#ifndef STAGED
#define STAGED 1
#endif
#ifndef BATCH
#define BATCH 1
#endif
#ifndef PART
#define PART 0
#endif
#ifndef BORDER_LAST
#define BORDER_LAST 0
#endif
layout(local_size_x = LANES, local_size_y = PATCHES) in;
layout(std430, binding = kSubdivisionPatchesBuffer) readonly buffer Patches { uvec4 patches[]; };  // MeshPatch
layout(std430, binding = kSubdivisionPointsBuffer) readonly buffer Points { uint points[]; };
layout(std430, binding = kSubdivisionTablesBuffer) readonly buffer Weights { float weights[]; };
layout(std430, binding = kSubdivisionTablesBuffer) readonly buffer WeightsOfFour { vec4 weightsOfFour[]; };
layout(std430, binding = kSubdivisionSourcesBuffer) readonly buffer Sources { uvec2 sources[]; };
layout(std430, binding = kControlsBuffer) readonly buffer Controls { vec4 controls[]; };  // ControlVertex
layout(std430, binding = kFineVerticesBuffer) writeonly buffer FineVertices { uvec4 fineVertices[]; };  // TessellatedVertex

uniform uint rows;           // of a table, a multiple of 4
uniform uint innerRows;      // the first ones of a table
uniform uint firstBorderRow;
uniform uint tangentStride;  // GEOMETRY_NORMALS: from weights of positions to those of a tangent, and on to the other's
uniform uint cornerGroups, edgeGroups, cornerCount, edgeCount, patchCount;
uniform int level;  // 2^level segments a side
uniform uint material;

vec3 unitNormal(vec3 v) {
#ifdef GEOMETRY_NORMALS
  v /= max(max(abs(v.x), max(abs(v.y), abs(v.z))), 1e-30);  // a product of two tangents, whose square may vanish
#endif
  const float size = dot(v, v);
  return size > 1e-30 ? v * inversesqrt(size) : vec3(0.0, 0.0, 1.0);
}

struct Point {
  vec3 position, normal;
};

Point pointAt(uvec4 head, uint row) {
  precise vec3 position = vec3(0.0);
  vec3 normal = vec3(0.0), other = vec3(0.0);
  for (uint first = 0u; first < head.y; first += 4u) {  // four at a time: their latencies overlap
    vec3 p[4], n[4];
    float w[4];
    for (uint i = 0u; i < 4u; ++i) {
      const uint slot = min(first + i, head.y - 1u), point = points[head.x + slot];
      w[i] = first + i < head.y ? weights[head.z + slot * rows + row] : 0.0;
      p[i] = controls[2u * point].xyz;
#ifndef GEOMETRY_NORMALS
      n[i] = controls[2u * point + 1u].xyz;
#endif
    }
    for (uint i = 0u; i < 4u; ++i) {
      position = fma(vec3(w[i]), p[i], position);
#ifndef GEOMETRY_NORMALS
      normal += w[i] * n[i];
#else
      if (first + i >= head.y) continue;
      const uint at = head.z + (first + i) * rows + row + tangentStride;
      normal += weights[at] * p[i];
      other += weights[at + tangentStride] * p[i];
#endif
    }
  }
#ifdef GEOMETRY_NORMALS
  normal = cross(normal, other);
#endif
  return Point(position, unitNormal(normal));
}

// Patch and row of an end of a source: 4 patch + corner.
uvec2 cornerRow(uint source) {
  return uvec2(source >> 2, firstBorderRow + uint(CORNERS) * ((1u << level) - 1u) + (source & 3u));
}

// 8 patch + 2 side + (1: the other way).
uvec2 edgeRow(uint source, uint along) {
  const uint n = 1u << level;
  return uvec2(source >> 3, firstBorderRow + (source >> 1 & 3u) * (n - 1u) + ((source & 1u) != 0u ? n - along : along) - 1u);
}

void writeBorder(uint target, uvec2 ofPosition, uvec2 ofNormal) {
  Point point = pointAt(patches[ofPosition.x], ofPosition.y);
  if (ofNormal != ofPosition) point.normal = pointAt(patches[ofNormal.x], ofNormal.y).normal;  // a sharp edge has two
  fineVertices[2u * target] = uvec4(floatBitsToUint(point.position), material);
  fineVertices[2u * target + 1u] = uvec4(floatBitsToUint(point.normal), kRungField);
}

shared vec4 near[PATCHES][2 * SLOTS];
shared uvec4 made[PATCHES][8 * LANES];

// Eight reads or writes of an invocation's four vertices meet in other banks than its neighbours'.
uint placeOf(uint k) { return k ^ (k >> 3 & 7u); }

void writeInner(uint number) {
  const uint lane = gl_LocalInvocationID.x, own = gl_LocalInvocationID.y;
  const uvec4 head = patches[number];
  for (uint i = lane; i < head.y; i += uint(LANES)) {
    const uint point = points[head.x + i];
    near[own][2u * i] = controls[2u * point];
    near[own][2u * i + 1u] = controls[2u * point + 1u];
  }
  barrier();
  const uint fours = (innerRows + 3u) / 4u, stride = rows / 4u, target = 2u * (cornerCount + edgeCount * ((1u << level) - 1u) + number * innerRows);
  for (uint first = 0u; first < fours; first += uint(LANES)) {
    const uint four = min(first + lane, fours - 1u);
    precise vec3 p0 = vec3(0.0), p1 = vec3(0.0), p2 = vec3(0.0), p3 = vec3(0.0);
    vec3 n0 = vec3(0.0), n1 = vec3(0.0), n2 = vec3(0.0), n3 = vec3(0.0);
#ifdef GEOMETRY_NORMALS
    vec3 b0 = vec3(0.0), b1 = vec3(0.0), b2 = vec3(0.0), b3 = vec3(0.0);
#endif
    uint at = head.z / 4u + four;
#if PART == 3
#define WEIGHT(at) vec4(0.25)
#else
#define WEIGHT(at) weightsOfFour[at]
#endif
#if BATCH > 1
    uint s = 0u;
    for (; s + uint(BATCH) <= head.y; s += uint(BATCH), at += uint(BATCH) * stride) {
      vec4 w[BATCH];
      for (uint i = 0u; i < uint(BATCH); ++i) w[i] = WEIGHT(at + i * stride);
      for (uint i = 0u; i < uint(BATCH); ++i) {
        const vec3 p = near[own][2u * (s + i)].xyz, n = near[own][2u * (s + i) + 1u].xyz;
        p0 = fma(vec3(w[i].x), p, p0);
        p1 = fma(vec3(w[i].y), p, p1);
        p2 = fma(vec3(w[i].z), p, p2);
        p3 = fma(vec3(w[i].w), p, p3);
        n0 += w[i].x * n, n1 += w[i].y * n, n2 += w[i].z * n, n3 += w[i].w * n;
      }
    }
    for (; s < head.y; ++s, at += stride) {
#else
    for (uint s = 0u; s < head.y; ++s, at += stride) {
#endif
      const vec4 w = WEIGHT(at);
      const vec3 p = near[own][2u * s].xyz;
      p0 = fma(vec3(w.x), p, p0);
      p1 = fma(vec3(w.y), p, p1);
      p2 = fma(vec3(w.z), p, p2);
      p3 = fma(vec3(w.w), p, p3);
#ifdef GEOMETRY_NORMALS
      const vec4 a = weightsOfFour[at + tangentStride / 4u], b = weightsOfFour[at + tangentStride / 2u];
      n0 += a.x * p, n1 += a.y * p, n2 += a.z * p, n3 += a.w * p;
      b0 += b.x * p, b1 += b.y * p, b2 += b.z * p, b3 += b.w * p;
#else
      const vec3 n = near[own][2u * s + 1u].xyz;
      n0 += w.x * n, n1 += w.y * n, n2 += w.z * n, n3 += w.w * n;
#endif
    }
#ifdef GEOMETRY_NORMALS
    n0 = cross(n0, b0), n1 = cross(n1, b1), n2 = cross(n2, b2), n3 = cross(n3, b3);
#endif
#if PART == 4
    if (p0.x + p1.x + p2.x + p3.x + n0.x + n1.x + n2.x + n3.x != 1e30) continue;
#endif
#if STAGED
    const uint k = 8u * lane;
    made[own][placeOf(k)] = uvec4(floatBitsToUint(p0), material);
    made[own][placeOf(k + 1u)] = uvec4(floatBitsToUint(unitNormal(n0)), kRungField);
    made[own][placeOf(k + 2u)] = uvec4(floatBitsToUint(p1), material);
    made[own][placeOf(k + 3u)] = uvec4(floatBitsToUint(unitNormal(n1)), kRungField);
    made[own][placeOf(k + 4u)] = uvec4(floatBitsToUint(p2), material);
    made[own][placeOf(k + 5u)] = uvec4(floatBitsToUint(unitNormal(n2)), kRungField);
    made[own][placeOf(k + 6u)] = uvec4(floatBitsToUint(p3), material);
    made[own][placeOf(k + 7u)] = uvec4(floatBitsToUint(unitNormal(n3)), kRungField);
    barrier();
    const uint vertices = min(4u * uint(LANES), innerRows - 4u * first);
    for (uint i = lane; i < 2u * vertices; i += uint(LANES)) fineVertices[target + 8u * first + i] = made[own][placeOf(i)];
    barrier();
#else
    const uint to = target + 8u * four;
    fineVertices[to] = uvec4(floatBitsToUint(p0), material);
    fineVertices[to + 1u] = uvec4(floatBitsToUint(unitNormal(n0)), kRungField);
    if (4u * four + 1u < innerRows) {
      fineVertices[to + 2u] = uvec4(floatBitsToUint(p1), material);
      fineVertices[to + 3u] = uvec4(floatBitsToUint(unitNormal(n1)), kRungField);
    }
    if (4u * four + 2u < innerRows) {
      fineVertices[to + 4u] = uvec4(floatBitsToUint(p2), material);
      fineVertices[to + 5u] = uvec4(floatBitsToUint(unitNormal(n2)), kRungField);
    }
    if (4u * four + 3u < innerRows) {
      fineVertices[to + 6u] = uvec4(floatBitsToUint(p3), material);
      fineVertices[to + 7u] = uvec4(floatBitsToUint(unitNormal(n3)), kRungField);
    }
#endif
  }
}

void main() {
  uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
#if BORDER_LAST
  const uint inners = (patchCount + uint(PATCHES) - 1u) / uint(PATCHES);
  group = group < inners ? group + cornerGroups + edgeGroups : group - inners;
#endif
#if PART == 1
  if (group >= cornerGroups + edgeGroups) return;
#elif PART == 2
  if (group < cornerGroups + edgeGroups) return;
#endif
  if (group < cornerGroups) {
    const uint corner = group * uint(LANES * PATCHES) + gl_LocalInvocationIndex;
    if (corner >= cornerCount) return;
    const uvec2 source = sources[edgeCount + corner];
    writeBorder(corner, cornerRow(source.x), cornerRow(source.y));
  } else if (group < cornerGroups + edgeGroups) {
    const uint item = (group - cornerGroups) * uint(LANES * PATCHES) + gl_LocalInvocationIndex;
    const uint edge = item >> level, along = item & ((1u << level) - 1u);
    if (edge >= edgeCount || along == 0u) return;
    const uvec2 source = sources[edge];
    writeBorder(cornerCount + edge * ((1u << level) - 1u) + along - 1u, edgeRow(source.x, along), edgeRow(source.y, along));
  } else {
    // Invocations beyond the last patch repeat it: they write the same.
    const uint first = (group - cornerGroups - edgeGroups) * uint(PATCHES);
    writeInner(min(first + gl_LocalInvocationID.y, patchCount - 1u));
  }
}
