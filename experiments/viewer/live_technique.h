// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/executor.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/pass_list.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {

/// Times of a pass, median over the frames timed together.
struct PassFigure {
  std::string name;
  double ms = -1.0;  ///< < 0: not timed
  int64_t bytes = 0;
};

/// One technique being viewed: made for a scene and an image size, then rendered and timed frame by frame.
class LiveTechnique {
 public:
  /// Constructs, prepares and renders one frame, as a sweep does. Throws what the technique throws.
  LiveTechnique(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx,
                const experiments::Configuration& choice);

  /// Renders and times up to `frames` frames, at least one, no more than fit in `seconds`; the camera is
  /// where the scene's is.
  void render(int frames, double seconds);

  const techniques::TechniqueInfo& info() const { return info_; }
  techniques::Technique& technique() { return *technique_; }
  frame::Frame& frame() { return frame_; }
  double prepareMs() const { return prepareMs_; }
  /// Of the frames that render() last timed.
  double frameMs() const { return frameMs_; }
  std::vector<PassFigure> passes();
  bool onCpu() const { return clock_ == gl::Clock::Wall; }
  int64_t framesRendered() const { return framesRendered_; }

 private:
  void renderFrame();

  const techniques::TechniqueInfo& info_;
  std::unique_ptr<techniques::Technique> technique_;
  frame::Frame frame_;
  gl::Clock clock_;
  double prepareMs_ = -1.0, frameMs_ = -1.0;
  std::map<std::string, double> passMs_;
  int64_t framesRendered_ = 0;
};

}  // namespace limen::viewer
