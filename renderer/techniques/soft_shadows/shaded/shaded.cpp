// SPDX-License-Identifier: BSD-3-Clause
// A shaded picture with soft shadows, and where its visibility is found (SS-36): in passes of its own, which
// leave an image of visibility to the shading pass, or in the shading pass itself. Source: Schwarz 2009,
// sections 4.1, 4.6 and 5.2.2.
//
// The forms within the shading pass work out receivers as the G-buffer does and call the same functions for
// each, so that their pictures are those of a single pass of its own. On the scene's triangles, fragments of
// hidden ones are discarded by the triangle numbers that all forms begin with, in place of a depth test.
#include <epoxy/gl.h>

#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/shaded/loop_in_shading.h"
#include "renderer/techniques/soft_shadows/shaded/shaded_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kApplyPass = "soft_shadows/shade";

class ShadedShadow : public Technique {
 public:
  using Settings = ShadedShadowSettings;
  explicit ShadedShadow(const ShadedShadowSettings& settings) : inner_(settings.inner) {
    if (settings.loop == VisibilityLoop::OwnPass)
      visibility_ = makeInner(settings.inner);
    else
      loop_.emplace(innerParts(settings.inner), settings.loop, shading_);
  }

  void prepare(frame::Frame& frame) override {
    if (loop_) {
      loop_->prepare(frame);
      return;
    }
    visibility_->prepare(frame);
    apply_ = &frame.context().programs().compute("renderer/techniques/soft_shadows/shaded/apply.comp.glsl",
                                                 frame::shadingDefines(shading_, frame));
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kApplyPass, picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    if (loop_) {
      loop_->render(frame);
      return;
    }
    visibility_->render(frame);
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
    const auto scope = frame.passes().open(kApplyPass);
    frame::configureShading(*apply_, frame, shading_);
    ids.bindTexture(kShadeIdsUnit);
    receivers.bindTexture(kShadeReceiversUnit);
    visibility_->product().bindTexture(kShadeVisibilityUnit);
    picture_->bindImage(kShadeImage, gl::Access::Write);
    apply_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return loop_ ? loop_->picture() : *picture_; }

  std::vector<std::string> remarks() const override {
    return visibility_ ? visibility_->remarks() : std::vector<std::string>();
  }

  /// Those of the inner technique, which looks at the same micro-occluders wherever its loop is.
  std::vector<Counter> count(frame::Frame& frame) override {
    if (visibility_) return countInner(*visibility_, frame);
    const std::unique_ptr<Technique> same = makeInner(inner_);
    same->prepare(frame);
    return countInner(*same, frame);
  }

 private:
  ChosenEntry inner_;
  frame::ShadedSetting shading_;
  std::unique_ptr<Technique> visibility_;  // null: found in the shading pass
  std::optional<LoopInShading> loop_;
  const gl::Program* apply_ = nullptr;
  std::optional<gl::Texture> picture_;
};

const RegisteredTechnique<ShadedShadow> kShadedRegistered{
    {.name = "soft_shadows/shaded",
     .version = 1,
     .summary = "A shaded picture, its visibility found in passes of its own or in the shading pass",
     .source = "Schwarz 2009, sections 4.1, 4.6 and 5.2.2 (SS-36)",
     .product = ProductKind::Colour,
     .needs = {"rectangular_light"},
     .counters = innerCounters()}};

}  // namespace
}  // namespace limen::techniques
