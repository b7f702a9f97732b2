// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "perception/vision/display.h"
#include "study/application/stimulus_player.h"
#include "study/application/ui_screen.h"
#include "study/presentation/presenter.h"
#include "study/protocol/protocol.h"
#include "study/stimulus/stimulus_scene.h"

namespace limen::study {

/// Stimuli in a window: rendered ahead, shown by the presenter.
class PresentedPlayer : public StimulusPlayer {
 public:
  /// `anyTiming`: trials count whatever their frame times, for trying things out.
  /// `patch`: a square for a light sensor, which must cover it, since it shows when something changes.
  PresentedPlayer(window::UiWindow& window, const Protocol& protocol,
                  const perception::DisplayProfile& display, bool anyTiming,
                  const PhotodiodePatch& patch = {});
  ~PresentedPlayer() override;

  void prepare(const Trial& trial, const Session& session, const std::function<void()>& idle) override;
  PlayResult play(const std::function<bool()>& goOn) override;
  nlohmann::json environment() const override;
  bool pacedByTimer() const { return screen_.pacedByTimer(); }
  /// Throws Error if a part's stimuli do not fit into the window.
  void checkFit() const;

 private:
  struct Prepared;
  window::UiWindow& window_;
  const Protocol& protocol_;
  perception::DisplayProfile display_;
  bool anyTiming_;
  PhotodiodePatch patch_;
  UiScreen screen_;
  SceneCache scenes_;
  std::unique_ptr<Prepared> prepared_;
};

}  // namespace limen::study
