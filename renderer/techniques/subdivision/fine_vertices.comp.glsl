// SPDX-License-Identifier: BSD-3-Clause
// Main step (Holländer 2013, section 2.2.3) in compute. The first work groups make the vertices at corners of patches, the next
// those along fine edges, each from the patch that is its source; all others a patch's inner vertices each, ROWS an
// invocation. Their control vertices lie in shared memory and their weights come in one read. Groups are small, and so is
// what they share, as a group mostly waits: for its patch, for its points, for its weights.
#include "renderer/techniques/tessellation/tessellation_bindings.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"

layout(local_size_x = kMeshLanes) in;
layout(std430, binding = kSubdivisionPatchesBuffer) readonly buffer Patches { uvec4 patches[]; };  // MeshPatch
layout(std430, binding = kSubdivisionPointsBuffer) readonly buffer Points { uint points[]; };
layout(std430, binding = kSubdivisionTablesBuffer) readonly buffer Weights { float weights[]; };
#if ROWS == 4
layout(std430, binding = kSubdivisionTablesBuffer) readonly buffer WeightsOfFour { vec4 weightsOfFour[]; };
#endif
layout(std430, binding = kSubdivisionSourcesBuffer) readonly buffer Sources { uvec2 sources[]; };
layout(std430, binding = kControlsBuffer) readonly buffer Controls { vec4 controls[]; };  // ControlVertex
layout(std430, binding = kFineVerticesBuffer) writeonly buffer FineVertices { uvec4 fineVertices[]; };  // TessellatedVertex
#ifdef TEXTURED
layout(std430, binding = kPackedAttributesBuffer) readonly buffer PackedAttributes { uint packedAttributes[]; };
uint lastWordOf(uint vertex) { return packedAttributes[vertex]; }
#else
uint lastWordOf(uint vertex) { return kRungField; }
#endif

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

const uint kBatch = 4u;  // of terms that are read at once, so that their latencies overlap

struct Point {
  vec3 position, normal;
};

Point pointAt(uvec4 head, uint row) {
  precise vec3 position = vec3(0.0);
  vec3 normal = vec3(0.0), other = vec3(0.0);
  for (uint first = 0u; first < head.y; first += kBatch) {
    vec3 p[kBatch], n[kBatch];
    float w[kBatch];
    for (uint i = 0u; i < kBatch; ++i) {
      const uint slot = min(first + i, head.y - 1u), point = points[head.x + slot];
      w[i] = first + i < head.y ? weights[head.z + slot * rows + row] : 0.0;
      p[i] = controls[2u * point].xyz;
#ifndef GEOMETRY_NORMALS
      n[i] = controls[2u * point + 1u].xyz;
#endif
    }
    for (uint i = 0u; i < kBatch; ++i) {
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
  fineVertices[2u * target + 1u] = uvec4(floatBitsToUint(point.normal), lastWordOf(target));
}

shared vec4 near[2 * SLOTS];
shared uvec4 made[2 * kMeshLanes];

// Weights of an invocation's rows, which lie kMeshLanes apart, in succession.
float[ROWS] weightsAt(uint at) {
#if ROWS == 4
  const vec4 w = weightsOfFour[at / 4u];
  return float[4](w.x, w.y, w.z, w.w);
#else
  float w[ROWS];
  for (int r = 0; r < ROWS; ++r) w[r] = weights[at + uint(r)];
  return w;
#endif
}

void writeInner(uint number) {
  const uint lane = gl_LocalInvocationID.x;
  const uvec4 head = patches[number];
  for (uint i = lane; i < head.y; i += uint(kMeshLanes)) {
    const uint point = points[head.x + i];
    near[2u * i] = controls[2u * point];
    near[2u * i + 1u] = controls[2u * point + 1u];
  }
  barrier();
  const uint target = cornerCount + edgeCount * ((1u << level) - 1u) + number * innerRows, lastVertex = target + innerRows - 1u;
  for (uint first = 0u; first < innerRows; first += uint(ROWS * kMeshLanes)) {
    precise vec3 position[ROWS];
    vec3 normal[ROWS], other[ROWS];
    for (int r = 0; r < ROWS; ++r) position[r] = normal[r] = other[r] = vec3(0.0);
    uint at = head.z + first + uint(ROWS) * lane;
    for (uint s = 0u; s < head.y; ++s, at += rows) {
      const vec3 p = near[2u * s].xyz;
      const float w[ROWS] = weightsAt(at);
      for (int r = 0; r < ROWS; ++r) position[r] = fma(vec3(w[r]), p, position[r]);
#ifdef GEOMETRY_NORMALS
      const float a[ROWS] = weightsAt(at + tangentStride), b[ROWS] = weightsAt(at + 2u * tangentStride);
      for (int r = 0; r < ROWS; ++r) normal[r] += a[r] * p, other[r] += b[r] * p;
#else
      const vec3 n = near[2u * s + 1u].xyz;
      for (int r = 0; r < ROWS; ++r) normal[r] += w[r] * n;
#endif
    }
    for (int r = 0; r < ROWS; ++r) {
#ifdef GEOMETRY_NORMALS
      normal[r] = cross(normal[r], other[r]);
#endif
      const uint firstOfRound = first + uint(r * kMeshLanes);
      // Neighbouring invocations write neighbouring bytes.
      const uint lastWord = lastWordOf(min(target + firstOfRound + lane, lastVertex));
      made[2u * lane] = uvec4(floatBitsToUint(position[r]), material);
      made[2u * lane + 1u] = uvec4(floatBitsToUint(unitNormal(normal[r])), lastWord);
      barrier();
      for (uint i = 0u; i < 2u; ++i) {
        const uint half_ = lane + i * uint(kMeshLanes);
        if (firstOfRound + half_ / 2u < innerRows) fineVertices[2u * (target + firstOfRound) + half_] = made[half_];
      }
      barrier();
    }
  }
}

void main() {
  const uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (group < cornerGroups) {
    const uint corner = group * uint(kMeshLanes) + gl_LocalInvocationIndex;
    if (corner >= cornerCount) return;
    const uvec2 source = sources[edgeCount + corner];
    writeBorder(corner, cornerRow(source.x), cornerRow(source.y));
  } else if (group < cornerGroups + edgeGroups) {
    const uint item = (group - cornerGroups) * uint(kMeshLanes) + gl_LocalInvocationIndex;
    const uint edge = item >> level, along = item & ((1u << level) - 1u);
    if (edge >= edgeCount || along == 0u) return;
    const uvec2 source = sources[edge];
    writeBorder(cornerCount + edge * ((1u << level) - 1u) + along - 1u, edgeRow(source.x, along), edgeRow(source.y, along));
  } else if (group - cornerGroups - edgeGroups < patchCount) {
    writeInner(group - cornerGroups - edgeGroups);
  }
}
