// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/error_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "perception/vision/colour.h"

namespace limen::perception {
namespace {

using Colour = std::array<float, 3>;

constexpr Colour kNonFinite = {0.0F, 1.0F, 0.0F};

/// Every 17th of the 256 published colours of magma (S. van der Walt and N. Smith, matplotlib 1.5, CC0);
/// linear interpolation stays within 0.012 of the omitted colours.
constexpr std::array<Colour, 16> kMagma = {{{0.001462F, 0.000466F, 0.013866F},
                                            {0.043830F, 0.033830F, 0.141886F},
                                            {0.123833F, 0.067295F, 0.295879F},
                                            {0.232077F, 0.059889F, 0.437695F},
                                            {0.341482F, 0.080564F, 0.492631F},
                                            {0.445163F, 0.122724F, 0.506901F},
                                            {0.550287F, 0.161158F, 0.505719F},
                                            {0.658483F, 0.196027F, 0.490253F},
                                            {0.767398F, 0.233705F, 0.457755F},
                                            {0.868793F, 0.287728F, 0.409303F},
                                            {0.944006F, 0.377643F, 0.365136F},
                                            {0.981000F, 0.498428F, 0.369734F},
                                            {0.994738F, 0.624350F, 0.427397F},
                                            {0.997228F, 0.747981F, 0.516859F},
                                            {0.993170F, 0.870024F, 0.626189F},
                                            {0.987053F, 0.991438F, 0.749504F}}};

Colour magma(double share) {
  const double position = std::clamp(share, 0.0, 1.0) * (kMagma.size() - 1);
  const size_t below = std::min(static_cast<size_t>(position), kMagma.size() - 2);
  const auto blend = static_cast<float>(position - static_cast<double>(below));
  Colour colour{};
  for (size_t c = 0; c < 3; ++c)
    colour[c] = kMagma[below][c] + blend * (kMagma[below + 1][c] - kMagma[below][c]);
  return colour;
}

void setPixel(Image& picture, size_t pixel, const Colour& colour) {
  std::copy(colour.begin(), colour.end(), picture.data.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
}

}  // namespace

double errorScale(const Image& map) {
  double largest = 0.0;
  for (const float value : map.data)
    if (std::isfinite(value)) largest = std::max(largest, double{value});
  if (largest <= 0.0) return 1.0;
  // One decade lower than needed at first, in case the logarithm is rounded up. A float's 0.2 is a little
  // over 0.2.
  const double decade = std::pow(10.0, std::floor(std::log10(largest)) - 1.0);
  for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0})
    if (factor * decade >= largest * (1.0 - 1e-6)) return factor * decade;
  return 100.0 * decade;
}

Image errorPicture(const Image& map, double scale) {
  assert(map.channels == 1);
  const double brightest = scale > 0.0 ? scale : errorScale(map);
  Image picture(map.width, map.height, 3);
  for (size_t pixel = 0; pixel < map.pixels(); ++pixel) {
    const double value = map.data[pixel];
    setPixel(picture, pixel, std::isfinite(value) ? magma(value / brightest) : kNonFinite);
  }
  return picture;
}

Image thresholdPicture(const Image& cdM2) {
  assert(cdM2.channels == 1);
  const double decades = std::log10(kThresholdPictureWhite / kThresholdPictureBlack);
  Image picture(cdM2.width, cdM2.height, 3);
  for (size_t pixel = 0; pixel < cdM2.pixels(); ++pixel) {
    const double value = cdM2.data[pixel];
    const double share = std::log10(std::max(value, 1e-30) / kThresholdPictureBlack) / decades;
    setPixel(picture, pixel, std::isfinite(value) ? magma(share) : kNonFinite);
  }
  return picture;
}

Image displayPicture(const Image& linear) {
  Image picture(linear.width, linear.height, 3);
  const auto channels = static_cast<size_t>(linear.channels);
  for (size_t pixel = 0; pixel < linear.pixels(); ++pixel) {
    Colour colour{};
    for (size_t c = 0; c < 3; ++c) {
      const float value = linear.data[pixel * channels + (channels < 3 ? 0 : c)];
      if (!std::isfinite(value)) {
        colour = kNonFinite;
        break;
      }
      colour[c] = static_cast<float>(encodeSrgb(std::clamp(double{value}, 0.0, 1.0)));
    }
    setPixel(picture, pixel, colour);
  }
  return picture;
}

}  // namespace limen::perception
