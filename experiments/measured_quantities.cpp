// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/measured_quantities.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace limen::experiments {
namespace {

const store::QuantityRow* find(const std::string& name) {
  const std::vector<store::QuantityRow>& common = commonQuantities();
  const auto row = std::find_if(common.begin(), common.end(),
                                [&](const store::QuantityRow& one) { return one.name == name; });
  return row == common.end() ? nullptr : &*row;
}

}  // namespace

const std::vector<store::QuantityRow>& commonQuantities() {
  constexpr Direction kLower = Direction::LowerIsBetter, kNeither = Direction::Neither;
  // Name, title, unit, direction, kind, pass whose median frame time it is, source.
  static const std::vector<store::QuantityRow> kCommon = {
      {"gpu_ms", "GPU time", "ms", kLower, "time", "frame", ""},
      {"gpu_ms_p95", "Frame time, 95th percentile", "ms", kLower, "time", "", ""},
      {"technique_ms", "Frame time without the G-buffer", "ms", kLower, "time", "", ""},
      {"wall_ms", "Wall time", "ms", kLower, "time", "wall", ""},
      {"cpu_ms", "CPU time", "ms", kLower, "time", "cpu", ""},
      {"prepare_ms", "Preparation time", "ms", kLower, "time", "", ""},
      {"first_picture_ms", "Time to the first picture", "ms", kLower, "time", "", "Roger 2008, section 3.4"},
      {"first_picture_compile_ms", "Time to the first picture: shaders", "ms", kLower, "time", "", ""},
      {"first_picture_upload_ms", "Time to the first picture: scene to the GPU", "ms", kLower, "time", "",
       ""},
      {"timed_frames", "Timed frames", "", kNeither, "fact", "", ""},
      {"bytes_held", "Memory used", "byte", kLower, "fact", "", ""},
      {"non_finite_count", "Non-finite values", "", kLower, "error", "", ""},
      {"gpu_clock_mhz", "GPU clock", "MHz", kNeither, "fact", "", ""},
      {"error_png_white", "White of the error's picture", "", kNeither, "fact", "", ""},
      {"relative_error_png_white", "White of the relative error's picture", "", kNeither, "fact", "", ""},
      {"threshold_png_black", "Black of the threshold's picture", "cd/m2", kNeither, "fact", "", ""},
      {"threshold_png_white", "White of the threshold's picture", "cd/m2", kNeither, "fact", "", ""},
      {"jnd_png_white", "White of the picture of visible differences", "JND", kNeither, "fact", "", ""},
      {"jnd_change_png_white", "White of the picture of visible changes", "JND", kNeither, "fact", "", ""},
      {"product_png_white", "White of the product's picture", "", kNeither, "fact", "", ""}};
  return kCommon;
}

bool isCommonQuantity(const std::string& name) { return find(name) != nullptr; }

store::Measurement measured(const std::string& name, std::optional<double> value) {
  const store::QuantityRow* row = find(name);
  assert(row != nullptr && "measured without a declaration");
  return {name, value, row->unit, row->kind};
}

double noiseOfDifference(double deviation, int64_t pixels) {
  constexpr double kNormal95 = 1.959964;
  return kNormal95 * 2.0 * deviation / std::sqrt(static_cast<double>(pixels));
}

}  // namespace limen::experiments
