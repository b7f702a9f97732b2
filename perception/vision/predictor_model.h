// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"

namespace limen::perception {

/// Complete choices of settings of a model of vision. The name sets the defaults of all others; see
/// PoppingSettings::preset() and ThresholdMapSettings::preset().
enum class PredictorModel {
  Limen2026,    ///< castleCSF in absolute units
  Schwarz2009,  ///< the thesis's choices
};
constexpr EnumNames<PredictorModel, 2> enumNames(PredictorModel) {
  return {{{{PredictorModel::Limen2026, "limen_2026"}, {PredictorModel::Schwarz2009, "schwarz_2009"}}}};
}

}  // namespace limen::perception
