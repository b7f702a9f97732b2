// SPDX-License-Identifier: BSD-3-Clause
// Texels of a level of the minimum pyramid as rectangles at one depth, backprojected onto the light. Schwarz 2009, section
// 4.1. The including shader gathers: accumulate(low, high) takes a rectangle in unit light coordinates.
//
// In tangents t = x/z the backprojection of a texel edge at depth z from receiver p is, in unit light coordinates,
//   s = z / (p_z - z) * (p_z t - p_x) / w + e,
// e being the map's eye in these coordinates, to which p is relative; 1/2 in the light's centre.

//
// Loops run along rows; along columns where LANES invocations share a pixel, so that those side by side read neighbours and
// throw them onto the same rows of samples.
#if LANES > 1
#define ALONG y
#define ACROSS x
const ivec2 kAlong = ivec2(0, 1), kAcross = ivec2(1, 0);
#else
#define ALONG x
#define ACROSS y
const ivec2 kAlong = ivec2(1, 0), kAcross = ivec2(0, 1);
#endif

Range occluderRange(Area area, int level) { return Range(area.low >> level, (area.high - 1) >> level); }

// Visibility by the micropatches of a level that lie in the area.
float gatherOccluders(vec4 p, Area area, int level) {
  const Range range = occluderRange(area, level);
  const ivec2 low = range.low, high = range.high;
  const ivec2 count = high - low + 1;
  if (float(count.x + 1) * float(count.y) > float(maxIterations)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  const float depth = biasedDepth(p, level);
  const vec2 perTexel = tangentSize / float(resolution) * float(1 << level);
  // Unit light coordinates of edge e (in texels of the level) thrown by k: k (scale e + shift) + eyeOnLight.
  const vec2 scale = p.z * perTexel / lightSize;
  const vec2 shift = (p.z * tangentLow - p.xy) / lightSize;
  for (int across = low.ACROSS + firstRow; across <= high.ACROSS; across += rowStep) {
    const vec2 edgesAcross = scale.ACROSS * vec2(float(across), float(across + 1)) + shift.ACROSS;
    ivec2 texel;
    texel.ACROSS = across;
    texel.ALONG = low.ALONG;
#if GAP_FILL != GAP_FILL_NONE
    const float first = texel.ALONG > 0 ? levelDepth(texel - kAlong, level) : kEmptyDepth;
    bool lastBlocks = blocks(first, texel - kAlong, level, p, depth);
    float lastScale = projectionScale(first, p.z);
    float corner = texel.x > 0 && texel.y > 0 ? levelDepth(texel - 1, level) : kEmptyDepth;
#endif
    for (float edge = float(low.ALONG); texel.ALONG <= high.ALONG; ++texel.ALONG, edge += 1.0) {
      const float z = levelDepth(texel, level);
      ++fetchCount;
      ++examinedCount;
#if GAP_FILL != GAP_FILL_NONE
      const float beside = across > 0 ? levelDepth(texel - kAcross, level) : kEmptyDepth;
      ++fetchCount;
#endif
      const bool blocking = blocks(z, texel, level, p, depth);
      float k = 0.0;
      if (blocking) {
        k = projectionScale(z, p.z);
        vec2 lowEdge, highEdge;
        lowEdge.ACROSS = edgesAcross.x;
        highEdge.ACROSS = edgesAcross.y;
        lowEdge.ALONG = scale.ALONG * edge + shift.ALONG;
        highEdge.ALONG = scale.ALONG * (edge + 1.0) + shift.ALONG;
        vec2 start = k * lowEdge + eyeOnLight;
        const vec2 end = k * highEdge + eyeOnLight;
#if GAP_FILL != GAP_FILL_NONE
        if (lastBlocks) start.ALONG = min(start.ALONG, lastScale * lowEdge.ALONG + eyeOnLight.ALONG);
        if (blocks(beside, texel - kAcross, level, p, depth))
          start.ACROSS = min(start.ACROSS, projectionScale(beside, p.z) * lowEdge.ACROSS + eyeOnLight.ACROSS);
#endif
#if GAP_FILL == GAP_FILL_DIAGONAL
        if (blocks(corner, texel - 1, level, p, depth)) start = min(start, projectionScale(corner, p.z) * lowEdge + eyeOnLight);
#endif
        accumulateOnLight(start, end);
      }
#if GAP_FILL != GAP_FILL_NONE
      lastBlocks = blocking;
      lastScale = k;
      corner = beside;
#endif
    }
    if (isSaturated()) return 0.0;
  }
  return gatheredVisibility();
}
