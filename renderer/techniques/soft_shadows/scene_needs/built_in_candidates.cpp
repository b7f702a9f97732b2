// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/scene_needs/shadow_candidates.h"

namespace limen::techniques {
namespace {

using Given = std::map<std::string, ParameterValue>;

/// What a rung of the ladder sets, without the maps' resolution.
struct Rung {
  const char* technique;
  Given given = {};
};

const char *const kHard = "soft_shadows/hard", *const kPcf = "soft_shadows/pcf",
                  *const kPcss = "soft_shadows/pcss", *const kAreas = "soft_shadows/backprojection",
                  *const kBitmask = "soft_shadows/bitmask", *const kMaps = "soft_shadows/sampled_light";

ParameterValue kind(const char* name) { return std::string(name); }
Given budget(int64_t limit, Given others = {}) {
  others["budget.limit"] = limit;
  return others;
}
/// In one pass over a hierarchical map, unless `others` says otherwise.
Given plain(Given others) {
  others.emplace("passes", kind("single"));
  others.emplace("structure", kind("hsm"));
  return others;
}
/// Search and loop in separate passes, several lanes to a pixel, over a Y shadow map.
Given split(Given others) {
  others.emplace("passes", kind("split"));
  others.emplace("structure", kind("ysm"));
  return others;
}
/// As in Schwarz 2009: bias by the receiver's slope, coarse texels as near as their nearest.
Given thesisForm(Given others) {
  others["bias"] = kind("receiver_slope");
  others["bias.slope"] = 2.0;
  others["occluders"] = kind("micropatches");
  others["occluders.depths"] = kind("nearest");
  return plain(others);
}

std::vector<Rung> atResolution() {
  std::vector<Rung> out = {
      {kHard},
      {kPcf, {{"filter_radius", 4.0}, {"filter_taps", int64_t{8}}}},
      {kPcf, {{"filter_radius", 16.0}, {"filter_taps", int64_t{16}}}},
      {kPcss, {{"search_taps", int64_t{4}}, {"filter_taps", int64_t{8}}}},
      {kPcss, {{"search_taps", int64_t{8}}, {"filter_taps", int64_t{16}}}},
      {kPcss, {{"search_taps", int64_t{16}}, {"filter_taps", int64_t{32}}}},
      {kAreas, budget(256, plain({{"occluders", kind("microquads")}}))},
      {kAreas, budget(256, thesisForm({}))},
      {kAreas, budget(256, split({}))},
      {kBitmask, budget(256, plain({{"occluders", kind("microquads")}}))},
      {kBitmask, budget(256, thesisForm({}))},
      {kBitmask, budget(1024, thesisForm({{"structure", kind("ysm")}}))},
      {kBitmask, budget(256, plain({{"structure", kind("ysm")}}))},
      {kBitmask, budget(64, plain({{"passes", kind("split")}}))},
      {kBitmask, budget(256, plain({{"passes", kind("split")}}))},
      {kBitmask, budget(256, plain({{"maps", kind("light_points")}, {"structure", kind("ysm")}}))}};
  for (const int64_t limit : {64, 256, 1024}) {
    out.push_back({kAreas, budget(limit, plain({}))});
    out.push_back({kBitmask, budget(limit, plain({}))});
  }
  for (const int64_t limit : {16, 36, 64, 144, 256, 576, 1024, 4096})
    out.push_back({kBitmask, budget(limit, split({}))});
  for (const int64_t limit : {64, 256})
    out.push_back({kBitmask, budget(limit, split({{"pattern", kind("regular_8")}}))});
  for (const int64_t limit : {256, 1024}) {
    out.push_back({kBitmask, budget(limit, plain({{"maps", kind("peeled")}, {"structure", kind("ysm")}}))});
    out.push_back({kBitmask, budget(limit, split({{"occluders", kind("microrects")}}))});
  }
  for (const int64_t maps : {4, 16}) out.push_back({kMaps, {{"samples", maps}}});
  return out;
}

std::vector<Rung> atTwiceTheResolution() {
  std::vector<Rung> out = {{kHard}};
  for (const int64_t limit : {256, 1024, 4096}) out.push_back({kBitmask, budget(limit, split({}))});
  out.push_back({kMaps, {{"samples", int64_t{16}}}});
  return out;
}

Candidate withMap(const Rung& rung, const MapSettings& map, int64_t resolution) {
  Candidate out{rung.technique, rung.given};
  out.given["resolution"] = resolution;
  // Sampled maps are rasterised as the picture is.
  if (std::string(rung.technique) != kMaps && map.raster != MapSettings{}.raster)
    out.given["raster"] = std::string(limen::toText(map.raster));
  return out;
}

}  // namespace

std::vector<Candidate> builtInCandidates(const MapSettings& map) {
  const int64_t resolution = map.resolution;
  std::vector<Candidate> out;
  for (const Rung& rung : atResolution()) out.push_back(withMap(rung, map, resolution));
  for (const Rung& rung : atTwiceTheResolution()) out.push_back(withMap(rung, map, 2 * resolution));
  for (const int64_t maps : {64, 256})
    for (const int64_t factor : {1, 2})
      out.push_back(withMap({kMaps, {{"samples", maps}}}, map, factor * resolution));
  return out;
}

}  // namespace limen::techniques
