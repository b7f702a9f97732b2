// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/load_module.h"
#include "perception/image_analysis/functions.h"

namespace limen::perception::analysis {

const Functions& functions() {
  static const Functions* const kLoaded = reinterpret_cast<Entry>(
      loadModule(LIMEN_IMAGE_ANALYSIS, kEntry, "find connected components or motion in images"))();
  return *kLoaded;
}

}  // namespace limen::perception::analysis
