// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <numbers>

#include "tests/perception/popping_gpu_fixture.h"

namespace limen::perception {
namespace {

/// Grey levels of light about `luminanceCdM2` on a display whose white is 1 cd/m2: gratings of three
/// frequencies, whose contrast falls along y.
Image gratings(double luminanceCdM2, double contrast) {
  Image image(64, 48, 1);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double wave = 0.0;
      for (const double periodPx : {4.0, 11.0, 29.0})
        wave += std::sin(2.0 * std::numbers::pi * (x + 0.1 * y) / periodPx) / 3.0;
      image.at(x, y) = static_cast<float>(luminanceCdM2 * (1.0 + contrast * (1.0 - y / 60.0) * wave));
    }
  return image;
}

DisplayProfile darkDisplay() {
  DisplayProfile display = studyDisplay();
  display.blackCdM2 = 0.0;
  display.peakCdM2 = 1.0;
  display.screenReflectance = 0.0;
  return display;
}

// castleCSF's transient mechanism sets in at .01128 cd/m2, with an infinite slope.
constexpr std::array<double, 21> kLuminances = {0.0100, 0.0105,  0.0110, 0.0112, 0.01125, 0.01127, 0.01129,
                                                0.0113, 0.01135, 0.0114, 0.0116, 0.0118,  0.0121,  0.0124,
                                                0.0127, 0.0130,  0.0141, 0.0143, 0.02,    0.045,   0.06};

TEST_F(PoppingGpu, DarkPicturesMatchTheReference) {
  for (const double luminance : kLuminances)
    for (const bool isSwitch : {false, true})
      for (const bool isFixed : {false, true}) {
        PoppingInput in = linearPair(gratings(luminance, 0.9), gratings(luminance, 0.2));
        in.isSwitch = isSwitch;
        PoppingSettings settings;
        if (isFixed) settings.adaptation = FixedAdaptation{luminance};
        const std::string what =
            std::to_string(luminance) + (isSwitch ? " switched" : "") + (isFixed ? " fixed" : "");
        const PoppingResult result = expectReference(in, what, settings, darkDisplay());
        EXPECT_GT(result.summary.largestJnd, 0.5);
      }
  RecordProperty("largest_error", std::to_string(largest_));
}

}  // namespace
}  // namespace limen::perception
