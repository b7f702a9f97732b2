// SPDX-License-Identifier: BSD-3-Clause
// Visibility at the end of a motion of the light, and of the camera (SS-43): a history still contains earlier
// positions of the light. Compared with the visibility of a light that never moved, this is its lag, the
// price of its stability. Without a history it is the inner technique itself.
#include "renderer/techniques/soft_shadows/change/light_motion.h"

namespace limen::techniques {
namespace {

struct StillFrame {
  static constexpr const char *kKind = "none", *kSummary = "the last frame on its own";
};

struct MotionHistory {
  static constexpr const char *kKind = "history",
                              *kSummary = "averaged with the previous frames, as in soft_shadows/history";
  LightWay way;
  int steps = 1;
  double cameraStepS = 0.0;
  HistorySettings history;
  static const SettingsTable<MotionHistory>& table() {
    using S = MotionHistory;
    static const SettingsTable<S> kTable = {
        included(&S::way),
        Binding(&S::steps, "steps", Range{1, 32}, "steps", "Steps of the light up to the frame in question")
            .formerly({"steps"}),
        Binding(&S::cameraStepS, "camera_step_s", Range{0, 10}, "s",
                "Time that the camera advances along its path with each step of the light")
            .formerly({"camera_step_s"}),
        included(&S::history)};
    return kTable;
  }
};

struct InMotionSettings {
  ChosenEntry inner{"soft_shadows/backprojection", {}};
  std::variant<StillFrame, MotionHistory> smoothing;
  static const SettingsTable<InMotionSettings>& table() {
    using S = InMotionSettings;
    static const SettingsTable<S> kTable = {
        innerBinding(&S::inner, InnerKind::OrExact),
        {&S::smoothing, "smoothing", "What remains of the light's motion in the last frame",
         "Schwarz 2009, section 5.2.2 (suggested there)"}};
    return kTable;
  }
};

class InMotion : public Technique {
 public:
  using Settings = InMotionSettings;
  explicit InMotion(const InMotionSettings& settings)
      : InMotion(settings.inner, std::get_if<MotionHistory>(&settings.smoothing)) {}

  void prepare(frame::Frame& frame) override { motion_.prepare(frame, steps_); }
  void render(frame::Frame& frame) override { motion_.render(frame); }
  const gl::Texture& product() const override { return *motion_.last().visibility; }
  std::vector<Counter> count(frame::Frame&) override { return motion_.count(); }

 private:
  InMotion(const ChosenEntry& inner, const MotionHistory* motion)
      : motion_(inner, motion ? motion->way : LightWay{}, motion ? &motion->history : nullptr),
        steps_(motion ? motion->steps : 0) {
    if (motion) motion_.setCameraStep(motion->cameraStepS);
  }

  LightMotion motion_;
  int steps_;
};

const RegisteredTechnique<InMotion> kInMotionTechnique{
    {.name = "soft_shadows/in_motion",
     .version = 1,
     .summary =
         "Visibility of another technique at the end of a motion of the light, with or without a history",
     .source = "Schwarz 2009, section 5.2.2 (SS-43)",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light"},
     .counters = LightMotion::counters()}};

}  // namespace
}  // namespace limen::techniques
