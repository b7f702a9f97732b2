// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/painted_budget.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/image_file.h"

namespace limen::techniques {
namespace {

/// Source pixels and weights of one sample along an axis.
struct Taps {
  int first = 0;
  std::vector<double> weights;  // sum 1
};

/// `scale`: source pixels to a pixel; `offset`: where the source begins, in its own pixels.
std::vector<Taps> tapsOf(int from, int to, double scale, double offset) {
  std::vector<Taps> out(static_cast<size_t>(to));
  const double reach = std::max(scale, 1.0);
  for (int i = 0; i < to; ++i) {
    Taps& taps = out[static_cast<size_t>(i)];
    // Within the image, so that some texel is always within reach.
    const double centre = std::clamp((i + 0.5) * scale + offset, 0.5, from - 0.5);
    taps.first = std::max(0, static_cast<int>(std::ceil(centre - reach - 0.5)));
    double sum = 0.0;
    for (int j = taps.first; j < from && j + 0.5 <= centre + reach; ++j) {
      taps.weights.push_back(1.0 - std::abs(j + 0.5 - centre) / reach);
      sum += taps.weights.back();
    }
    for (double& weight : taps.weights) weight /= sum;
  }
  return out;
}

/// The mean of an RGB image's channels, which are equal for grey paint.
Image greyOf(const ImageFile& file) {
  const Image& image = file.image;
  Image grey(image.width, image.height, 1);
  for (size_t i = 0; i < grey.pixels(); ++i) {
    float sum = 0.0F;
    for (int c = 0; c < image.channels; ++c)
      sum += image.data[i * static_cast<size_t>(image.channels) + static_cast<size_t>(c)];
    const float mean = sum / static_cast<float>(image.channels);
    if (!std::isfinite(mean))
      throw Error("the painted weights contain values that are not numbers", file.path,
                  "save them as greys from 0 to 1");
    grey.data[i] = std::clamp(mean, 0.0F, 1.0F);
  }
  return grey;
}

class PaintedBudgetDriver : public BudgetDriver {
 public:
  explicit PaintedBudgetDriver(const PaintedBudget& settings) : settings_(settings) {}

  /// The map does not depend on the frame, so it is made here.
  void prepare(frame::Frame& frame) override {
    Image weights;
    try {
      weights = paintedWeights(greyOf(readImageFile(settings_.file.path)), frame.sizePx(), settings_.fit);
    } catch (const Error& error) {
      throw Error(error.message(), error.where().empty() ? settings_.file.path : error.where(), error.hint());
    }
    const double least = std::sqrt(static_cast<double>(settings_.black)),
                 most = std::sqrt(static_cast<double>(settings_.white));
    for (float& weight : weights.data) {
      const double root = least + (most - least) * weight;
      weight = static_cast<float>(root * root);
    }
    map_.emplace(gl::Format::R32F, frame.sizePx());
    map_->write(weights);
    frame.passes().setBytesHeld("soft_shadows/budget_map", map_->bytes());
  }

  const gl::Texture& make(frame::Frame&) override { return *map_; }

 private:
  PaintedBudget settings_;
  std::optional<gl::Texture> map_;
};

}  // namespace

Image paintedWeights(const Image& grey, glm::ivec2 sizePx, PaintedFit fit) {
  glm::dvec2 scale(double(grey.width) / sizePx.x, double(grey.height) / sizePx.y), offset(0.0);
  // An image made for this aspect ratio has integer sides: each may be off by half a pixel.
  const double across = double(grey.width) * sizePx.y, along = double(grey.height) * sizePx.x;
  if (fit == PaintedFit::Refuse && std::abs(across - along) > 0.5 * (sizePx.x + sizePx.y))
    throw Error("the painted image has " + std::to_string(grey.width) + " x " + std::to_string(grey.height) +
                    " pixels, another aspect ratio than the frame's " + std::to_string(sizePx.x) + " x " +
                    std::to_string(sizePx.y),
                {}, "choose fit: stretch or cover, or paint it with the frame's aspect ratio");
  if (fit == PaintedFit::Cover) {
    const glm::dvec2 source(grey.width, grey.height);
    scale = glm::dvec2(std::min(scale.x, scale.y));
    offset = 0.5 * (source - scale * glm::dvec2(sizePx));
  }
  const std::vector<Taps> columns = tapsOf(grey.width, sizePx.x, scale.x, offset.x),
                          rows = tapsOf(grey.height, sizePx.y, scale.y, offset.y);
  std::vector<double> wide(static_cast<size_t>(sizePx.x) * static_cast<size_t>(grey.height));
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < sizePx.x; ++x) {
      const Taps& taps = columns[static_cast<size_t>(x)];
      double sum = 0.0;
      for (size_t k = 0; k < taps.weights.size(); ++k)
        sum += taps.weights[k] * grey.at(taps.first + static_cast<int>(k), y);
      wide[static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x)] = sum;
    }
  Image out(sizePx.x, sizePx.y, 1);
  for (int y = 0; y < sizePx.y; ++y) {
    const Taps& taps = rows[static_cast<size_t>(y)];
    for (int x = 0; x < sizePx.x; ++x) {
      double sum = 0.0;
      for (size_t k = 0; k < taps.weights.size(); ++k)
        sum += taps.weights[k] * wide[(static_cast<size_t>(taps.first) + k) * static_cast<size_t>(sizePx.x) +
                                      static_cast<size_t>(x)];
      out.at(x, y) = static_cast<float>(std::clamp(sum, 0.0, 1.0));
    }
  }
  return out;
}

std::unique_ptr<BudgetDriver> makeBudgetDriver(const PaintedBudget& settings) {
  return std::make_unique<PaintedBudgetDriver>(settings);
}

}  // namespace limen::techniques
