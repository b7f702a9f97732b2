// SPDX-License-Identifier: BSD-3-Clause
// Light that diffuse surfaces reflect to each other, by paths of at most so many reflections: at each point
// of a path one direction with the density of the cosine, and a ray to the lamp. Emitters are found by the
// paths themselves, so that small ones are noisy. What propagation in grids converges to, and what it must
// beat. Source: Kajiya 1986; Gaitatzes 2012, section 5.6 (path tracing of two bounces).
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/light_paths.h"
#include "renderer/frame/mirror_trace.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/global_illumination/global_illumination_bindings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kPathPass = "global_illumination/path_traced";
/// Of one dispatch: few enough for the loops of software renderers.
constexpr int kPathsAtOnce = 4;

class PathTraced : public Technique {
 public:
  using Settings = frame::LightPathSettings;
  explicit PathTraced(const Settings& settings) : settings_(settings), lamp_(settings.surfaces.lamp()) {}

  void prepare(frame::Frame& frame) override {
    program_ = &frame.context().programs().compute(
        "renderer/techniques/global_illumination/path_traced/path_traced.comp.glsl",
        frame::mirrorTraceDefines(lamp_, frame));
    radiance_.emplace(gl::Format::RGBA32F, frame.sizePx());
    moments_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(
        kPathPass, radiance_->bytes() + moments_->bytes() + frame.gpuScene().rays(frame.context()).bytes());
  }

  void render(frame::Frame& frame) override {
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    const auto scope = frame.passes().open(kPathPass);
    frame::configureMirrorTrace(*program_, frame, lamp_);
    program_->set("bounces", settings_.bounces);
    program_->set("seed", static_cast<uint32_t>(settings_.seed));
    program_->set("pathWeight", static_cast<float>(1.0 / double(settings_.paths)));
    program_->set("holdsDirect", settings_.surfaces.light != frame::LightPart::Indirect ? 1 : 0);
    ids.bindTexture(kLightPathIdsUnit);
    radiance_->bindImage(kLightPathRadianceImage, gl::Access::ReadWrite);
    moments_->bindImage(kLightPathMomentsImage, gl::Access::ReadWrite);
    const auto paths = static_cast<int>(pathsTraced());
    int first = 0;
    do {
      const int end = std::min(first + kPathsAtOnce, paths);
      program_->set("firstPath", first);
      program_->set("endPath", end);
      program_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
      first = end;
    } while (first < paths);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *radiance_; }

  std::vector<Counter> count(frame::Frame&) override {
    const Image moments = moments_->read(), radiance = radiance_->read();
    const auto paths = double(pathsTraced()), pixels = double(moments.pixels());
    double squares = 0.0, rays = 0.0, sum = 0.0;
    for (size_t i = 0; i < moments.pixels(); ++i) {
      const double mean = moments.data[4 * i] / std::max(paths, 1.0);
      if (paths > 1.0)
        squares += std::max(moments.data[4 * i + 1] / paths - mean * mean, 0.0) / (paths - 1.0);
      rays += moments.data[4 * i + 2];
      for (size_t c = 0; c < 3; ++c) sum += radiance.data[4 * i + c] / 3.0;
    }
    return {{"standard_error", std::sqrt(squares / pixels)},
            {"mean_radiance", sum / pixels},
            {"rays_per_px", rays / pixels}};
  }

 private:
  int64_t pathsTraced() const {
    return settings_.surfaces.light == frame::LightPart::Direct || settings_.bounces == 0 ? 0
                                                                                          : settings_.paths;
  }

  Settings settings_;
  frame::ShadedSetting lamp_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> radiance_, moments_;
};

const RegisteredTechnique<PathTraced> kPathTracedRegistered{
    {.name = "global_illumination/path_traced",
     .version = 1,
     .summary = "Diffuse light by paths of a few reflections, traced on the GPU",
     .source = "Kajiya 1986; Gaitatzes 2012, section 5.6 (BL-03)",
     .product = ProductKind::Colour,
     .counters = frame::lightPathQuantities(),
     .effort = "paths"}};

}  // namespace
}  // namespace limen::techniques
