// SPDX-License-Identifier: BSD-3-Clause
// Mirrored rays through the tree of the scene's triangles, on the GPU: what modern ray tracers do, and the
// rival of all others. The tree is built before the first frame. Source of the light model: Roger 2008,
// sections 1.2.2 and 3.1.
#include <epoxy/gl.h>

#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_path.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/mirror_trace.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/reflections/reflection_bindings.h"
#include "renderer/techniques/reflections/reflection_picture.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kTracePass = "reflections/trace";

struct RayTracedSettings {
  frame::MirrorPathSettings path;
  frame::ShadedSetting shading;
  static const SettingsTable<RayTracedSettings>& table() {
    using S = RayTracedSettings;
    static const SettingsTable<S> kTable = {included(&S::path), shadingBinding(&S::shading)};
    return kTable;
  }
};

class RayTracedReflections : public Technique {
 public:
  using Settings = RayTracedSettings;
  explicit RayTracedReflections(const RayTracedSettings& settings)
      : settings_(settings), picture_(settings.shading) {}

  void prepare(frame::Frame& frame) override {
    program_ =
        &frame.context().programs().compute("renderer/techniques/reflections/ray_traced/ray_traced.comp.glsl",
                                            frame::mirrorTraceDefines(settings_.shading, frame));
    reflected_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kTracePass,
                                reflected_->bytes() + frame.gpuScene().rays(frame.context()).bytes());
    picture_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    const frame::MirrorRays& rays = frame.get<frame::MirrorRays>();
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    {
      const auto scope = frame.passes().open(kTracePass);
      frame::configureMirrorTrace(*program_, frame, settings_.shading);
      program_->set("bounces", settings_.path.bounces);
      program_->set("shadows", settings_.path.shadows);
      program_->set("leastShare", static_cast<float>(settings_.path.leastShare));
      rays.origins().bindTexture(kReflectionOriginsUnit);
      rays.directions().bindTexture(kReflectionDirectionsUnit);
      ids.bindTexture(kReflectionIdsUnit);
      reflected_->bindImage(kReflectionImage, gl::Access::Write);
      program_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    picture_.compose(frame, *reflected_);
  }

  const gl::Texture& product() const override { return picture_.texture(); }

  /// A scene that moves needs its tree anew each frame.
  std::vector<Counter> count(frame::Frame& frame) override {
    return {{"tree_build_ms", 1e3 * frame.gpuScene().rays(frame.context()).buildS()}};
  }

 private:
  RayTracedSettings settings_;
  ReflectionPicture picture_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> reflected_;
};

const RegisteredTechnique<RayTracedReflections> kRegistered{
    {.name = "reflections/ray_traced",
     .version = 2,
     .summary = "Mirrors by rays through a tree of the scene's triangles",
     .source = "Roger 2008, sections 1.2.2 and 3.1 (R-59)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .counters = {{"tree_build_ms", "Time to build the tree, once, on the CPU", "ms",
                   Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
