// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/surfaces/trim_test.h"

namespace limen::techniques {

// Where techniques look up what is left of trimmed surfaces.
struct TrimByTexture {
  static constexpr const char *kKind = "texture", *kSummary = "in a texture over each surface's parameters";
  surfaces::TrimTexture content = surfaces::TrimTexture::Distance;
  int resolution = 256;
  static const SettingsTable<TrimByTexture>& table();
  surfaces::TrimMaskSettings mask() const { return {content, resolution}; }
};
struct TrimByCurves {
  static constexpr const char *kKind = "curves", *kSummary = "by the curves themselves";
};

}  // namespace limen::techniques
