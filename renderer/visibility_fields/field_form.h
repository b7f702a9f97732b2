// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/gl/shader_source.h"
#include "renderer/visibility_fields/position_map.h"

namespace limen::visibility_fields {

/// How directions are spread over the texels of a map (Gaitatzes 2012, section 4.4.4).
enum class DirectionForm { Polar, Rejection, Concentric };
constexpr EnumNames<DirectionForm, 3> enumNames(DirectionForm) {
  return {{{{DirectionForm::Polar, "polar"},
            {DirectionForm::Rejection, "rejection"},
            {DirectionForm::Concentric, "concentric"}}}};
}

/// What a field is made of: directions x directions rays from each position, each stored in some bits.
struct FieldForm {
  PositionForm positionMap = PositionForm::Lattice;
  int positions = 1090;
  DirectionForm directionMap = DirectionForm::Concentric;
  int directions = 32;
  int bits = 8;
  static const SettingsTable<FieldForm>& table();

  /// Of a map's row: texels packed from the lowest bits on.
  int wordsPerRow() const { return (directions * bits + 31) / 32; }
  /// FIELD_* for shaders that read or make fields.
  gl::ShaderDefines defines() const;
};

}  // namespace limen::visibility_fields
