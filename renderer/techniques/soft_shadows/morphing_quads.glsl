// SPDX-License-Identifier: BSD-3-Clause
// Microquads of which the vertices move from their places in one level of the minimum pyramid to those in the next, by a
// level that is a real number. Schwarz 2009, section 5.1.2, names this as a way to a level of quality without steps, and why
// it is none: whether a quad counts is a decision about each of its vertices, which falls the moment that one passes the
// receiver's depth. The thesis gives no formula. Here a vertex moves in a straight line of the map to the centre of the
// coarser texel that it is part of, and 1/z is blended, so that what lies in a plane stays there and empty texels come from
// infinitely far.
uniform float morphLevel;

void accumulateQuad(vec2 a, vec2 b, vec2 c, vec2 d);

// Cells between texels, one more on each side than microquads that rest have: vertices move by half a texel.
Range occluderRange(Area area, int level) {
  const ivec2 last = ivec2((resolution >> level) - 2);
  return Range(max((area.low >> level) - 2, ivec2(0)), min(((area.high - 1) >> level) + 1, last));
}

// All texels of both levels that vertices of cells in range are made of.
Area areaOfRange(Range range, int level) {
  const ivec2 low = range.low >> 1, high = (range.high + 1) >> 1;
  return Area(low << (level + 1), min((high + 1) << (level + 1), ivec2(resolution)));
}

struct MovingVertex {
  vec2 place;
  bool blocks;
};

MovingVertex vertexAt(ivec2 texel, int level, vec4 p, float depth, vec2 scale, vec2 shift) {
  const float way = level + 1 < levels ? morphLevel - float(level) : 0.0;
  const ivec2 parent = texel >> 1;
  float z = texelFetch(minimumMap, texel, level).x;
  ++fetchCount;
  if (way > 0.0) {
    const float coarse = texelFetch(minimumMap, parent, level + 1).x;
    ++fetchCount;
    z = 1.0 / mix(1.0 / z, 1.0 / coarse, way);
  }
  precise vec2 place = vec2(0.0);
  const vec2 at = mix(vec2(texel) + 0.5, 2.0 * vec2(parent) + 1.0, way);
  bool blocking = z < depth;
#ifdef BIAS_PLANE
  const float size = float(1 << level);
  blocking = blocking && beforePlane(z, at * size, p, p.z * (1.0 - planeMargin(slopeBias + 0.5 * (size * exp2(way) - 1.0))));
#endif
  if (blocking) place = projectionScale(z, p.z) * (scale * at + shift) + eyeOnLight;
  return MovingVertex(place, blocking);
}

float gatherOccluders(vec4 p, Area area, int level) {
  const Range cells = occluderRange(area, level);
  const ivec2 count = max(cells.high - cells.low + 1, ivec2(0));
  // The bias moves with the level too, or it would step.
  const float depth = mix(biasedDepth(p, level), biasedDepth(p, level + 1), morphLevel - float(level));
  const vec2 perTexel = tangentSize / float(resolution) * float(1 << level);
  const vec2 scale = p.z * perTexel / lightSize;
  const vec2 shift = (p.z * tangentLow - p.xy) / lightSize;
  int visited = 0;
  for (int y = cells.low.y + firstRow; y <= cells.high.y; y += rowStep)
    for (int x = cells.low.x; x <= cells.high.x; ++x) {
      ++visited;
      ++examinedCount;
      const MovingVertex a = vertexAt(ivec2(x, y), level, p, depth, scale, shift);
      const MovingVertex b = vertexAt(ivec2(x + 1, y), level, p, depth, scale, shift);
      const MovingVertex c = vertexAt(ivec2(x + 1, y + 1), level, p, depth, scale, shift);
      const MovingVertex d = vertexAt(ivec2(x, y + 1), level, p, depth, scale, shift);
      if (!(a.blocks && b.blocks && c.blocks && d.blocks)) continue;
      ++occluderCount;
      if (all(lessThan(min(min(a.place, b.place), min(c.place, d.place)), vec2(1.0))) &&
          all(greaterThan(max(max(a.place, b.place), max(c.place, d.place)), vec2(0.0))))
        ++usedCount;
      accumulateQuad(a.place, b.place, c.place, d.place);
    }
  // A driver that grants a limited number of iterations has left the loops early.
  if (visited < count.x * rowsToGather(count.y)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  return gatheredVisibility();
}
