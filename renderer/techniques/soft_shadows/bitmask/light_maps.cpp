// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask/light_maps.h"

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr const char *kSource = "Schwarz 2009, section 4.2.2", *kDefaultPoints = "5";
constexpr int64_t kDefaultLayers = 2, kDefaultUpdates = 0;
constexpr double kDefaultPeelBias = 1e-5, kDefaultExtent = 1.0, kDefaultSpread = 1.0;

/// Places in [-1, 1]^2; the light's centre comes first, where it is one of them.
std::vector<glm::dvec2> pointsOf(int count) {
  std::vector<glm::dvec2> points;
  if (count % 2 == 1) points.emplace_back(0.0);
  points.emplace_back(-1.0, -1.0);
  points.emplace_back(1.0, 1.0);
  if (count >= 4) points.insert(points.end(), {{1.0, -1.0}, {-1.0, 1.0}});
  if (count >= 9) points.insert(points.end(), {{-1.0, 0.0}, {1.0, 0.0}, {0.0, -1.0}, {0.0, 1.0}});
  return points;
}

void refuseUnless(bool isAbout, const std::string& maps, const std::string& parameter, bool isDefault) {
  if (!isAbout && !isDefault)
    throw Error("'" + parameter + "' is about 'maps: " + maps + "'", parameter,
                "leave it out, or give maps: " + maps);
}

}  // namespace

std::vector<Parameter> LightMaps::parameters() {
  return {
      choiceParameter("maps", "centre", {"centre", "peeled", "light_points", "per_object"},
                      "Shadow maps whose occluders are joined: the one from the light's centre, with the "
                      "layers behind it, from several points of the light, or one for each object",
                      kSource),
      integerParameter("layers", kDefaultLayers, 1, 8, "layers",
                       "Surfaces along a ray from the light's centre", kSource),
      realParameter("peel_bias", kDefaultPeelBias, 0.0, 0.1, "",
                    "Share of the distance by which a layer's surface lies behind the one before, at least",
                    "Schwarz 2009, section 4.2.2 (not given there)"),
      realParameter("later_extent", kDefaultExtent, 0.05, 1.0, "",
                    "Extent of the frustum of all layers but the first, around the light's axis",
                    "Schwarz 2009, section 4.2.2 (not given there)"),
      choiceParameter("light_points", kDefaultPoints, {"2", "4", "5", "9"},
                      "Points that maps are seen from: two opposite corners, all corners, those and the "
                      "centre, those and the middles of the sides",
                      kSource),
      realParameter("point_spread", kDefaultSpread, 0.0, 1.0, "",
                    "Place of these corners between the light's centre and its own"),
      integerParameter("updates", kDefaultUpdates, 0, 64, "objects",
                       "Objects whose map and masks a frame makes anew, in turn; masks of the others stay as "
                       "they are, until the camera moves; 0: all",
                       kSource)};
}

void LightMaps::check(const ParameterValues& values) {
  const std::string& maps = values.text("maps");
  const bool peeled = maps == "peeled", points = maps == "light_points";
  refuseUnless(peeled, "peeled", "layers", values.integer("layers") == kDefaultLayers);
  refuseUnless(peeled, "peeled", "peel_bias", values.real("peel_bias") == kDefaultPeelBias);
  refuseUnless(peeled, "peeled", "later_extent", values.real("later_extent") == kDefaultExtent);
  refuseUnless(points, "light_points", "light_points", values.text("light_points") == kDefaultPoints);
  refuseUnless(points, "light_points", "point_spread", values.real("point_spread") == kDefaultSpread);
  refuseUnless(maps == "per_object", "per_object", "updates", values.integer("updates") == kDefaultUpdates);
}

LightMaps::LightMaps(const ParameterValues& values)
    : maps_(values.text("maps")),
      layers_(static_cast<int>(values.integer("layers"))),
      points_(std::stoi(values.text("light_points"))),
      peelBias_(values.real("peel_bias")),
      laterExtent_(values.real("later_extent")),
      pointSpread_(values.real("point_spread")),
      updates_(static_cast<size_t>(values.integer("updates"))),
      perObject_(maps_ == "per_object") {}

std::vector<frame::ShadowMapSettings> LightMaps::of(const scene::Scene& scene,
                                                    frame::ShadowMapSettings usual) const {
  std::vector<frame::ShadowMapSettings> out;
  frame::ShadowMapSettings map = usual;
  if (maps_ == "peeled") {
    map.peelBias = peelBias_;
    for (map.layer = 0; map.layer < layers_; ++map.layer) {
      out.push_back(map);
      map.extent = laterExtent_;
    }
  } else if (maps_ == "light_points") {
    for (const glm::dvec2 point : pointsOf(points_)) {
      map.eye = 0.5 + 0.5 * pointSpread_ * point;
      // Without a spread all points are one.
      if (out.empty() || map.eye != out[0].eye) out.push_back(map);
    }
  } else if (perObject_) {
    if (!scene.lodObjects.empty())
      throw Error("'maps: per_object' knows no levels of detail, which '" + scene.name + "' has", "maps",
                  "give maps: centre, or another scene");
    for (size_t part = 0; part < scene.parts.size(); ++part) {
      if (scene.parts[part].receiverOnly) continue;
      map.part = static_cast<int>(part);
      out.push_back(map);
    }
  }
  if (out.empty()) out.push_back(usual);
  return out;
}

}  // namespace limen::techniques
