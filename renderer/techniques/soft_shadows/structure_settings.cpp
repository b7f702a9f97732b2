// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/structure_settings.h"

#include <algorithm>

namespace limen::techniques {

const SettingsTable<LayerSettings>& LayerSettings::table() {
  static const SettingsTable<LayerSettings> kTable = {
      Binding(&LayerSettings::rangeSamples, "range_samples",
              "Squares used for a depth range: one around the area, four at its corners, or one for the "
              "first range of a pixel",
              "Schwarz 2009, section 4.3.1 (one_then_four)")
          .formerly({"range_samples"}),
      Binding(&LayerSettings::growth, "growth",
              "Use whole micro-occluders of the level that the budget leads to; otherwise there is an edge "
              "where pixels become fully lit",
              "Schwarz 2009, section 4.3.1")
          .formerly({"growth"})};
  return kTable;
}

const SettingsTable<MultiScaleLayers>& MultiScaleLayers::table() {
  static const SettingsTable<MultiScaleLayers> kTable = {included(&MultiScaleLayers::layers)};
  return kTable;
}

const SettingsTable<NBufferLayers>& NBufferLayers::table() {
  static const SettingsTable<NBufferLayers> kTable = {included(&NBufferLayers::layers)};
  return kTable;
}

const SettingsTable<YLayers>& YLayers::table() {
  static const SettingsTable<YLayers> kTable = {
      Binding(&YLayers::base, "base", oneOf({64, 128, 256, 512}), "texel",
              "Side of the layers, at most the map's", "Schwarz 2009, section 4.3.2")
          .formerly({"ysm_base"}),
      included(&YLayers::layers)};
  return kTable;
}

const LayerSettings* layersOf(const StructureSettings& structure) {
  return std::visit(
      [](const auto& chosen) -> const LayerSettings* {
        if constexpr (requires { chosen.layers; })
          return &chosen.layers;
        else
          return nullptr;
      },
      structure);
}

void defineStructure(const StructureSettings& structure, gl::ShaderDefines& defines) {
  defines[std::holds_alternative<NoStructure>(structure)       ? "STRUCTURE_NONE"
          : std::holds_alternative<HierarchicalMap>(structure) ? "STRUCTURE_HSM"
          : std::holds_alternative<YLayers>(structure)         ? "STRUCTURE_YSM"
                                                               : "STRUCTURE_WINDOWS"] = "1";
  if (std::holds_alternative<NBufferLayers>(structure)) defines["CORNER"] = "1";
  const LayerSettings* layers = layersOf(structure);
  if (layers && layers->growth) defines["GROW"] = "1";
}

int roughQueries(const StructureSettings& structure) {
  const LayerSettings* layers = layersOf(structure);
  if (!layers) return 0;
  switch (layers->rangeSamples) {
    case RangeSamples::One:
      return 1000;
    case RangeSamples::OneThenFour:
      return 1;
    case RangeSamples::Four:
      break;
  }
  return 0;
}

frame::MultiScaleSettings multiScaleSettings(const StructureSettings& structure,
                                             const frame::ShadowMapSettings& map) {
  const auto* ysm = std::get_if<YLayers>(&structure);
  return {map, ysm ? std::min(ysm->base, map.resolution) : map.resolution,
          std::holds_alternative<NBufferLayers>(structure) ? frame::WindowAnchor::Corner
                                                           : frame::WindowAnchor::Centre};
}

}  // namespace limen::techniques
