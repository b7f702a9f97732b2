// SPDX-License-Identifier: BSD-3-Clause
// Blending two levels of detail in image space over some frames instead of switching (SP-57; Schwarz 2009,
// section 2.4). image_space renders both levels each frame and mixes them. alternating renders one level a
// frame and combines it with the picture of the other level from the frame before, each pixel copied from one
// of the two, with shares that follow the blend.
//
// Departures and choices: the thesis names neither the pattern of the copied pixels nor which level comes
// first: an 8 x 8 ordered dither here, the new level in frames with an odd number. `reproject` looks the
// older picture up where each point lay then, which the thesis does not mention; without it, as there, a
// moving camera shows the older picture a frame late.
#include <epoxy/gl.h>

#include <optional>

#include "renderer/frame/motion.h"
#include "renderer/techniques/lod/box_view.h"
#include "renderer/techniques/lod/level_control.h"

namespace limen::techniques {
namespace {

constexpr const char* kBlendPass = "lod/blend";

class Blend : public Technique {
 public:
  explicit Blend(const ParameterValues& values)
      : alternating_(values.text("mode") == "alternating"),
        reproject_(alternating_ && values.boolean("reproject")),
        from_(static_cast<int>(values.integer("from_level"))),
        to_(static_cast<int>(values.integer("to_level"))),
        frames_(static_cast<int>(values.integer("blend_frames"))),
        number_(static_cast<int>(values.integer("frame"))),
        dtS_(1.0 / values.real("frame_rate")),
        samples_(static_cast<int>(values.integer("samples"))),
        shaded_(frame::ShadedSetting::from(values)) {}

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
    // The picture of the frame before, which an alternating frame finds and does not pay for.
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
    old_->texture().bindTexture(0);
    new_->texture().bindTexture(1);
    if (displacement) displacement->bindTexture(2);
    product_->bindImage(0, gl::Access::Write);
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
    return {{"triangles_drawn", static_cast<double>(drawn), "", true},
            {"new_level_weight", weight(), "", false},
            {"screen_error_px",
             std::min(std::max(largestScreenErrorPx(frame.scene(), older, view),
                               largestScreenErrorPx(frame.scene(), newer, view)),
                      1e9),
             "px", false}};
  }

 private:
  double weight() const { return std::min(double(number_) / frames_, 1.0); }
  bool newIsNow() const { return number_ % 2 == 1; }
  void renderBefore(frame::Frame& frame) {
    (newIsNow() ? *old_ : *new_).renderAt(frame.timeS() - dtS_);
    beforeOf_ = frame.timeS();
  }

  bool alternating_, reproject_;
  int from_, to_, frames_, number_;
  double dtS_;
  int samples_;
  frame::ShadedSetting shaded_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> product_;
  std::optional<BoxView> old_, new_;
  std::optional<frame::Frame> motion_;
  double beforeOf_ = 0.0;
};

std::vector<Parameter> blendParameters() {
  const char* const kSource = "Schwarz 2009, section 2.4";
  std::vector<Parameter> out = {
      choiceParameter("mode", "image_space", {"image_space", "alternating"},
                      "Both levels mixed each frame, or one level a frame and pixels copied", kSource),
      integerParameter("from_level", 0, 0, 15, "",
                       "Level of all objects before the blend; at most their last"),
      integerParameter("to_level", 1, 0, 15, "", "Level of all objects after it; at most their last"),
      integerParameter("blend_frames", 16, 1, 1000, "frames", "Length of the blend", kSource),
      integerParameter("frame", 8, 0, 1000, "frames",
                       "Frames since the blend began; past its end it is over"),
      realParameter("frame_rate", 60.0, 1.0, 1000.0, "Hz",
                    "Tells how far the camera moved since the last frame"),
      booleanParameter("reproject", false, "alternating: follows the camera's motion in the older picture"),
      samplesParameter(1)};
  for (Parameter& parameter : frame::ShadedSetting::parameters()) out.push_back(std::move(parameter));
  return out;
}

const Registered<TechniqueInfo> kBlendRegistered{
    {.name = "lod/blend",
     .version = 1,
     .summary = "A frame of a blend from one level to another, both mixed or one a frame",
     .source = "Schwarz 2009, section 2.4 (SP-57)",
     .product = ProductKind::Colour,
     .parameters = blendParameters(),
     .needs = {"lod_sets"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Blend>(values); },
     .errorBound = {},
     .counters = {"triangles_drawn", "new_level_weight", "screen_error_px"}}};

}  // namespace
}  // namespace limen::techniques
