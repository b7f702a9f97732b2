// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask/bitmask_settings.h"

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr const char *kMaskText = "Samples that a microquad covers",
                     *kMaskSource = "Schwarz 2009, sections 4.4.2 and 4.4.4";

}  // namespace

const SettingsTable<HalfSpaceTable>& HalfSpaceTable::table() {
  static const SettingsTable<HalfSpaceTable> kTable = {
      Binding(&HalfSpaceTable::size, "size", oneOf({64, 128, 256, 512, 1024}), "",
              "Number of angles, and of distances, of lines in the table; memory grows quadratically",
              "Schwarz 2009, section 4.4.4 (value not given there)")
          .formerly({"table_size"})};
  return kTable;
}

const SettingsTable<MaskedMicroquads>& MaskedMicroquads::table() {
  static const SettingsTable<MaskedMicroquads> kTable = {
      coarseDepthsBinding<MaskedMicroquads>(),
      Binding(&MaskedMicroquads::mask, "mask", kMaskText, kMaskSource).formerly({"quad_mask"})};
  return kTable;
}

const SettingsTable<MaskedMicrotris>& MaskedMicrotris::table() {
  static const SettingsTable<MaskedMicrotris> kTable = {
      coarseDepthsBinding<MaskedMicrotris>(),
      Binding(&MaskedMicrotris::mask, "mask", kMaskText, kMaskSource).formerly({"quad_mask"})};
  return kTable;
}

QuadMaskChoice quadMaskChoice(const MaskedOccluders& occluders) {
  const auto ofMask = [](const auto& mask) {
    return std::visit(
        [](const auto& chosen) {
          QuadMaskChoice choice{.mask = fromText<QuadMask>(chosen.kKind)};
          if constexpr (requires { chosen.size; }) choice.tableSize = chosen.size;
          return choice;
        },
        mask);
  };
  if (const auto* quads = std::get_if<MaskedMicroquads>(&occluders)) return ofMask(quads->mask);
  if (const auto* tris = std::get_if<MaskedMicrotris>(&occluders)) return ofMask(tris->mask);
  return {};
}

void checkSamples(const MaskedOccluders& occluders, LightPattern pattern) {
  if (quadMaskChoice(occluders).mask == QuadMask::Arithmetic && !isGridPattern(pattern))
    throw Error(
        std::string("'arithmetic' needs samples in rows, which ") + limen::toText(pattern) + " does not have",
        "occluders.mask", "give mask: half_space_table, or a regular or jittered pattern");
}

void checkMaps(const MapChoice& maps, const SearchSettings& search) {
  if (!std::holds_alternative<CentreMap>(maps) && std::holds_alternative<StoredBias>(search.bias))
    throw Error("stored biases exist only for the map from the light's centre", "bias",
                "choose another form, or maps: centre");
}

const SettingsTable<BitmaskSettings>& BitmaskSettings::table() {
  using S = BitmaskSettings;
  static const SettingsTable<S> kTable = {
      included(&S::search),
      maskedOccludersBinding(&S::occluders),
      levelsBinding(&S::levels),
      passesBinding(&S::passes),
      patternBinding(&S::pattern),
      mapsBinding(&S::maps),
      {&S::filter, "filter", "Filter against the steps that few light samples leave",
       "Schwarz 2009, section 4.2.3 (not given there)"}};
  return kTable;
}

void BitmaskSettings::check() const {
  const OccluderChoice choice = occluderChoice(occluders);
  checkBias(search, choice);
  checkLevels(search, choice, levels);
  checkSamples(occluders, sampleChoice(pattern).pattern);
  checkMaps(maps, search);
  if (std::holds_alternative<CentreMap>(maps)) return;
  const LevelRule rule = ruleOf(levels);
  if (rule != LevelRule::FinestWithin && rule != LevelRule::CoarsestOver)
    throw Error(std::string("several maps are combined mask by mask, and 'levels: ") + limen::toText(rule) +
                    "' blends the resulting visibilities",
                "levels", "give levels: finest_within, or maps: centre");
}

}  // namespace limen::techniques
