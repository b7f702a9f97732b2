// SPDX-License-Identifier: BSD-3-Clause
// How much visibility changes from one frame to the next while the light moves (SS-43). Compared with the
// same change of a reference, what is left is the method's own: micro-occluders swim as the casters'
// rasterisation in the shadow map changes, the more the coarser they are. Source: Schwarz 2009, sections 4.5
// and 5.2.2, which describe it and measure nothing.
//
// The map is fitted to the casters in every frame, so that a single flat caster parallel to the light carries
// the map's texels along and does not swim at all.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "renderer/techniques/soft_shadows/change/light_motion.h"

namespace limen::techniques {
namespace {

constexpr const char *kChangePass = "soft_shadows/change", *kLastStep = "last_step";

class Change : public Technique {
 public:
  explicit Change(const ParameterValues& values)
      : motion_(values), lastOnly_(values.text("quantity") == kLastStep) {}

  void prepare(frame::Frame& frame) override {
    motion_.prepare(frame, lastOnly_ && !motion_.hasHistory() ? 2 : motion_.steps() + 1);
    program_ = &frame.context().programs().compute(
        "renderer/techniques/soft_shadows/change/change.comp.glsl",
        lastOnly_ ? gl::ShaderDefines{} : gl::ShaderDefines{{"MEAN_ABSOLUTE", "1"}});
    change_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld(kChangePass, change_->bytes());
  }

  void render(frame::Frame& frame) override {
    motion_.render(frame, [&](int step, const LightMotion::Seen& before, const LightMotion::Seen& after) {
      const auto scope = frame.passes().open(kChangePass);
      program_->set("sizePx", frame.sizePx());
      program_->set("isFirst", step == 0 ? 1 : 0);
      program_->set("steps", static_cast<float>(motion_.steps()));
      before.visibility->bindTexture(0);
      after.visibility->bindTexture(1);
      before.receivers->bindTexture(2);
      after.receivers->bindTexture(3);
      change_->bindImage(0, gl::Access::ReadWrite);
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
    all.push_back({"mean_absolute_change", sum / pixels, "", false});
    all.push_back({"changed_share", changed / pixels, "", false});
    return all;
  }

  /// Red where light came, blue where it went, full at a quarter of the light.
  std::map<std::string, Image> pictures() const override {
    constexpr float kFull = 0.25F;
    const Image change = change_->read();
    Image picture(change.width, change.height, 3);
    for (size_t i = 0; i < change.pixels(); ++i) {
      const float value = change.data[i] / kFull;
      picture.data[3 * i] = std::clamp(value, 0.0F, 1.0F);
      picture.data[3 * i + 2] = std::clamp(-value, 0.0F, 1.0F);
    }
    return {{"signed_change", std::move(picture)}};
  }

 private:
  LightMotion motion_;
  bool lastOnly_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> change_;
};

std::vector<Parameter> changeParameters() {
  std::vector<Parameter> all = {choiceParameter(
      "quantity", kLastStep, {kLastStep, "mean_absolute"},
      "Change of visibility over the last step with its sign, or the mean of all steps' absolute changes")};
  for (Parameter& parameter : LightMotion::parameters()) all.push_back(std::move(parameter));
  return all;
}

std::vector<Quantity> changeCounters() {
  std::vector<Quantity> names = LightMotion::counterNames();
  names.emplace_back("mean_absolute_change");
  names.emplace_back("changed_share");
  return names;
}

const Registered<TechniqueInfo> kChangeTechnique{
    {.name = "soft_shadows/change",
     .version = 1,
     .summary = "Change of another technique's visibility from frame to frame while the light moves",
     .source = "Schwarz 2009, sections 4.5 and 5.2.2 (SS-43)",
     .product = ProductKind::VisibilityChange,
     .parameters = changeParameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Change>(values); },
     .errorBound = {},
     .counters = changeCounters(),
     .check = LightMotion::check}};

}  // namespace
}  // namespace limen::techniques
