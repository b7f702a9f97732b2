// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/frame/multi_scale_map.h"
#include "renderer/gl/program.h"

namespace limen::techniques {

/// Squares used for a depth range in structures with layers.
enum class RangeSamples {
  One,          ///< around the area
  OneThenFour,  ///< one for the first range of a pixel, then four
  Four          ///< at the area's corners
};
constexpr EnumNames<RangeSamples, 3> enumNames(RangeSamples) {
  return {{{{RangeSamples::One, "one"},
            {RangeSamples::OneThenFour, "one_then_four"},
            {RangeSamples::Four, "four"}}}};
}

/// Of the structures that hold several layers of windows.
struct LayerSettings {
  RangeSamples rangeSamples = RangeSamples::OneThenFour;
  bool growth = true;
  static const SettingsTable<LayerSettings>& table();
};

struct NoStructure {
  static constexpr const char *kKind = "none", *kSummary = "nothing: the whole search area may matter";
};
struct HierarchicalMap {
  static constexpr const char *kKind = "hsm", *kSummary = "hierarchical shadow map";
};
struct MultiScaleLayers {
  static constexpr const char *kKind = "mssm", *kSummary = "multi-scale shadow map";
  LayerSettings layers;
  static const SettingsTable<MultiScaleLayers>& table();
};
struct NBufferLayers {
  static constexpr const char *kKind = "n_buffer", *kSummary = "N-buffer (Décoret 2005)";
  LayerSettings layers;
  static const SettingsTable<NBufferLayers>& table();
};
struct YLayers {
  static constexpr const char *kKind = "ysm", *kSummary = "Y shadow map: layers over a coarse level";
  int base = 256;  ///< texels per side of the layers, at most the map's
  LayerSettings layers;
  static const SettingsTable<YLayers>& table();
};

/// Acceleration structure: provides the depth range of an area of the shadow map. Source: Schwarz 2009,
/// sections 4.1 and 4.3.
using StructureSettings =
    std::variant<NoStructure, HierarchicalMap, MultiScaleLayers, NBufferLayers, YLayers>;

/// Null for structures without layers.
const LayerSettings* layersOf(const StructureSettings& structure);
/// What depth_bounds.glsl reads, and GROW of occluder_search.glsl.
void defineStructure(const StructureSettings& structure, gl::ShaderDefines& defines);
/// Number of a pixel's first depth ranges that use one square; 0 without layers.
int roughQueries(const StructureSettings& structure);
/// The layers over a map of `resolution` texels per side; the structure has layers.
frame::MultiScaleSettings multiScaleSettings(const StructureSettings& structure,
                                             const frame::ShadowMapSettings& map);

}  // namespace limen::techniques
