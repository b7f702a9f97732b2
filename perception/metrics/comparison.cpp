// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/comparison.h"

#include <algorithm>

#include "experiments/base/error.h"
#include "perception/metrics/row_sums.h"

namespace limen::perception {
namespace {

std::string sizeText(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " x " +
         std::to_string(image.channels);
}

const Image& present(const Image* image, const std::string& metric, const char* role) {
  if (!image || image->data.empty())
    throw Error("metric '" + metric + "' has no " + role + " image", {}, "name a reference and render both");
  return *image;
}

double clampToDisplay(double value) { return std::clamp(value, 0.0, 1.0); }

}  // namespace

const SettingsTable<ComparedRegion>& ComparedRegion::table() {
  static const SettingsTable<ComparedRegion> kTable = {
      {&ComparedRegion::region, "region",
       "pixels to compare; penumbra: receivers whose reference visibility is between 0 and 1; reflectors: "
       "pixels that see a mirror"}};
  return kTable;
}

Comparison::Comparison(const ComparisonInput& input, const std::string& metric, Region region)
    : test_(present(input.test, metric, "test")),
      reference_(present(input.reference, metric, "reference")),
      mask_(input.mask),
      mirrors_(input.mirrors),
      region_(region) {
  if (input.depicts == Depicts::Items)
    throw Error("metric '" + metric + "' compares pictures; a stream of items is none", {},
                "use stream_mismatches, stream_set_mismatches or stream_count_difference");
  if (test_.width != reference_.width || test_.height != reference_.height ||
      test_.channels != reference_.channels)
    throw Error(
        "metric '" + metric + "' compares images of " + sizeText(test_) + " and " + sizeText(reference_), {},
        "give both the same size and kind");
  if (test_.channels == 2)
    throw Error("metric '" + metric + "' cannot compare images of 2 channels", {}, "give 1, 3 or 4 channels");
  if (mask_ && (mask_->width != test_.width || mask_->height != test_.height || mask_->channels != 1))
    throw Error("metric '" + metric + "': the mask is " + sizeText(*mask_) + ", the image " + sizeText(test_),
                {}, "give a mask of the same size with 1 channel");
  if (region == Region::Penumbra && channels() != 1)
    throw Error("metric '" + metric + "': a colour product has no penumbra", {},
                "use region: receivers or all");
  if (region == Region::Reflectors &&
      (!mirrors_ || mirrors_->width != test_.width || mirrors_->height != test_.height))
    throw Error("metric '" + metric + "': the scene has no mirrors, or they are not known here", {},
                "use region: receivers or all");
  const auto badIn = [&](int y) {
    double bad = 0.0;
    for (int x = 0; x < width(); ++x)
      for (int c = 0; c < channels(); ++c) bad += std::isfinite(reference_.at(x, y, c)) ? 0.0 : 1.0;
    return bad;
  };
  if (const double bad = sumRows(height(), static_cast<size_t>(width()), badIn); bad > 0.0)
    throw Error("metric '" + metric + "': the reference holds " + std::to_string(static_cast<int64_t>(bad)) +
                    " non-finite values",
                {}, "nothing can be evaluated against it: fix the reference");
  evaluatedPixels_ = static_cast<int64_t>(sumRows(height(), static_cast<size_t>(width()), [&](int y) {
    double evaluated = 0.0;
    for (int x = 0; x < width(); ++x) evaluated += evaluates(x, y) ? 1.0 : 0.0;
    return evaluated;
  }));
}

void Comparison::requireVisibility(const std::string& metric) const {
  if (channels() != 1)
    throw Error("metric '" + metric + "' evaluates visibility only, not colour", {},
                "remove it for techniques whose product is a colour image");
}

std::array<double, 3> Comparison::shownReference(int x, int y) const {
  if (channels() == 1) {
    const double grey = clampToDisplay(reference_.at(x, y));
    return {grey, grey, grey};
  }
  std::array<double, 3> shown{};
  for (int c = 0; c < 3; ++c) shown[static_cast<size_t>(c)] = clampToDisplay(reference_.at(x, y, c));
  return shown;
}

std::array<double, 3> Comparison::shownTest(int x, int y) const {
  std::array<double, 3> shown = shownReference(x, y);
  for (int c = 0; c < 3; ++c) {
    double& value = shown[static_cast<size_t>(c)];
    const float test = test_.at(x, y, std::min(c, channels() - 1));
    value = std::isfinite(test) ? clampToDisplay(test) : value < 0.5 ? 1.0 : 0.0;
  }
  return shown;
}

}  // namespace limen::perception
