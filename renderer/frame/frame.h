// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>

#include "renderer/frame/gpu_scene.h"
#include "renderer/gl/context.h"
#include "renderer/gl/pass_list.h"
#include "renderer/scene/scene.h"

namespace limen::frame {

class Frame;

/// Something several techniques need of a frame: a G-buffer channel, a shadow map, a pyramid. Made the first
/// time a frame asks for it and never otherwise; its memory is kept for the next frame.
class FrameInput {
 public:
  virtual ~FrameInput() = default;
  /// Renders the input for the current frame; opens its own passes and states their bytes.
  virtual void make(Frame& frame) = 0;
};

/// One view of one scene, rendered over and over. Inputs are asked for by type:
/// `frame.get<ShadowMap>(settings)`. An input class has a constructor (Frame&, Settings...) and each setting
/// has `std::string key() const`.
class Frame {
 public:
  Frame(gl::Context& context, const scene::Scene& scene, const GpuScene& gpuScene, glm::ivec2 sizePx,
        double timeS = 0.0);

  gl::Context& context() { return context_; }
  const scene::Scene& scene() const { return scene_; }
  const GpuScene& gpuScene() const { return gpuScene_; }
  glm::ivec2 sizePx() const { return sizePx_; }
  const scene::Camera& camera() const { return camera_; }
  gl::PassList& passes() { return passes_; }

  /// Camera space (looking along -z) of positions relative to the scene's anchor.
  const glm::dmat4& anchorToCamera() const { return anchorToCamera_; }
  /// tan of half the vertical field of view, and width over height.
  double tanHalfFov() const { return tanHalfFov_; }
  double aspect() const { return double(sizePx_.x) / sizePx_.y; }

  /// Starts a frame: inputs are stale and will be made again when asked for.
  void begin();
  void end();

  template <class Input, class... Settings>
  const Input& get(const Settings&... settings) {
    std::string key = Input::kName;
    ((key += "|" + settings.key()), ...);
    Entry& entry = entries_[key];
    if (!entry.input) entry.input = std::make_unique<Input>(*this, settings...);
    if (entry.madeIn != number_) {
      entry.madeIn = number_;  // before make(): an input that asks for itself is a programmer error
      entry.input->make(*this);
    }
    return static_cast<const Input&>(*entry.input);
  }

 private:
  struct Entry {
    std::unique_ptr<FrameInput> input;
    uint64_t madeIn = 0;
  };

  gl::Context& context_;
  const scene::Scene& scene_;
  const GpuScene& gpuScene_;
  glm::ivec2 sizePx_;
  scene::Camera camera_;
  glm::dmat4 anchorToCamera_;
  double tanHalfFov_;
  gl::PassList passes_;
  std::map<std::string, Entry> entries_;
  uint64_t number_ = 0;
};

}  // namespace limen::frame
