// SPDX-License-Identifier: BSD-3-Clause
// Reference of ambient occlusion: rays over the hemisphere by the cosine, one in a random direction of each
// cell of a grid, through the tree of the scene's triangles; a ray is blocked by what lies within the radius.
// Source: Holländer 2013, section 7.2.1.
#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/ambient_occlusion/occlusion_bindings.h"
#include "renderer/techniques/ambient_occlusion/occlusion_radius.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

struct TracedOcclusionSettings {
  int64_t rays = 256;
  int64_t seed = 1;
  OcclusionRadius radius;
  static const SettingsTable<TracedOcclusionSettings>& table() {
    using S = TracedOcclusionSettings;
    static const SettingsTable<S> kTable = {
        {&S::rays, "rays", {16, 16384}, "rays", "Rays per pixel, a square number"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the directions within cells"},
        included(&S::radius)};
    return kTable;
  }
  int side() const { return static_cast<int>(std::lround(std::sqrt(double(rays)))); }
  void check() const {
    if (int64_t{side()} * side() != rays)
      throw Error("'rays' is " + std::to_string(rays) + ", not a square number", "rays",
                  "give " + std::to_string(side() * side()));
  }
};

class TracedOcclusion : public Technique {
 public:
  using Settings = TracedOcclusionSettings;
  explicit TracedOcclusion(const TracedOcclusionSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    program_ = &frame.context().programs().compute(
        "renderer/techniques/ambient_occlusion/ray_traced/ray_traced.comp.glsl");
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld("ambient_occlusion/rays",
                                picture_->bytes() + frame.gpuScene().rays(frame.context()).bytes());
  }

  void render(frame::Frame& frame) override {
    using frame::Channel;
    const auto& positions = frame.get<frame::GBufferChannel>(frame::ChannelSetting{Channel::Position});
    const auto& normals = frame.get<frame::GBufferChannel>(frame::ChannelSetting{Channel::Normal});
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    const auto scope = frame.passes().open("ambient_occlusion/rays");
    frame.gpuScene().rays(frame.context()).bind(*program_);
    program_->set("sizePx", frame.sizePx());
    program_->set("side", settings_.side());
    program_->set("seed", static_cast<uint32_t>(settings_.seed));
    program_->set("radius", settings_.radius.of(frame));
    positions.texture().bindTexture(kOcclusionPositionUnit);
    normals.texture().bindTexture(kOcclusionNormalUnit);
    ids.bindTexture(kOcclusionIdsUnit);
    picture_->bindImage(kOcclusionOutImage, gl::Access::ReadWrite);
    for (int row = 0; row < settings_.side(); ++row) {
      program_->set("row", row);
      program_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
  }

  const gl::Texture& product() const override { return *picture_; }

 private:
  TracedOcclusionSettings settings_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> picture_;
};

/// Hoeffding 1963, as for all references of independent rays.
double tracedNoise(const TracedOcclusionSettings& settings) {
  return std::sqrt(std::log(2.0 / 0.001) / (2.0 * double(settings.rays)));
}

const RegisteredTechnique<TracedOcclusion> kTracedOcclusion{
    {.name = "ambient_occlusion/ray_traced",
     .version = 1,
     .summary = "Ambient occlusion by rays over the hemisphere of each pixel's point",
     .source = "Holländer 2013, section 7.2.1",
     .product = ProductKind::Colour,
     .reference = true},
    &tracedNoise};

}  // namespace
}  // namespace limen::techniques
