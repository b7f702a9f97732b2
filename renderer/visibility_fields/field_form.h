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

// Of the parameters that all techniques over fields have.
template <class S>
Binding<S> positionMapBinding(PositionForm S::*member) {
  return {member, "position_map", "How positions are spread over the bounding sphere",
          "Gaitatzes 2012, section 4.4.3"};
}
template <class S>
Binding<S> positionsBinding(int S::*member) {
  return {member,
          "positions",
          oneOf({82, 290, 1090, 4226, 16642}),
          "",
          "Positions on the sphere; of a grid or a box the nearest number that it allows",
          "Gaitatzes 2012, Fig. 35"};
}
template <class S>
Binding<S> directionMapBinding(DirectionForm S::*member) {
  return {member, "direction_map", "How directions are spread over the texels of a position's map",
          "Gaitatzes 2012, section 4.4.4"};
}
template <class S>
Binding<S> directionsBinding(int S::*member) {
  return {member,
          "directions",
          oneOf({8, 16, 32, 64, 128, 256}),
          "texels",
          "Directions along each side of a position's map",
          "Gaitatzes 2012, Fig. 35"};
}

/// What a field is made of: directions x directions rays from each position, each stored in some bits.
struct FieldForm {
  PositionForm positionMap = PositionForm::Lattice;
  int positions = 1090;
  DirectionForm directionMap = DirectionForm::Concentric;
  int directions = 32;
  int bits = 8;
  /// Bits of the distance within `bits`; the rest holds the normal of what is hit. 0: all, and no normal.
  /// With normals `bits` is 32. Not of the table.
  int distanceBits = 0;
  static const SettingsTable<FieldForm>& table();

  /// Of a map's row: texels packed from the lowest bits on.
  int wordsPerRow() const { return (directions * bits + 31) / 32; }
  /// FIELD_* but for the slices' side: see VisibilityFields::defines().
  gl::ShaderDefines defines() const;
};

}  // namespace limen::visibility_fields
