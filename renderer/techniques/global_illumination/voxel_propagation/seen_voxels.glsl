// SPDX-License-Identifier: BSD-3-Clause
// Light of the voxels around a point of which it sees the empty ones in front. Included by reconstruct.comp.glsl.

uniform int widest;  // voxels around that are looked at for light of crevices

bool holdsLightAt(uint cell, int face) { return holdsSurface(cell) && besideLight(cell, face) && !besideSurface(cell, face); }
// Whether the middle of the voxel beyond a face is on the side of the surface that is lit.
bool isInFront(SurfacePoint point, vec3 at, ivec3 voxel, int face) {
  return dot(vec3(voxel + faceStep(face)) - at, point.flatNormal) > 0.0;
}

// Voxels of a cube, a bit each, row by row and layer by layer from the bit `first` on.
struct VoxelSet {
  uvec2 bits;
  ivec3 low;
  int side, first;
};
bool isEmpty(uvec2 bits) { return all(equal(bits, uvec2(0u))); }
bool holdsBit(uvec2 bits, int i) { return ((i < 32 ? bits.x : bits.y) >> (i & 31) & 1u) != 0u; }
void setBit(inout uvec2 bits, int i) {
  if (i < 32)
    bits.x |= 1u << i;
  else
    bits.y |= 1u << (i - 32);
}
int takeLowest(inout uvec2 bits) {
  const int i = bits.x != 0u ? findLSB(bits.x) : 32 + findLSB(bits.y);
  if (i < 32)
    bits.x &= bits.x - 1u;
  else
    bits.y &= bits.y - 1u;
  return i;
}
ivec3 voxelOf(VoxelSet set, int bit) {
  const int i = set.first + bit;
  return set.low + ivec3(i % set.side, i / set.side % set.side, i / (set.side * set.side));
}

// Few points need rays, and some many: the invocations of a group trace all of theirs together. One place in the shader traces, as rays
// take many registers.
const int kGroup = kGroupSide * kGroupSide;
const uint kRoom = 512u;
const uint kSeen = 1u, kCutShort = 2u;
shared vec3 origins[kGroup];
shared uint skipped[kGroup];
shared uint queued;
shared uint queue[kRoom];  // invocation and voxel of a ray; then what it found

// Of the voxels, those whose middle no surface is between and the point. All invocations of a group call it; false once none asks.
bool traceTogether(VoxelSet asked, out uvec2 seen) {
  const int index = int(gl_LocalInvocationIndex);
  seen = uvec2(0u);
  for (bool any_ = false;; any_ = true) {
    if (index == 0) queued = 0u;
    barrier();
    const uint count = uint(bitCount(asked.bits.x) + bitCount(asked.bits.y)), first = count > 0u ? atomicAdd(queued, count) : 0u;
    const uint end = min(first + count, kRoom);
    uvec2 sent = asked.bits;
    for (uint i = first; i < end; ++i) {
      const uvec3 voxel = uvec3(voxelOf(asked, takeLowest(asked.bits)) + 16);
      queue[i] = uint(index) | voxel.x << 6 | voxel.y << 14 | voxel.z << 22;
    }
    barrier();
    const uint all_ = queued;
    if (all_ == 0u) return any_;
    for (uint i = uint(index); i < min(all_, kRoom); i += uint(kGroup)) {
      const uint ray = queue[i], of = ray & uint(kGroup - 1);
      const vec3 middle = gridOrigin + (vec3(uvec3(ray >> 6, ray >> 14, ray >> 22) & 255u) - 15.5) * voxelSize;
      const bool before = rayCutShort;
      rayCutShort = false;
      const bool hit = rayAnyHit(Ray(origins[of], middle - origins[of], 0.0, 1.0, skipped[of]));
      queue[i] = (hit ? 0u : kSeen) | (rayCutShort ? kCutShort : 0u);
      rayCutShort = before;
    }
    barrier();
    for (uint i = first; i < end; ++i) {
      const int bit = takeLowest(sent);
      if ((queue[i] & kSeen) != 0u) setBit(seen, bit);
      if ((queue[i] & kCutShort) != 0u) rayCutShort = true;
    }
    if (all_ <= kRoom) return true;
  }
}

// Of the 8 voxels around, those with light at a face of which the point surely sees what is beyond, so that no ray is needed, and the
// others. Surely: there is one wall alone in the point's own voxel and in them, what is in front of its own voxel is empty, and so is
// the way from there to a neighbour, or both ways to a diagonal one are.
struct LitCorners {
  uint sure, doubtful;
};
LitCorners litCorners(SurfacePoint point, vec3 at, int face) {
  uint lit = 0u, edges = 0u, closed = 0u;
  for (int corner = 0; corner < 8; ++corner) {
    const uint cell = cells[corner], bit = 1u << corner;
    if (cornerShare(corner) > kLeastShare && holdsLightAt(cell, face) && isInFront(point, at, low + cornerStep(corner), face)) lit |= bit;
    if (holdsEdge(cell)) edges |= bit;
    if (besideSurface(cell, face)) closed |= bit;
  }
  const uint highs[3] = uint[3](0xaau, 0xccu, 0xf0u);  // the upper half along each axis
  const int axis = face >> 1, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const bvec3 upper = greaterThanEqual(part, vec3(0.5));
  const uint own = uint(upper.x) + 2u * uint(upper.y) + 4u * uint(upper.z);
  if (((edges | closed) >> own & 1u) != 0u) return LitCorners(0u, lit);
  const uint alike = upper[axis] ? highs[axis] : ~highs[axis], alikeU = upper[u] ? highs[u] : ~highs[u],
             alikeV = upper[v] ? highs[v] : ~highs[v];
  const bool openToDiagonal = ((closed >> (own ^ 1u << u) | closed >> (own ^ 1u << v)) & 1u) == 0u;
  const uint sure = lit & ~edges & alike & (openToDiagonal ? ~0u : alikeU | alikeV);
  return LitCorners(sure, lit & ~sure);
}

