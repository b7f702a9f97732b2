// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/field_form.h"

#include <string>

#include "renderer/visibility_fields/map_functions.h"

namespace limen::visibility_fields {

static_assert(static_cast<int>(PositionForm::Lattice) == kFieldLattice &&
              static_cast<int>(PositionForm::Grid) == kFieldGrid &&
              static_cast<int>(PositionForm::Box) == kFieldBox);
static_assert(static_cast<int>(DirectionForm::Polar) == kFieldPolar &&
              static_cast<int>(DirectionForm::Rejection) == kFieldRejection &&
              static_cast<int>(DirectionForm::Concentric) == kFieldConcentric);

const SettingsTable<FieldForm>& FieldForm::table() {
  using S = FieldForm;
  static const SettingsTable<S> kTable = {
      positionMapBinding(&S::positionMap),
      positionsBinding(&S::positions),
      directionMapBinding(&S::directionMap),
      directionsBinding(&S::directions),
      {&S::bits, "bits", oneOf({1, 8, 16, 32}), "bit",
       "Storage of a ray: 32 is a float; 1 tells hit from miss, with a mean distance for each position",
       "Gaitatzes 2012, section 4.6"}};
  return kTable;
}

gl::ShaderDefines FieldForm::defines() const {
  const PositionMap map(positionMap, positions);
  return {{"FIELD_POSITION_FORM", std::to_string(static_cast<int>(positionMap))},
          {"FIELD_SEGMENTS", std::to_string(map.segments())},
          {"FIELD_POSITIONS", std::to_string(map.points().size())},
          {"FIELD_DIRECTION_FORM", std::to_string(static_cast<int>(directionMap))},
          {"FIELD_SIDE", std::to_string(directions)},
          {"FIELD_BITS", std::to_string(bits)},
          {"FIELD_DISTANCE_BITS", std::to_string(distanceBits == 0 ? bits : distanceBits)}};
}

}  // namespace limen::visibility_fields
