// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/compute_raster.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// Which triangle each pixel's centre sees: the only raster pass of the G-buffer. All channels are computed
/// from it in compute shaders by intersecting the pixel's ray with the triangle, which is both faster and
/// more exact than interpolated attributes.
class TriangleIds : public FrameInput {
 public:
  static constexpr const char* kName = "triangle_ids";
  static constexpr uint32_t kNone = 0xffffffffU;

  explicit TriangleIds(Frame& frame);
  void make(Frame& frame) override;
  /// R32UI; kNone: background.
  const gl::Texture& texture() const {
    return given_ ? *given_ : hardware_ ? hardware_->ids : compute_->ids();
  }
  /// The depth that decided visibility: near / distance along the view (reversed), 0: background. One channel
  /// of 32-bit float, to be read by texelFetch. Of two triangles at the same depth the one with the smaller
  /// index is seen. The near plane depends only on scene and camera, so depths of two level selections are
  /// comparable. Absent if the frame was given what it sees.
  const gl::Texture& depth() const { return hardware_ ? hardware_->depth : compute_->depth(); }

 private:
  struct HardwareTarget {
    const gl::Program& program;
    gl::Texture ids, depth;
    gl::Framebuffer framebuffer;
  };
  const gl::Texture* given_ = nullptr;
  std::unique_ptr<HardwareTarget> hardware_;
  std::unique_ptr<ComputeRaster> compute_;
};

/// Projection of a camera's view of positions relative to the anchor: reversed depth, no far plane, so that
/// float keeps its relative precision at any distance. Depth is nearPlane(frame) / distance along the view.
glm::mat4 anchorToClip(const Frame& frame);
/// A small part of the distance to the scene, whatever the scene's scale.
double nearPlane(const Frame& frame);

/// G-buffer channels, each a separate input.
enum class Channel {
  Position,  ///< RGBA32F: position relative to the scene's anchor, w = 1; background 0
  Normal,    ///< RGBA32F: unit geometric normal turned to the camera; background 0
  Albedo,    ///< RGBA8: linear reflectance, a = 1; background 0
  Depth      ///< R32F: linear distance along the view direction; background 0
};

struct ChannelSetting {
  Channel channel;
  std::string key() const;
};

class GBufferChannel : public FrameInput {
 public:
  static constexpr const char* kName = "g_buffer";
  GBufferChannel(Frame& frame, ChannelSetting setting);
  void make(Frame& frame) override;
  const gl::Texture& texture() const { return texture_; }

 private:
  ChannelSetting setting_;
  const gl::Program& program_;
  gl::Texture texture_;
};

/// Points that a light may reach, in light space. RGBA32F: xyz = position (light centre at the origin,
/// z along its direction); w >= 0: sum over both axes of |d z / d(x/z)| of the surface's plane, the depth
/// slope that biases need; w = -1: not a receiver (background, behind the light's plane, or turned away from
/// the light's centre; every pixel of a scene without a light).
class Receivers : public FrameInput {
 public:
  static constexpr const char* kName = "receivers";
  explicit Receivers(Frame& frame);
  void make(Frame& frame) override;
  const gl::Texture& texture() const { return texture_; }

 private:
  const gl::Program& program_;
  gl::Texture texture_;
};

}  // namespace limen::frame
