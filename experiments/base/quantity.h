// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "experiments/base/enum_names.h"

namespace limen {

/// Which values of a quantity are better. Neither: a plain fact or a setting.
enum class Direction { Neither, LowerIsBetter, HigherIsBetter };
constexpr EnumNames<Direction, 3> enumNames(Direction) {
  return {{{{Direction::Neither, "neither"},
            {Direction::LowerIsBetter, "lower"},
            {Direction::HigherIsBetter, "higher"}}}};
}

/// What a measured number means: declared once by whoever measures it, stored with the results, and read by
/// reports, tables and printing, which guess nothing from names.
struct Quantity {
  Quantity(std::string named) : name(std::move(named)) {}
  Quantity(const char* named) : name(named) {}
  Quantity(std::string named, std::string titled, std::string inUnit, Direction better, std::string from = {})
      : name(std::move(named)),
        title(std::move(titled)),
        unit(std::move(inUnit)),
        direction(better),
        source(std::move(from)) {}

  std::string name;   ///< snake_case: "micro_occluders_per_px"
  std::string title;  ///< as an axis label, without the unit: "Micro-occluders per pixel"
  std::string unit;   ///< "ms", "byte", "1/px"; "" for pure numbers
  Direction direction = Direction::Neither;
  std::string source;  ///< thesis section or paper; "" for the bench's own
};

/// The title, or the words of the name if there is none.
std::string titleOf(const Quantity& quantity);

}  // namespace limen
