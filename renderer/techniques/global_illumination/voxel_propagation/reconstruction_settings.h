// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/gl/program.h"

namespace limen::techniques {

/// Which voxels a pixel's light is interpolated between.
struct VisibleWeights {
  static constexpr const char *kKind = "visible",
                              *kSummary =
                                  "occupied voxels whose lit faces a ray finds, where another wall is near";
  /// Light of the nearest voxel seen within 2 errs 3 % less than none in the mean of 11 scenes with such
  /// points, from 13 % less to 5 % more, and within 4 by 4 %, at several times the rays. That of the nearest
  /// voxel, whether seen or not, is too bright in corners.
  int widest = 2;
  static const SettingsTable<VisibleWeights>& table();
};
struct OccupiedWeights {
  static constexpr const char *kKind = "occupied",
                              *kSummary = "occupied voxels; light behind a thin wall leaks past it";
};
struct AllWeights {
  static constexpr const char *kKind = "all", *kSummary = "all voxels, as if empty ones were dark surfaces";
};
using GatherWeights = std::variant<VisibleWeights, OccupiedWeights, AllWeights>;

enum class GatherForm {
  Faces,     ///< light at each face, by the squares of the normal's components
  Incident,  ///< lobes that have arrived (Gaitatzes 2012, equation 14)
  Reflected  ///< lobes that the voxel reflects, of its own mean reflectance
};
constexpr EnumNames<GatherForm, 3> enumNames(GatherForm) {
  return {{{{GatherForm::Faces, "faces"},
            {GatherForm::Incident, "incident"},
            {GatherForm::Reflected, "reflected"}}}};
}

struct ReconstructionSettings {
  GatherForm from = GatherForm::Faces;
  GatherWeights weights;
  static const SettingsTable<ReconstructionSettings>& table();
  /// For gather_light.glsl.
  void define(gl::ShaderDefines& defines) const;
};

}  // namespace limen::techniques
