// SPDX-License-Identifier: BSD-3-Clause
// The rays of visibility_fields/reflections, traced against the scene's triangles instead: exact for those
// rays. Source: Gaitatzes 2012, section 4.7.2 (MT-01, BL-02).
#include <optional>

#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/visibility_fields/lobe_rays.h"
#include "renderer/techniques/visibility_fields/traced_triangles.h"

namespace limen::techniques {
namespace {

struct TracedLobeSettings {
  LobeRays rays;
  frame::ShadedSetting shading;
  static const SettingsTable<TracedLobeSettings>& table() {
    using S = TracedLobeSettings;
    static const SettingsTable<S> kTable = {included(&S::rays), shadingBinding(&S::shading)};
    return kTable;
  }
};

class TracedLobeReflections : public Technique {
 public:
  using Settings = TracedLobeSettings;
  explicit TracedLobeReflections(const Settings& settings)
      : lobes_(settings.rays, settings.shading, "visibility_fields/traced_reflections") {}

  void prepare(frame::Frame& frame) override {
    // Where nothing moves, the tree that techniques share.
    if (!frame.scene().motions.empty()) moving_.emplace(frame, frame.scene().mesh.triangles);
    lobes_.prepare(frame, false, false,
                   moving_ ? moving_->bytes() : frame.gpuScene().rays(frame.context()).bytes());
  }
  void render(frame::Frame& frame) override {
    const frame::MirrorRays& exact = frame.get<frame::MirrorRays>();
    const LobeStart start{&exact.origins(), &exact.directions()};
    if (moving_) moving_->update(frame);
    lobes_.makeRays(frame, start);
    lobes_.shade(frame, start, nullptr, moving_ ? &moving_->tree() : nullptr);
  }
  const gl::Texture& product() const override { return lobes_.picture(); }

 private:
  LobeReflections lobes_;
  std::optional<TracedTriangles> moving_;
};

const RegisteredTechnique<TracedLobeReflections> kTracedLobes{
    {.name = "visibility_fields/traced_reflections",
     .version = 1,
     .summary = "Glossy mirrors by the same rays as from visibility fields, traced on the GPU",
     .source = "Gaitatzes 2012, section 4.7.2 (MT-01, BL-02)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .reference = true,
     .followsMotion = true,
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
