// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp/comparison_input.h"

#include <fmt/format.h>

#include "experiments/base/error.h"

namespace limen::perception::cvvdp {

void check(const Pair& pair, const Options& options) {
  constexpr int kLeastSide = 4;
  if (pair.width < kLeastSide || pair.height < kLeastSide)
    throw Error(fmt::format("ColorVideoVDP cannot evaluate {} x {} pixels", pair.width, pair.height), {},
                "give images of at least 4 x 4");
  if (pair.frames < 1) throw Error("ColorVideoVDP has no frames to evaluate", {}, "give one or more");
  constexpr double kMostFramesPerSecond = 1000.0;
  if (pair.frames > 1 && !(options.framesPerSecond > 0.0 && options.framesPerSecond <= kMostFramesPerSecond))
    throw Error("ColorVideoVDP needs the frame rate of a video", {}, "state it in frames per second, up to 1000");
  if (options.values == Values::Relative && !options.display.showsRelativeLight())
    throw Error(fmt::format("the display '{}' has the primaries of {}, not those of sRGB that rendered light "
                            "has",
                            options.display.name, options.display.colours.name),
                {}, "choose a display with sRGB or BT.709 primaries, or compare pixel values coded for it");
}

}  // namespace limen::perception::cvvdp
