// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/load_module.h"
#include "experiments/base/video_codec/functions.h"

namespace limen::codec {

const VideoFunctions& videoFunctions() {
  static const VideoFunctions* const kLoaded =
      reinterpret_cast<VideoEntry>(loadModule(LIMEN_VIDEO_CODEC, kVideoEntry, "read or write videos"))();
  return *kLoaded;
}

}  // namespace limen::codec
