// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/search_settings.h"

namespace limen::techniques {

/// Area that a microquad adds. The thesis leaves open whether a quad that folds over on the light adds or
/// subtracts: it sums the signed areas of the quad's two triangles.
enum class QuadArea {
  Absolute,  ///< its size
  Signed     ///< its size with the sign of its orientation, so that folds cancel
};
constexpr EnumNames<QuadArea, 2> enumNames(QuadArea) {
  return {{{{QuadArea::Absolute, "absolute"}, {QuadArea::Signed, "signed"}}}};
}

struct SummedMicroquads : OccluderAlternative<OccluderKind::Microquads> {
  static constexpr const char* kSummary = "a mesh between texel centres";
  CoarseDepths depths = CoarseDepths::Nearest;
  QuadArea area = QuadArea::Absolute;
  static const SettingsTable<SummedMicroquads>& table();
};

struct SummedMicrotris : OccluderAlternative<OccluderKind::MicroquadsMicrotris> {
  static constexpr const char* kSummary = "that mesh with triangles where three of four texels block";
  CoarseDepths depths = CoarseDepths::Nearest;
  QuadArea area = QuadArea::Absolute;
  static const SettingsTable<SummedMicrotris>& table();
};

struct Contours : OccluderAlternative<OccluderKind::Contours> {
  static constexpr const char* kSummary = "outlines of the texels that block";
  CoarseDepths depths = CoarseDepths::Sampled;
  double inset = 0.0;
  static const SettingsTable<Contours>& table();
};

struct MorphingMicroquads : OccluderAlternative<OccluderKind::MorphingMicroquads> {
  static constexpr const char* kSummary = "a mesh that moves from one level to the next";
  double morphLevel = 0.0;
  QuadArea area = QuadArea::Absolute;
  static const SettingsTable<MorphingMicroquads>& table();
};

struct BackprojectionSettings {
  using Occluders =
      std::variant<Micropatches, SummedMicroquads, SummedMicrotris, Contours, Microrects, MorphingMicroquads>;
  SearchSettings search = {};
  LevelSettings levels = {};
  PassSettings passes = SplitPasses{};
  Occluders occluders = {};
  static const SettingsTable<BackprojectionSettings>& table();
  void check() const;
};

}  // namespace limen::techniques
