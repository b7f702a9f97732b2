// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/technique.h"

namespace limen::techniques {

std::string toText(ProductKind kind) {
  switch (kind) {
    case ProductKind::Visibility:
      return "visibility";
    case ProductKind::Colour:
      return "colour";
    case ProductKind::Threshold:
      return "threshold";
    case ProductKind::LightColour:
      return "light_colour";
    case ProductKind::VisibilityChange:
      return "visibility_change";
    case ProductKind::JndMap:
      return "jnd_map";
    case ProductKind::Stream:
      return "stream";
  }
  return {};
}

}  // namespace limen::techniques
