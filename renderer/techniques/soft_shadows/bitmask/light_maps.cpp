// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask/light_maps.h"

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr const char *kMapsSource = "Schwarz 2009, section 4.2.2",
                     *kOpenMaps = "Schwarz 2009, section 4.2.2 (not given there)";

/// Points in [-1, 1]^2; the light's centre comes first, if it is one of them.
std::vector<glm::dvec2> pointsOf(int count) {
  std::vector<glm::dvec2> points;
  if (count % 2 == 1) points.emplace_back(0.0);
  points.emplace_back(-1.0, -1.0);
  points.emplace_back(1.0, 1.0);
  if (count >= 4) points.insert(points.end(), {{1.0, -1.0}, {-1.0, 1.0}});
  if (count >= 9) points.insert(points.end(), {{-1.0, 0.0}, {1.0, 0.0}, {0.0, -1.0}, {0.0, 1.0}});
  return points;
}

std::vector<frame::ShadowMapSettings> mapsOf(const CentreMap&, const scene::Scene&,
                                             const frame::ShadowMapSettings& usual) {
  return {usual};
}

std::vector<frame::ShadowMapSettings> mapsOf(const PeeledMaps& choice, const scene::Scene&,
                                             const frame::ShadowMapSettings& usual) {
  std::vector<frame::ShadowMapSettings> out;
  frame::ShadowMapSettings map = usual;
  map.peelBias = choice.bias;
  for (map.layer = 0; map.layer < choice.layers; ++map.layer) {
    out.push_back(map);
    map.extent = choice.laterExtent;
  }
  return out;
}

std::vector<frame::ShadowMapSettings> mapsOf(const LightPointMaps& choice, const scene::Scene&,
                                             const frame::ShadowMapSettings& usual) {
  std::vector<frame::ShadowMapSettings> out;
  frame::ShadowMapSettings map = usual;
  for (const glm::dvec2 point : pointsOf(choice.points)) {
    map.eye = 0.5 + 0.5 * choice.spread * point;
    // Without a spread all points coincide.
    if (out.empty() || map.eye != out[0].eye) out.push_back(map);
  }
  return out;
}

std::vector<frame::ShadowMapSettings> mapsOf(const ObjectMaps&, const scene::Scene& scene,
                                             const frame::ShadowMapSettings& usual) {
  if (!scene.lodObjects.empty())
    throw Error("maps of single objects do not support levels of detail, which '" + scene.name + "' has",
                "maps", "give maps: centre, or another scene");
  std::vector<frame::ShadowMapSettings> out;
  frame::ShadowMapSettings map = usual;
  for (size_t part = 0; part < scene.parts.size(); ++part) {
    if (scene.parts[part].receiverOnly) continue;
    map.part = static_cast<int>(part);
    out.push_back(map);
  }
  if (out.empty()) out.push_back(usual);
  return out;
}

}  // namespace

const SettingsTable<PeeledMaps>& PeeledMaps::table() {
  static const SettingsTable<PeeledMaps> kTable = {
      Binding(&PeeledMaps::layers, "layers", Range{1, 8}, "layers",
              "Surfaces along a ray from the light's centre", kMapsSource)
          .formerly({"layers"}),
      Binding(&PeeledMaps::bias, "bias", Range{0.0, 0.1}, "",
              "Smallest distance from one layer's surface to the next, as a share of the depth", kOpenMaps)
          .formerly({"peel_bias"}),
      Binding(&PeeledMaps::laterExtent, "later_extent", Range{0.05, 1.0}, "",
              "Extent of the frustum of all layers but the first, around the light's axis", kOpenMaps)
          .formerly({"later_extent"}),
      {&PeeledMaps::passes, "passes",
       "Passes over pixels: one for each layer, with masks stored in between, or one for all; the visibility "
       "is "
       "the same",
       "bench"}};
  return kTable;
}

const SettingsTable<LightPointMaps>& LightPointMaps::table() {
  static const SettingsTable<LightPointMaps> kTable = {
      Binding(&LightPointMaps::points, "points", oneOf({2, 4, 5, 9}), "",
              "Viewpoints of the maps: two opposite corners, all corners, those and the centre, those "
              "and the middles of the sides",
              kMapsSource)
          .formerly({"light_points"}),
      Binding(&LightPointMaps::spread, "spread", Range{0.0, 1.0}, "",
              "Position of these corners between the light's centre and its actual corners")
          .formerly({"point_spread"}),
      {&LightPointMaps::gaps, "gaps",
       "Gaps between two surfaces as a map sees them, and areas that occluders fill: open to what the other "
       "maps see in "
       "them, or filled by each map as occluders have it for a single one",
       "Schwarz 2009, section 4.2.2 (filled)"}};
  return kTable;
}

const SettingsTable<ObjectMaps>& ObjectMaps::table() {
  static const SettingsTable<ObjectMaps> kTable = {
      Binding(&ObjectMaps::updates, "updates", Range{0, 64}, "objects",
              "Objects whose map and masks are updated per frame, in turn; masks of the others are reused "
              "until the camera moves; 0: all",
              kMapsSource)
          .formerly({"updates"})};
  return kTable;
}

std::vector<frame::ShadowMapSettings> lightMaps(const MapChoice& choice, const scene::Scene& scene,
                                                const frame::ShadowMapSettings& usual) {
  return std::visit([&](const auto& chosen) { return mapsOf(chosen, scene, usual); }, choice);
}

}  // namespace limen::techniques
