// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/video_codec/functions.h"
#include "experiments/base/video_codec/quiet.h"

extern "C" const limen::codec::VideoFunctions* limenVideoCodec();

// Named by codec::kVideoEntry.
extern "C" const limen::codec::VideoFunctions* limenVideoCodec() {
  static constexpr limen::codec::VideoFunctions kFunctions{&limen::codec::openVideo,
                                                           &limen::codec::createVideo};
  limen::codec::quietLibraries();
  return &kFunctions;
}
