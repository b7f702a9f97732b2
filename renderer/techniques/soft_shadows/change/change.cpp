// SPDX-License-Identifier: BSD-3-Clause
// How much visibility changes from one frame to the next while the light moves (SS-43). Compared with the
// same change of a reference, the difference is the method's own: micro-occluders swim as the casters'
// rasterisation in the shadow map changes, the more the coarser they are. Source: Schwarz 2009, sections 4.5
// and 5.2.2, which describe but do not measure it.
//
// The map is fitted to the casters in every frame, so the map's texels move with a single flat caster
// parallel to the light, which does not swim at all.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "renderer/techniques/soft_shadows/change/light_motion.h"

#include "renderer/techniques/soft_shadows/change/change_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kChangePass = "soft_shadows/change";

struct LastStep {
  static constexpr const char *kKind = "last_step", *kSummary = "change over the last step, with its sign";
};

struct MeanAbsolute {
  static constexpr const char *kKind = "mean_absolute", *kSummary = "mean of several steps' absolute changes";
  int steps = 1;
  static const SettingsTable<MeanAbsolute>& table() {
    static const SettingsTable<MeanAbsolute> kTable = {
        Binding(&MeanAbsolute::steps, "steps", Range{1, 32}, "steps", "Steps of the light")
            .formerly({"steps"})};
    return kTable;
  }
};

struct Unsmoothed {
  static constexpr const char *kKind = "none", *kSummary = "each frame on its own";
};

struct Smoothed {
  static constexpr const char *kKind = "history",
                              *kSummary = "averaged with the previous frames, as in soft_shadows/history";
  int leadIn = 0;
  HistorySettings history;
  static const SettingsTable<Smoothed>& table() {
    static const SettingsTable<Smoothed> kTable = {
        {&Smoothed::leadIn, "lead_in", {0, 31}, "steps", "Steps of the light before those that are measured"},
        included(&Smoothed::history)};
    return kTable;
  }
};

struct ChangeSettings {
  ChosenEntry inner{"soft_shadows/backprojection", {}};
  std::variant<LastStep, MeanAbsolute> quantity;
  LightWay way;
  std::variant<Unsmoothed, Smoothed> smoothing;
  static const SettingsTable<ChangeSettings>& table() {
    using S = ChangeSettings;
    static const SettingsTable<S> kTable = {
        innerBinding(&S::inner, InnerKind::OrPcss),
        {&S::quantity, "quantity", "Which change of visibility to show"},
        included(&S::way),
        {&S::smoothing, "smoothing", "Whether frames are averaged with previous ones",
         "Schwarz 2009, section 5.2.2 (suggested there)"}};
    return kTable;
  }
};

class Change : public Technique {
 public:
  using Settings = ChangeSettings;
  explicit Change(const ChangeSettings& settings)
      : Change(settings, std::get_if<Smoothed>(&settings.smoothing),
               std::get_if<MeanAbsolute>(&settings.quantity)) {}

  void prepare(frame::Frame& frame) override {
    motion_.prepare(frame, leadIn_ + steps_);
    program_ = &frame.context().programs().compute(
        "renderer/techniques/soft_shadows/change/change.comp.glsl",
        isMean_ ? gl::ShaderDefines{{"MEAN_ABSOLUTE", "1"}} : gl::ShaderDefines{});
    change_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld(kChangePass, change_->bytes());
  }

  void render(frame::Frame& frame) override {
    motion_.render(frame, [&](int step, const LightMotion::Seen& before, const LightMotion::Seen& after) {
      if (step < leadIn_) return;
      const auto scope = frame.passes().open(kChangePass);
      program_->set("sizePx", frame.sizePx());
      program_->set("isFirst", step == leadIn_ ? 1 : 0);
      program_->set("steps", static_cast<float>(steps_));
      before.visibility->bindTexture(kChangeVisibilityBeforeUnit);
      after.visibility->bindTexture(kChangeVisibilityAfterUnit);
      before.receivers->bindTexture(kChangeReceiversBeforeUnit);
      after.receivers->bindTexture(kChangeReceiversAfterUnit);
      change_->bindImage(kChangeImage, gl::Access::ReadWrite);
      program_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    });
  }

  const gl::Texture& product() const override { return *change_; }

  std::vector<Counter> count(frame::Frame&) override {
    std::vector<Counter> all = motion_.count();
    const Image change = change_->read();
    double sum = 0.0, changed = 0.0;
    for (const float value : change.data) {
      sum += std::abs(value);
      changed += value != 0.0F;
    }
    const auto pixels = static_cast<double>(change.pixels());
    all.push_back({"mean_absolute_change", sum / pixels});
    all.push_back({"changed_share", changed / pixels});
    return all;
  }

  /// Red where light appeared, blue where it vanished, saturated at a quarter of the light.
  std::map<std::string, PictureMaker> pictures() const override {
    return {{"signed_change", [change = change_->read()] {
               constexpr float kFull = 0.25F;
               Image picture(change.width, change.height, 3);
               for (size_t i = 0; i < change.pixels(); ++i) {
                 const float value = change.data[i] / kFull;
                 picture.data[3 * i] = std::clamp(value, 0.0F, 1.0F);
                 picture.data[3 * i + 2] = std::clamp(-value, 0.0F, 1.0F);
               }
               return picture;
             }}};
  }

 private:
  Change(const ChangeSettings& settings, const Smoothed* smoothed, const MeanAbsolute* mean)
      : motion_(settings.inner, settings.way, smoothed ? &smoothed->history : nullptr),
        leadIn_(smoothed ? smoothed->leadIn : 0),
        steps_(mean ? mean->steps : 1),
        isMean_(mean != nullptr) {}

  LightMotion motion_;
  int leadIn_, steps_;
  bool isMean_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> change_;
};

std::vector<Quantity> changeCounters() {
  std::vector<Quantity> all = LightMotion::counters();
  all.push_back({"mean_absolute_change", "Mean size of the change", "", Direction::Neither});
  all.push_back({"changed_share", "Share of pixels that change", "", Direction::Neither});
  return all;
}

const RegisteredTechnique<Change> kChangeTechnique{
    {.name = "soft_shadows/change",
     .version = 1,
     .summary = "Change of another technique's visibility from frame to frame while the light moves",
     .source = "Schwarz 2009, sections 4.5 and 5.2.2 (SS-43)",
     .product = ProductKind::VisibilityChange,
     .needs = {"rectangular_light"},
     .counters = changeCounters()}};

}  // namespace
}  // namespace limen::techniques
