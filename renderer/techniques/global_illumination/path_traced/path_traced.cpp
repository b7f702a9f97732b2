// SPDX-License-Identifier: BSD-3-Clause
// Diffuse path tracer with a limit on bounces (BL-03) through the tree of the scene's triangles on the GPU:
// from the point that each pixel sees, directions by the cosine, a ray to the lamp at each surface. Emitters
// count where a path meets them. No path is ended by chance, so that the mean is that of the first `bounces`
// reflections exactly. Source: Kajiya 1986; Gaitatzes 2012, section 5.6, compares with such pictures.
#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/light_paths.h"
#include "renderer/frame/mirror_trace.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/moved_rays.h"
#include "renderer/techniques/global_illumination/surface_light.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char *kPathsPass = "global_illumination/paths", *kMeanPass = "global_illumination/path_mean";

class PathTraced : public Technique {
 public:
  using Settings = frame::LightPathSettings;
  explicit PathTraced(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    gl::ProgramCache& programs = frame.context().programs();
    trace_ = &programs.compute("renderer/techniques/global_illumination/path_traced/path_traced.comp.glsl",
                               surfaceLightDefines(settings_.surfaces, frame));
    mean_ = &programs.compute("renderer/techniques/global_illumination/path_traced/path_mean.comp.glsl");
    sums_.emplace(gl::Format::RGBA32F, frame.sizePx());
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    rays_.emplace(frame);
    frame.passes().setBytesHeld(
        kPathsPass,
        sums_->bytes() + (rays_->tree() ? rays_->bytes() : frame.gpuScene().rays(frame.context()).bytes()));
    frame.passes().setBytesHeld(kMeanPass, picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    rays_->build(frame);
    {
      const auto scope = frame.passes().open(kPathsPass);
      sums_->clear(glm::vec4(0.0F));
      configureSurfaceLight(*trace_, frame, settings_.surfaces, rays_->tree());
      trace_->set("bounces", settings_.bounces);
      trace_->set("seed", static_cast<uint32_t>(settings_.seed));
      trace_->set("withDirect", settings_.surfaces.light != frame::LightPart::Indirect ? 1 : 0);
      trace_->set("withIndirect", settings_.surfaces.light != frame::LightPart::Direct ? 1 : 0);
      ids.bindTexture(kPathIdsUnit);
      sums_->bindImage(kPathSumsImage, gl::Access::ReadWrite);
      for (int path = 0; path < settings_.paths; ++path) {
        trace_->set("path", path);
        trace_->dispatch(frame.sizePx());
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
      }
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    const auto scope = frame.passes().open(kMeanPass);
    mean_->set("sizePx", frame.sizePx());
    mean_->set("weight", static_cast<float>(1.0 / double(settings_.paths)));
    sums_->bindTexture(kPathSumsUnit);
    picture_->bindImage(kPathPictureImage, gl::Access::Write);
    mean_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame&) override {
    const Image sums = sums_->read();
    const double n = double(settings_.paths);
    double variance = 0.0;
    for (size_t pixel = 0; pixel < sums.pixels(); ++pixel) {
      const float* at = &sums.data[4 * pixel];
      const double mean = (double(at[0]) + at[1] + at[2]) / (3.0 * n);
      variance += std::max(at[3] / n - mean * mean, 0.0) / (n - 1.0);
    }
    return {{"paths_per_px", n}, {"standard_error", std::sqrt(variance / double(sums.pixels()))}};
  }

 private:
  Settings settings_;
  const gl::Program *trace_ = nullptr, *mean_ = nullptr;
  std::optional<MovedRays> rays_;
  std::optional<gl::Texture> sums_, picture_;
};

const RegisteredTechnique<PathTraced> kPathTracedRegistered{
    {.name = "global_illumination/path_traced",
     .version = 1,
     .summary = "Paths over diffuse surfaces with a limit on bounces, on the GPU",
     .source = "Kajiya 1986; Gaitatzes 2012, section 5.6 (BL-03)",
     .product = ProductKind::Colour,
     .reference = true,
     .followsMotion = true,
     .counters = {{"paths_per_px", "Paths from each pixel's point", "", Direction::LowerIsBetter},
                  {"standard_error",
                   "Standard error of pixels' channel means, root mean square over the picture", "",
                   Direction::LowerIsBetter}},
     .effort = "paths"}};

}  // namespace
}  // namespace limen::techniques
