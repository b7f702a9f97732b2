// SPDX-License-Identifier: BSD-3-Clause
#include "perception/image_analysis/motion_compensation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "perception/image_analysis/optical_flow.h"

namespace limen::perception {
namespace {

/// The value at a place within the picture, in pixels from the first pixel's centre.
float valueAt(const Image& image, double x, double y, int channel) {
  const int left = std::min(static_cast<int>(x), image.width - 1),
            right = std::min(left + 1, image.width - 1);
  const int top = std::min(static_cast<int>(y), image.height - 1),
            bottom = std::min(top + 1, image.height - 1);
  const double u = x - left, v = y - top;
  const double above = (1.0 - u) * image.at(left, top, channel) + u * image.at(right, top, channel);
  const double below = (1.0 - u) * image.at(left, bottom, channel) + u * image.at(right, bottom, channel);
  return static_cast<float>((1.0 - v) * above + v * below);
}

}  // namespace

CompensatedFrame compensateMotion(const Image& before, const Image& now, const Image& flowBefore,
                                  const Image& flowNow) {
  assert(before.width == now.width && before.height == now.height && before.channels == now.channels);
  CompensatedFrame out;
  out.displacement = opticalFlow(flowBefore, flowNow);
  const Image back = opticalFlow(flowNow, flowBefore);
  out.picture = now;
  out.weight = Image(now.width, now.height, 1);
  for (int y = 0; y < now.height; ++y)
    for (int x = 0; x < now.width; ++x) {
      const double dx = out.displacement.at(x, y, 0), dy = out.displacement.at(x, y, 1);
      const double fromX = x - dx, fromY = y - dy;
      if (!(fromX >= 0.0 && fromY >= 0.0 && fromX <= now.width - 1 && fromY <= now.height - 1)) continue;
      const double returned =
          std::hypot(dx + valueAt(back, fromX, fromY, 0), dy + valueAt(back, fromX, fromY, 1));
      if (returned > 1.0 + 0.05 * std::hypot(dx, dy)) continue;
      out.weight.at(x, y) = 1.0F;
      for (int c = 0; c < before.channels; ++c) out.picture.at(x, y, c) = valueAt(before, fromX, fromY, c);
    }
  return out;
}

}  // namespace limen::perception
