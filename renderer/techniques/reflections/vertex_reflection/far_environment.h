// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "renderer/techniques/reflections/vertex_reflection/reflector.h"

namespace limen::techniques {

/// Cube map of what a reflector's centre sees beyond a distance, lit as from there: RGBA32F radiance, alpha 0
/// where nothing is.
class FarEnvironment {
 public:
  FarEnvironment(frame::Frame& frame, const StarReflector& reflector, const FarSurroundings& settings,
                 const frame::ShadedSetting& shading);
  ~FarEnvironment();
  FarEnvironment(FarEnvironment&& other) noexcept : id_(std::exchange(other.id_, 0)), bytes_(other.bytes_) {}
  FarEnvironment(const FarEnvironment&) = delete;
  FarEnvironment& operator=(const FarEnvironment&) = delete;
  void bindTexture(uint32_t unit) const;
  int64_t bytes() const { return bytes_; }

 private:
  uint32_t id_ = 0;
  int64_t bytes_ = 0;
};

}  // namespace limen::techniques
