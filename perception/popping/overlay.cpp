// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/overlay.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "experiments/base/error.h"
#include "perception/vision/colour.h"

namespace limen::perception {
namespace {

using Colour = std::array<double, 3>;

constexpr double kLowRating = 0.0, kHighRating = 4.0;
constexpr std::array<Colour, 5> kStops = {
    {{0.23, 0.36, 0.75}, {0.16, 0.66, 0.55}, {0.98, 0.87, 0.25}, {0.94, 0.46, 0.13}, {0.62, 0.04, 0.15}}};
constexpr int kLegendHeight = 30, kLeastLegendWidth = 120, kMargin = 12;

/// Digits and R, five rows of three bits, the left one first.
const std::array<uint8_t, 5>* glyphOf(char character) {
  static const std::array<uint8_t, 5> kDigits[] = {
      {7, 5, 5, 5, 7}, {2, 6, 2, 2, 7}, {7, 1, 7, 4, 7}, {7, 1, 7, 1, 7}, {5, 5, 7, 1, 1}};
  static const std::array<uint8_t, 5> kR = {6, 5, 6, 5, 5};
  if (character == 'R') return &kR;
  return character >= '0' && character <= '4' ? &kDigits[character - '0'] : nullptr;
}

void setPixel(Image& image, int x, int y, const Colour& colour) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(colour[static_cast<size_t>(c)]);
}

/// Centred on x, two pixels to a dot.
void drawGlyph(Image& image, char character, int x, int y) {
  const auto* glyph = glyphOf(character);
  if (!glyph) return;
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column < 6; ++column)
      if ((*glyph)[static_cast<size_t>(row / 2)] >> (2 - column / 2) & 1)
        setPixel(image, x - 3 + column, y + row, {0.9, 0.9, 0.9});
}

void drawLegend(Image& image, int top) {
  const int left = kMargin + 16, width = image.width - kMargin - left;
  for (int y = top; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) setPixel(image, x, y, {0.1, 0.1, 0.1});
  drawGlyph(image, 'R', kMargin, top + 3);
  for (int x = 0; x < width; ++x) {
    const double rating = kLowRating + (kHighRating - kLowRating) * x / (width - 1);
    for (int y = 0; y < 10; ++y) setPixel(image, left + x, top + 3 + y, ratingColour(rating));
  }
  for (int rating = 0; rating <= 4; ++rating) {
    const int x = left + (width - 1) * rating / 4;
    setPixel(image, x, top + 13, {0.9, 0.9, 0.9});
    drawGlyph(image, static_cast<char>('0' + rating), x, top + 16);
  }
}

}  // namespace

Colour ratingColour(double rating) {
  if (std::isnan(rating)) rating = kLowRating;
  const double place = std::clamp(rating - kLowRating, 0.0, kHighRating - kLowRating);
  const auto stop = static_cast<size_t>(std::min(place, kHighRating - kLowRating - 1.0));
  const double t = place - static_cast<double>(stop);
  Colour out{};
  for (size_t c = 0; c < 3; ++c) out[c] = (1.0 - t) * kStops[stop][c] + t * kStops[stop + 1][c];
  return out;
}

int legendHeightPx(int width) { return width >= kLeastLegendWidth ? kLegendHeight : 0; }

Image poppingOverlay(const Image& context, const RegionMap& regions, const OverlayOptions& options) {
  if (context.width != regions.width || context.height != regions.height)
    throw Error("the picture has " + std::to_string(context.width) + " x " + std::to_string(context.height) +
                    " pixels, the regions " + std::to_string(regions.width) + " x " +
                    std::to_string(regions.height),
                "popping", "give the picture that the regions were found in");
  const int legend = options.legend ? legendHeightPx(context.width) : 0;
  Image out(context.width, context.height + legend, 3);
  for (int y = 0; y < context.height; ++y)
    for (int x = 0; x < context.width; ++x) {
      Colour rgb{};
      for (int c = 0; c < 3; ++c) {
        const double value = context.at(x, y, context.channels < 3 ? 0 : c);
        rgb[static_cast<size_t>(c)] = std::isfinite(value) ? decodeSrgb(std::clamp(value, 0.0, 1.0)) : 0.0;
      }
      const double grey = encodeSrgb(relativeLuminance(rgb));
      const PoppingRegion* region = regions.at(x, y);
      Colour shown{grey, grey, grey};
      if (region) {
        const Colour colour = ratingColour(region->rating);
        for (size_t c = 0; c < 3; ++c)
          shown[c] = options.opacity * colour[c] + (1.0 - options.opacity) * grey;
      } else if (options.outlines) {
        bool beside = false;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) beside = beside || regions.at(x + dx, y + dy);
        if (beside) shown = {0.0, 0.0, 0.0};
      }
      setPixel(out, x, y, shown);
    }
  if (legend > 0) drawLegend(out, context.height);
  return out;
}

}  // namespace limen::perception
