// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/techniques/soft_shadows/map_source.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// What micro-occluders are accumulated in: a sum of areas, or a mask of light samples.
class Gathering {
 public:
  virtual ~Gathering() = default;
  /// Creates persistent data; returns the shader's defines.
  virtual gl::ShaderDefines prepare(frame::Frame& frame, const MapSource& maps) = 0;
  /// Binds and sets what the shader gathers with, for one of the maps.
  virtual void configure(const gl::Program& program, size_t map) const = 0;
  /// After the last map: combines the results of several maps in its own pass.
  virtual void join(frame::Frame&, const gl::Texture& /*visibility*/) {}
  /// May wait for the GPU.
  virtual std::vector<Counter> count(frame::Frame&) const { return {}; }
};

/// What turns the gathered visibility into the product.
class ProductStage {
 public:
  virtual ~ProductStage() = default;
  /// After the gathering's own finish.
  virtual void prepare(frame::Frame& frame) = 0;
  virtual void run(frame::Frame& frame, const gl::Texture& visibility) = 0;
  virtual const gl::Texture& product() const = 0;
  virtual std::vector<Counter> count() const { return {}; }
};

}  // namespace limen::techniques