// Voxels beyond faces of the 8: a cube of 4 x 4 x 4, as several of the 8 may be beside the same empty one.
int beyondCorner(int corner, int face) {
  const ivec3 from = cornerStep(corner) + faceStep(face) + 1;
  return from.x + 4 * (from.y + 4 * from.z);
}
VoxelSet doubtfulVoxels(SurfacePoint point, vec3 at, uint faces) {
  VoxelSet result = VoxelSet(uvec2(0u), low - 1, 4, 0);
  for (uint left = faces; left != 0u; left &= left - 1u) {
    const uint doubtful = litCorners(point, at, findLSB(left)).doubtful;
    for (int corner = 0; corner < 8; ++corner)
      if ((doubtful >> corner & 1u) != 0u) setBit(result.bits, beyondCorner(corner, findLSB(left)));
  }
  return result;
}
vec4 meanSeenLight(SurfacePoint point, vec3 at, int face, uvec2 seen) {
  const LitCorners lit = litCorners(point, at, face);
  uint usable = lit.sure;
  for (int corner = 0; corner < 8; ++corner) {
    if ((lit.doubtful >> corner & 1u) != 0u && holdsBit(seen, beyondCorner(corner, face))) usable |= 1u << corner;
#if GATHER != GATHER_FACES
    if (!holdsLightAt(cells[corner], face)) usable |= 1u << corner;  // those that hold surfaces count as dark
#endif
  }
  return meanLight(face, usable);
}

// For faces at which none of the 8 is lit and seen: the nearest that is of those around the point's own voxel; and if there is none at
// any face, of those farther around, in ever wider cubes.
struct Search {
  uint faces, lacking;
  bool found, wide;
  int reach, first;
  float nearest;
  ivec3 best;
};
void beginFace(inout Search search) {
  search.reach = search.wide ? 2 : 1;
  search.first = 0;
  search.nearest = 1e30;
}
// The next voxels to ask for, beyond the first of the faces left; what has been found at those done is added to the result.
VoxelSet nextVoxels(SurfacePoint point, vec3 at, inout Search search, inout vec4 result) {
  const ivec3 own = ivec3(floor(at + 0.5));
  for (;;) {
    if (search.lacking == 0u) {
      if (search.wide || search.found || widest < 2 || search.faces == 0u) return VoxelSet(uvec2(0u), ivec3(0), 1, 0);
      search.wide = true;
      search.lacking = search.faces;
      beginFace(search);
    }
    const int face = findLSB(search.lacking), reach = search.reach, side = 2 * reach + 1, count = side * side * side;
    if (search.first >= count) {
      if (search.wide && search.nearest > 1e29 && reach < widest) {
        ++search.reach;
        search.first = 0;
        continue;
      }
      if (search.nearest < 1e29) {
        result += weightOf(point, face) * vec4(lightOf(search.best, face).rgb, 1.0);
        search.found = true;
      }
      search.lacking &= search.lacking - 1u;
      beginFace(search);
      continue;
    }
    VoxelSet asked = VoxelSet(uvec2(0u), own - reach + faceStep(face), side, search.first);
    for (int bit = 0; bit < min(64, count - search.first); ++bit) {
      const ivec3 voxel = voxelOf(asked, bit) - faceStep(face), from = abs(voxel - own);
      const vec3 away = vec3(voxel) - at;
      if (dot(away, away) < search.nearest && holdsLightAt(cellAt(voxel), face) && isInFront(point, at, voxel, face) &&
          !(search.wide && max(max(from.x, from.y), from.z) < reach))
        setBit(asked.bits, bit);
    }
    search.first += 64;
    if (!isEmpty(asked.bits)) return asked;
  }
}
void keepNearest(vec3 at, VoxelSet asked, uvec2 seen, inout Search search) {
  while (!isEmpty(seen)) {
    const ivec3 voxel = voxelOf(asked, takeLowest(seen)) - faceStep(findLSB(search.lacking));
    const vec3 away = vec3(voxel) - at;
    if (dot(away, away) >= search.nearest) continue;
    search.nearest = dot(away, away);
    search.best = voxel;
  }
}

// Sum of the light at the faces of the set by their weights, which are in alpha. All invocations of a group call it.
vec4 seenLight(SurfacePoint point, vec3 at, uint faces) {
  origins[gl_LocalInvocationIndex] = point.position;
  skipped[gl_LocalInvocationIndex] = point.triangle;
  VoxelSet asked = doubtfulVoxels(point, at, faces);
  Search search = Search(faces, faces, false, false, 1, 0, 1e30, ivec3(0));
  vec4 result = vec4(0.0);
  for (bool near = true;; near = false) {
    uvec2 seen;
    const bool any_ = traceTogether(asked, seen);
    if (near) {
      for (uint left = faces; left != 0u; left &= left - 1u) {
        const int face = findLSB(left);
        const vec4 light = meanSeenLight(point, at, face, seen);
        if (!(light.a > 0.0)) continue;
        result += weightOf(point, face) * light;
        search.lacking &= ~(1u << face);
        search.found = true;
      }
    } else if (any_) {
      keepNearest(at, asked, seen, search);
    } else {
      break;
    }
    asked = nextVoxels(point, at, search, result);
  }
  return result;
}
