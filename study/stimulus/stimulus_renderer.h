// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "experiments/base/image.h"
#include "perception/vision/display.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"
#include "study/stimulus/stimulus.h"
#include "study/stimulus/stimulus_scene.h"
#include "study/stimulus/timeline.h"

namespace limen::study {

class StateView;

/// Renders a stimulus into exactly the bytes sent to a display with a profile: supersampled, coded by its
/// transfer curve to the nearest of 256 codes, not dithered. Anything brighter than the display's white is
/// white. The same stimulus gives the same bytes on the same machine.
///
/// A dynamic sequence moves along the scene's path from frame to frame, a static one shows two pictures of
/// one time. See Timeline for which frame shows what.
class StimulusRenderer {
 public:
  /// Compiles and allocates everything render() needs. `scenes`, if given, caches scenes for other renderers.
  /// Throws Error like timelineOf(), buildStimulusScene() and StateView.
  StimulusRenderer(gl::Context& context, const Stimulus& stimulus, glm::ivec2 sizePx,
                   const perception::DisplayProfile& display, SceneCache* scenes = nullptr);
  ~StimulusRenderer();
  StimulusRenderer(const StimulusRenderer&) = delete;
  StimulusRenderer& operator=(const StimulusRenderer&) = delete;

  const Stimulus& stimulus() const { return stimulus_; }
  const Timeline& timeline() const { return timeline_; }
  const frame::SceneOnGpu& scene() const { return *scene_; }
  glm::ivec2 sizePx() const { return sizePx_; }
  int frameCount() const { return timeline_.frames; }

  /// Frames that look alike because nothing moves share a picture. Pictures are numbered in order of their
  /// first frames.
  int pictureCount() const { return static_cast<int>(firstFrames_.size()); }
  int pictureOf(int frame) const { return pictureOf_[static_cast<size_t>(frame)]; }
  int firstFrameOf(int picture) const { return firstFrames_[static_cast<size_t>(picture)]; }

  /// RGBA8 of the window's size, row 0 at the top, values as sent to the display, alpha 1. Valid until the
  /// next render.
  const gl::Texture& render(int frame);
  /// The state before or after the change at any time on the scene's path.
  const gl::Texture& renderState(double sceneTimeS, bool after);
  /// The same read back: 3 channels, codes over 255. Waits for the GPU.
  Image readBack(int frame);
  Image readBackState(double sceneTimeS, bool after);

 private:
  gl::Context& context_;
  Stimulus stimulus_;
  Timeline timeline_;
  glm::ivec2 sizePx_;
  std::shared_ptr<const frame::SceneOnGpu> scene_;
  std::unique_ptr<StateView> views_[2];  // before, after; for a sequence without change only the one shown
  std::vector<int> pictureOf_, firstFrames_;
  gl::Texture thresholds_, coded_;
};

}  // namespace limen::study
