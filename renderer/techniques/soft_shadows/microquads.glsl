// SPDX-License-Identifier: BSD-3-Clause
// Texel centres of a level of the minimum pyramid as vertices of a mesh, backprojected onto the light. A cell of which all
// four vertices block is a microquad (Schwarz 2009, section 4.4.1); with microtris, one of which three block is a
// microtri (section 4.4.3). The including shader gathers: accumulateQuad(a, b, c, d) takes corners in unit light
// coordinates, counter-clockwise in the map, not clipped to the light; a microtri comes with one of them twice.
//
// Cells that the search area leaves out lie wholly beyond one side of the light, so that it does not matter to their
// neighbours, however these are clipped, whether they are there.
void accumulateQuad(vec2 a, vec2 b, vec2 c, vec2 d);

struct Vertex {
  vec2 place;
  bool blocks;
};
const Vertex kNowhere = Vertex(vec2(0.0), false);

// Cell c has the texels c and c + 1 of its level as corners, that is, it reaches from c + 1/2 to c + 3/2. The area, in
// texels of level 0, has been grown by half a texel on each side.
Range occluderRange(Area area, int level) {
  const int size = 1 << level;
  const ivec2 low = (2 * area.low + 1 - size) >> (level + 1), high = (2 * area.high - 2 - size) >> (level + 1);
  return Range(max(low, ivec2(0)), min(high, ivec2((resolution >> level) - 2)));
}

// Whether the box around the corners that block meets the light, for counting.
bool reachesLight(Vertex corners[4]) {
  vec2 low = vec2(2.0), high = vec2(-1.0);
  for (int i = 0; i < 4; ++i)
    if (corners[i].blocks) low = min(low, corners[i].place), high = max(high, corners[i].place);
  return all(lessThan(low, vec2(1.0))) && all(greaterThan(high, vec2(0.0)));
}

// Visibility by the microquads of a level that lie in the area.
float gatherOccluders(vec4 p, Area area, int level) {
  const Range cells = occluderRange(area, level);
  const ivec2 count = max(cells.high - cells.low + 1, ivec2(0));
  const float depth = biasedDepth(p, level);
  const vec2 perTexel = tangentSize / float(resolution) * float(1 << level);
  const vec2 scale = p.z * perTexel / lightSize;
  const vec2 shift = (p.z * tangentLow - p.xy) / lightSize;
  // Lower left, lower right, upper right, upper left.
  Vertex corners[4] = Vertex[4](kNowhere, kNowhere, kNowhere, kNowhere);
  int visited = 0;
  for (int y = cells.low.y + firstRow; y <= cells.high.y; y += rowStep) {
    for (int x = cells.low.x - 1; x <= cells.high.x; ++x) {
      ++visited;
      corners[0] = corners[1];
      corners[3] = corners[2];
      for (int i = 0; i < 2; ++i) {
        const ivec2 texel = ivec2(x + 1, y + i);
        const float z = levelDepth(texel, level);
        ++fetchCount;
        // Precise, so that a vertex has one place for all cells that share it.
        precise vec2 place = vec2(0.0);
        const bool blocking = blocks(z, texel, level, p, depth);
        if (blocking) place = projectionScale(z, p.z) * (scale * (vec2(texel) + 0.5) + shift) + eyeOnLight;
        corners[1 + i] = Vertex(place, blocking);
      }
      if (x < cells.low.x) continue;
      ++examinedCount;
      const int blocking = int(corners[0].blocks) + int(corners[1].blocks) + int(corners[2].blocks) + int(corners[3].blocks);
#if OCCLUDERS == OCCLUDERS_MICROQUADS_MICROTRIS
      if (blocking < 3) continue;
#else
      if (blocking < 4) continue;
#endif
      ++occluderCount;
      if (reachesLight(corners)) ++usedCount;
      accumulateQuad(corners[0].blocks ? corners[0].place : corners[1].place,
                     corners[0].blocks && corners[1].blocks ? corners[1].place : corners[2].place,
                     corners[2].blocks ? corners[2].place : corners[3].place,
                     corners[3].blocks ? corners[3].place : corners[2].place);
    }
    if (isSaturated()) return 0.0;
  }
  // A driver that grants a limited number of iterations has left the loops early; how many it subtracts for those of the
  // masks is not known.
  if (visited < (count.x + 1) * rowsToGather(count.y)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  return gatheredVisibility();
}
