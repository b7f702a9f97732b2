// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/techniques/soft_shadows/history/visibility_history.h"
#include "renderer/techniques/soft_shadows/inner_technique.h"

namespace limen::techniques {

/// How the light moves from one frame to the next.
struct LightWay {
  double step = 0.05;         ///< share of the light's extents
  double directionDeg = 0.0;  ///< from the light's x axis to its y axis
  static const SettingsTable<LightWay>& table();
};

/// A technique observed while the light moves in its own plane, in equal steps that end at its position in
/// the scene. Each position of the light is a separate view within the frame, with its own shadow maps, as in
/// consecutive frames; a history, if any, is carried along. Work and bytes are those of all positions
/// together.
class LightMotion {
 public:
  /// The content of one frame of the motion.
  struct Seen {
    const gl::Texture* visibility = nullptr;  ///< R32F
    const gl::Texture* receivers = nullptr;   ///< as in frame::Receivers
  };
  /// `after` belongs to the frame, `before` to the previous one; valid during the call.
  using StepVisitor = std::function<void(int step, const Seen& before, const Seen& after)>;

  /// `history`: null for none.
  LightMotion(ChosenEntry inner, const LightWay& way, const HistorySettings* history);

  /// Time that the camera advances between two positions, s; at the last it is where the frame has it. Call
  /// before prepare().
  void setCameraStep(double seconds) { cameraStepS_ = seconds; }

  /// `steps` of the light lead to its position in the scene: steps + 1 positions.
  void prepare(frame::Frame& frame, int steps);
  /// Renders all positions in order, the history restarting with the first, and visits the steps between
  /// them, numbered from 0.
  void render(frame::Frame& frame, const StepVisitor& visit = {});
  /// The frame at the last position. After render().
  const Seen& last() const { return last_; }

  /// Of the last position.
  std::vector<Counter> count();
  static std::vector<Quantity> counters();

 private:
  struct Place {
    scene::Scene scene;
    std::unique_ptr<frame::Frame> frame;
    std::unique_ptr<Technique> technique;
  };

  ChosenEntry inner_;
  glm::dvec2 stepShare_;  // of the light's extents
  double cameraStepS_ = 0.0;
  std::optional<VisibilityHistory> history_;
  std::vector<std::unique_ptr<Place>> places_;
  Seen last_;
};

/// The scene with its first light moved by `share` of its extents along its axes.
scene::Scene withMovedLight(const scene::Scene& scene, glm::dvec2 share);

}  // namespace limen::techniques
