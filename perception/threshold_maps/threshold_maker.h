// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>

#include "renderer/gl/pass_list.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// Passes of all makers: levels of the image, and thresholds from these.
inline constexpr const char *kThresholdLevelsPass = "threshold_map/levels",
                            *kThresholdEvaluationPass = "threshold_map/evaluate";

/// Pixels of an image, `high` excluded.
struct MapArea {
  glm::ivec2 low{0}, high{0};
};

/// Makes one threshold for each pixel of images of one size and format, on the GPU.
class ThresholdMaker {
 public:
  virtual ~ThresholdMaker() = default;

  /// Allocates and compiles nothing and does not wait. `passes`: times levels and evaluation separately.
  /// `only`: thresholds within it suffice; others may be those of an earlier image.
  virtual const gl::Texture& run(const gl::Texture& linearColourOrLuminance, gl::PassList* passes = nullptr,
                                 const std::optional<MapArea>& only = {}) = 0;
  /// R32F, cd/m2.
  virtual const gl::Texture& map() const = 0;
  /// Intermediate results by name; all are valid until the next run().
  virtual std::map<std::string, const gl::Texture*> debugViews() const = 0;
  /// Of the pyramid.
  virtual int levels() const = 0;
  virtual int64_t bytesHeld() const = 0;
  /// Bytes that run() must move at least, each texture of each pass counted once.
  virtual int64_t bytesMoved(const gl::Texture& input) const = 0;

 protected:
  ThresholdMaker() = default;
  ThresholdMaker(const ThresholdMaker&) = delete;
  ThresholdMaker& operator=(const ThresholdMaker&) = delete;
};

}  // namespace limen::perception
