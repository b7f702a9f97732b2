// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace limen::visibility_fields {

/// Triangles traced on the CPU by Embree, robust traversal and best build quality (BL-01).
class ObjectRays {
 public:
  /// Throws std::runtime_error if Embree fails.
  ObjectRays(const std::vector<glm::vec3>& vertices, const std::vector<glm::uvec3>& triangles);

  /// Rays that are traced together.
  static constexpr size_t kPacketRays = 16;
  /// Distances along unit directions, kPacketRays at most, up to `far`; -1: none.
  void trace(glm::vec3 from, std::span<const glm::vec3> directions, float far, float* distances) const;

 private:
  struct ReleaseDevice {
    void operator()(RTCDeviceTy* device) const;
  };
  struct ReleaseScene {
    void operator()(RTCSceneTy* scene) const;
  };
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene_;
};

}  // namespace limen::visibility_fields
