// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>
#include <vector>

#include "experiments/base/settings_table.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/scene/scene.h"

namespace limen::techniques {

struct CentreMap {
  static constexpr const char *kKind = "centre", *kSummary = "only the map from the light's centre";
};
/// Passes over pixels that read the layers.
enum class LayerPasses {
  Each,  ///< one for each layer; masks are stored in between
  One    ///< one for all; masks stay in registers
};
constexpr EnumNames<LayerPasses, 2> enumNames(LayerPasses) {
  return {{{{LayerPasses::Each, "each"}, {LayerPasses::One, "one"}}}};
}
struct PeeledMaps {
  static constexpr const char *kKind = "peeled", *kSummary = "that map and the layers behind it";
  int layers = 2;
  double bias = 1e-5, laterExtent = 1.0;
  LayerPasses passes = LayerPasses::Each;
  static const SettingsTable<PeeledMaps>& table();
};
/// What is done about gaps that a map cannot see into: parts of the light between two surfaces one behind the
/// other, as seen from the map's point.
enum class PointGaps {
  Open,   ///< left to the other maps, which see into most of them
  Filled  ///< by each map, as if it were the only one; the masks of all add up what each took for hidden
};
constexpr EnumNames<PointGaps, 2> enumNames(PointGaps) {
  return {{{{PointGaps::Open, "open"}, {PointGaps::Filled, "filled"}}}};
}
struct LightPointMaps {
  static constexpr const char *kKind = "light_points", *kSummary = "maps from several points of the light";
  int points = 5;
  double spread = 1.0;
  PointGaps gaps = PointGaps::Open;
  static const SettingsTable<LightPointMaps>& table();
};
/// Each object has its own map and masks, which are reused while the object does not change.
struct ObjectMaps {
  static constexpr const char *kKind = "per_object", *kSummary = "a map for each object";
  int updates = 0;
  static const SettingsTable<ObjectMaps>& table();
};

/// The shadow maps whose occluders a bitmask combines. Source: Schwarz 2009, section 4.2.2.
using MapChoice = std::variant<CentreMap, PeeledMaps, LightPointMaps, ObjectMaps>;

/// Maps of a scene's first light, `usual` being the one from its centre. Throws Error if the scene has no
/// such maps.
std::vector<frame::ShadowMapSettings> lightMaps(const MapChoice& choice, const scene::Scene& scene,
                                                const frame::ShadowMapSettings& usual);

}  // namespace limen::techniques
