// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "perception/metrics/metric.h"

namespace limen::perception {

/// Which pixels a metric evaluates.
enum class Region {
  All,        ///< every pixel
  Receivers,  ///< where the mask is set; every pixel without a mask
  Penumbra,   ///< receivers whose reference visibility lies strictly between 0 and 1
  Reflectors  ///< pixels that see a mirror (ComparisonInput::mirrors)
};

constexpr EnumNames<Region, 4> enumNames(Region) {
  return {{{{Region::All, "all"},
            {Region::Receivers, "receivers"},
            {Region::Penumbra, "penumbra"},
            {Region::Reflectors, "reflectors"}}}};
}

/// Settings of metrics that compare pixel by pixel.
struct ComparedRegion {
  Region region = Region::Receivers;
  static const SettingsTable<ComparedRegion>& table();
};

/// A checked pair of products and the region in which they are compared.
class Comparison {
 public:
  /// Throws Error if an image is missing, if the products are no pictures, if sizes or channels differ, if
  /// the reference has a non-finite value, if the penumbra is requested for a colour product, or reflectors
  /// where there are none to know of. `metric` is named in errors.
  Comparison(const ComparisonInput& input, const std::string& metric, Region region);

  /// Throws Error unless the products are visibility images.
  void requireVisibility(const std::string& metric) const;

  int width() const { return test_.width; }
  int height() const { return test_.height; }
  /// 1 or 3: alpha is not part of a product.
  int channels() const { return test_.channels < 3 ? 1 : 3; }
  const Image& test() const { return test_; }
  const Image& reference() const { return reference_; }
  int64_t evaluatedPixels() const { return evaluatedPixels_; }

  bool evaluates(int x, int y) const {
    if (region_ == Region::All) return true;
    if (region_ == Region::Reflectors) return mirrors_->at(x, y) > 0.5F;
    if (mask_ && !(mask_->at(x, y) > 0.5F)) return false;
    return region_ == Region::Receivers || (reference_.at(x, y) > 0.0F && reference_.at(x, y) < 1.0F);
  }
  /// test - reference. Non-finite test values: -1 for minus infinity, otherwise +1.
  double error(int x, int y, int channel) const {
    const double test = test_.at(x, y, channel);
    if (!std::isfinite(test)) return std::isinf(test) && test < 0.0 ? -1.0 : 1.0;
    return test - double{reference_.at(x, y, channel)};
  }
  /// What a display would show: linear RGB clamped to [0, 1]; visibility as grey. A non-finite test channel
  /// shows whichever of 0 and 1 is farther from the reference.
  std::array<double, 3> shownTest(int x, int y) const;
  std::array<double, 3> shownReference(int x, int y) const;

 private:
  const Image& test_;
  const Image& reference_;
  const Image* mask_;
  const Image* mirrors_;
  Region region_;
  int64_t evaluatedPixels_ = 0;
};

}  // namespace limen::perception
