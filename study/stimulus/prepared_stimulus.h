// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/gl/texture.h"
#include "study/stimulus/stimulus_renderer.h"

namespace limen::study {

/// Bytes that pictures may take: half of what the driver reports as free, or 1 GiB if it does not report.
int64_t pictureBudgetBytes();

/// A stimulus ready to be shown: its distinct pictures as layers of one texture or, if they exceed the
/// budget, its renderer, which then works during presentation.
class PreparedStimulus {
 public:
  /// Renders all pictures and waits for them. `progress` gets the number done and the total; it may throw to
  /// stop.
  PreparedStimulus(std::unique_ptr<StimulusRenderer> renderer, int64_t budgetBytes,
                   const std::function<void(int done, int all)>& progress = {});

  const Timeline& timeline() const { return timeline_; }
  glm::ivec2 sizePx() const { return sizePx_; }
  /// All pictures are rendered: picture() only looks up.
  bool ahead() const { return !live_; }
  /// Why pictures are rendered live, for the experimenter; empty if they are not.
  const std::string& warning() const { return warning_; }
  int64_t bytes() const { return layers_->bytes(); }

  /// RGBA8 array, row 0 at the top, values as sent to the display.
  const gl::Texture& layers() const { return *layers_; }
  /// Layer of each frame, the same in every presentation.
  const std::vector<int>& layerOfFrame() const { return layerOfFrame_; }
  /// Layer that shows a frame, rendered now if it was not prepared. Allocates, compiles and reads back
  /// nothing.
  int picture(int frame);

 private:
  Timeline timeline_;
  glm::ivec2 sizePx_;
  std::vector<int> layerOfFrame_;
  std::optional<gl::Texture> layers_;
  std::unique_ptr<StimulusRenderer> live_;
  int shown_ = -1;  // picture in the only layer, if live
  std::string warning_;
};

}  // namespace limen::study
