// SPDX-License-Identifier: BSD-3-Clause
// Blending two levels of detail in image space over some frames instead of switching (SP-57; Schwarz 2009,
// section 2.4). image_space renders both levels each frame and mixes them. alternating renders one level per
// frame and combines it with the previous frame's picture of the other level, each pixel copied from one of
// the two, with shares that follow the blend.
//
// Departures and choices: the thesis specifies neither the pattern of the copied pixels nor which level comes
// first: here an 8 x 8 ordered dither, with the new level in odd frames. `reproject` samples the older
// picture where each point was then, which the thesis does not mention; without it, as in the thesis, a
// moving camera shows the older picture one frame late.
#include <epoxy/gl.h>

#include <optional>

#include "renderer/frame/motion.h"
#include "renderer/techniques/lod/box_view.h"
#include "renderer/techniques/lod/level_control.h"
#include "renderer/techniques/lod/lod_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kBlendPass = "lod/blend";

const char* const kBlendSource = "Schwarz 2009, section 2.4";

struct ImageSpaceBlend {
  static constexpr const char *kKind = "image_space", *kSummary = "both levels mixed each frame";
};

struct AlternatingBlend {
  static constexpr const char *kKind = "alternating", *kSummary = "one level per frame, pixels copied";
  double frameRateHz = 60.0;
  bool reproject = false;
  static const SettingsTable<AlternatingBlend>& table() {
    using S = AlternatingBlend;
    static const SettingsTable<S> kTable = {
        Binding(&S::frameRateHz, "frame_rate", Range{1.0, 1000.0}, "Hz",
                "Time since the last frame, which determines the camera's motion")
            .formerly({"frame_rate"}),
        Binding(&S::reproject, "reproject", "Reproject the older picture by the camera's motion")
            .formerly({"reproject"})};
    return kTable;
  }
};

struct BlendSettings {
  std::variant<ImageSpaceBlend, AlternatingBlend> mode;
  int fromLevel = 0, toLevel = 1;
  int blendFrames = 16, frame = 8;
  int samples = 1;
  frame::ShadedSetting shading;
  static const SettingsTable<BlendSettings>& table() {
    using S = BlendSettings;
    static const SettingsTable<S> kTable = {
        {&S::mode, "mode", "How the two levels are combined", kBlendSource},
        {&S::fromLevel,
         "from_level",
         {0, 15},
         "",
         "Level of all objects before the blend, clamped to each object's coarsest"},
        {&S::toLevel,
         "to_level",
         {0, 15},
         "",
         "Level of all objects after the blend, clamped to each object's coarsest"},
        {&S::blendFrames, "blend_frames", {1, 1000}, "frames", "Length of the blend", kBlendSource},
        {&S::frame, "frame", {0, 1000}, "frames", "Frames since the blend began; past its end it is over"},
        samplesBinding(&S::samples),
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class Blend : public Technique {
 public:
  using Settings = BlendSettings;
  explicit Blend(const BlendSettings& settings)
      : alternating_(std::holds_alternative<AlternatingBlend>(settings.mode)),
        from_(settings.fromLevel),
        to_(settings.toLevel),
        frames_(settings.blendFrames),
        number_(settings.frame),
        samples_(settings.samples),
        shaded_(settings.shading) {
    const auto* alternating = std::get_if<AlternatingBlend>(&settings.mode);
    if (!alternating) return;
    reproject_ = alternating->reproject;
    dtS_ = 1.0 / alternating->frameRateHz;
  }

  void prepare(frame::Frame& frame) override {
    gl::ShaderDefines defines;
    if (alternating_) defines["ALTERNATING"] = "1";
    if (reproject_) defines["REPROJECT"] = "1";
    program_ = &frame.context().programs().compute("renderer/techniques/lod/blend/blend.comp.glsl", defines);
    product_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kBlendPass, product_->bytes());
    old_.emplace(frame, "old", shaded_, samples_);
    new_.emplace(frame, "new", shaded_, samples_);
    old_->setLevels(uniformLevels(frame.scene(), from_));
    new_->setLevels(uniformLevels(frame.scene(), to_));
    if (reproject_) {
      motion_.emplace(frame, "motion", frame.sizePx());
      motion_->setLevels(uniformLevels(frame.scene(), newIsNow() ? to_ : from_));
    }
    // The previous frame's picture, which an alternating frame reuses at no cost.
    if (alternating_) renderBefore(frame);
  }

  void render(frame::Frame& frame) override {
    if (alternating_) {
      if (beforeOf_ != frame.timeS()) renderBefore(frame);  // the frame was moved: no longer its predecessor
      (newIsNow() ? *new_ : *old_).render();
    } else {
      old_->render();
      new_->render();
    }
    const gl::Texture* displacement = nullptr;
    if (reproject_) {
      motion_->setTime(frame.timeS());
      motion_->begin();
      displacement = &motion_->get<frame::Motion>(frame::MotionSetting{dtS_}).displacement();
      motion_->end();
    }
    const auto scope = frame.passes().open(kBlendPass);
    program_->set("weight", static_cast<float>(weight()));
    program_->set("sizePx", frame.sizePx());
    program_->set("previousIsNew", newIsNow() ? 0 : 1);
    old_->texture().bindTexture(kBlendOldLevelUnit);
    new_->texture().bindTexture(kBlendNewLevelUnit);
    if (displacement) displacement->bindTexture(kBlendDisplacementUnit);
    product_->bindImage(kBlendImage, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    const scene::LodView view{frame.camera(), frame.sizePx().y};
    const scene::LodSelection older = uniformLevels(frame.scene(), from_),
                              newer = uniformLevels(frame.scene(), to_);
    const uint64_t both = triangleCount(frame.scene(), older) + triangleCount(frame.scene(), newer);
    const uint64_t drawn = alternating_ ? triangleCount(frame.scene(), newIsNow() ? newer : older) : both;
    return {{"triangles_drawn", static_cast<double>(drawn)},
            {"new_level_weight", weight()},
            {"screen_error_px", std::min(std::max(largestScreenErrorPx(frame.scene(), older, view),
                                                  largestScreenErrorPx(frame.scene(), newer, view)),
                                         1e9)}};
  }

 private:
  double weight() const { return std::min(double(number_) / frames_, 1.0); }
  bool newIsNow() const { return number_ % 2 == 1; }
  void renderBefore(frame::Frame& frame) {
    (newIsNow() ? *old_ : *new_).renderAt(frame.timeS() - dtS_);
    beforeOf_ = frame.timeS();
  }

  bool alternating_, reproject_ = false;
  int from_, to_, frames_, number_;
  double dtS_ = 0.0;  // alternating only
  int samples_;
  frame::ShadedSetting shaded_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> product_;
  std::optional<BoxView> old_, new_;
  std::optional<frame::Frame> motion_;
  double beforeOf_ = 0.0;
};

const RegisteredTechnique<Blend> kBlendRegistered{
    {.name = "lod/blend",
     .version = 1,
     .summary = "One frame of a blend between two levels, either both mixed or one per frame",
     .source = "Schwarz 2009, section 2.4 (SP-57)",
     .product = ProductKind::Colour,
     .needs = {"lod_sets"},
     .counters = {trianglesDrawn(),
                  {"new_level_weight", "Weight of the new level", "", Direction::Neither},
                  screenErrorPx()}}};

}  // namespace
}  // namespace limen::techniques
