// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/image_codec/functions.h"

extern "C" const limen::codec::Functions* limenImageCodec();

// Named by codec::kEntry.
extern "C" const limen::codec::Functions* limenImageCodec() {
  static constexpr limen::codec::Functions kFunctions{&limen::codec::readImage, &limen::codec::encodeExr,
                                                      &limen::codec::encodePng, &limen::codec::encodeJpeg,
                                                      &limen::codec::readImageFile};
  return &kFunctions;
}
