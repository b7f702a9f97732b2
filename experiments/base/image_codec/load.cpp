// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/image_codec/functions.h"
#include "experiments/base/load_module.h"

namespace limen::codec {

const Functions& functions() {
  static const Functions* const kLoaded =
      reinterpret_cast<Entry>(loadModule(LIMEN_IMAGE_CODEC, kEntry, "read or write image files"))();
  return *kLoaded;
}

}  // namespace limen::codec
