// SPDX-License-Identifier: BSD-3-Clause
// Layers of a peeled map, all read by one pass: search areas of each, then their occluders into what is gathered once.
// Needs occluder_search.glsl. Where search areas are noted is up to the including shader.

// Of the layer read at present; a level below 0: the layer has nothing to gather.
void noteArea(ivec2 pixel, Area area, float level);
// Returns the level.
float notedArea(ivec2 pixel, int layer, out Area area);
#ifdef KEEP_MASKS
void coverAll();
#endif

#ifndef SPLIT_GATHER
// Notes the search areas of all layers; false: none has anything to gather, with the visibility that is known then. A pixel's
// class is that of its most expensive layer, as in PixelCounts::add().
bool findAreas(ivec2 pixel, out float visibility) {
  visibility = 1.0;
  bool some = false;
  uint fetches = 0u, joined = kLit;
  for (int layer = 0; layer < MAP_LAYERS; ++layer) {
    readLayer(layer);
    // A bias may move it by the map's texels.
    const vec4 p = loadReceiver(pixel);
    boundFetches = 0u;
    Area area;
    const bool found = findArea(p, area, visibility);
    noteArea(pixel, area, found ? qualityLevel(p, area) : -1.0);
    fetches += fetchCount;
    if (layer == 0) joined = pixelClass;
    some = some || found;
    if (pixelClass != kUmbra) continue;
    some = false;
    joined = kUmbra;
    break;
  }
  fetchCount = fetches;
  pixelClass = joined;
  return some;
}

// Visibility of a pixel without anything to gather.
float visibilityOfNone(vec4 p, ivec2 pixel, float visibility) {
#ifdef KEEP_MASKS
  clearGathered();
  if (visibility > 0.0)
    hideBehindPlane(p);
  else
    coverAll();
  keepGathered(pixel);
  return gatheredVisibility();
#else
  return visibilityUnprocessed(p, visibility);
#endif
}

#endif
#ifndef SPLIT_CLASSIFY
// Adds this invocation's rows of all noted areas to what is gathered; false: more iterations than the driver allows. Between
// layers the invocations of a pixel join, since what one layer hides whole needs no other: all of a group call it, those without a
// pixel with `listed` false.
bool gatherLayers(ivec2 pixel, bool listed) {
  uint texels = 0u;
  float coarsest = 0.0;
  bool whole = true;
  for (int layer = 0; layer < MAP_LAYERS; ++layer) {
#if LANES > 1
    if (layer > 0) {
      joinLanes();
      barrier();  // before what is shared is written again
    }
#endif
    if (!listed || !whole) continue;
    Area area;
    const float level = notedArea(pixel, layer, area);
    if (level < 0.0) continue;
    readLayer(layer);
    const vec4 p = loadReceiver(pixel);
    int first, last;
    float weight;
    beginLevels(area, level, pixel, first, last, weight);
    texels += areaTexels;
    coarsest = max(coarsest, level);
    if (!isSaturated()) gatherOccluders(p, area, first);
    whole = pixelClass != kCutShort;
  }
  areaTexels = texels;
  levelUsed = coarsest;
  return whole;
}
#endif
