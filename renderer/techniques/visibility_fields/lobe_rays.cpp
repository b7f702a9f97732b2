// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/lobe_rays.h"

#include <epoxy/gl.h>

#include <cmath>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_trace.h"
#include "renderer/frame/surface_point.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kReflectionShaders = "renderer/techniques/visibility_fields/reflections/";

}  // namespace

const SettingsTable<LobeRays>& LobeRays::table() {
  using S = LobeRays;
  static const SettingsTable<S> kTable = {
      {&S::rays,
       "rays",
       {1, 64},
       "rays",
       "Rays per pixel over the cone of a mirror's gloss, a square number",
       "Gaitatzes 2012, section 4.7.2 (4)"},
      {&S::turned, "turned", "Choose other rays for each pixel, at random", "bench"},
      {&S::seed, "seed", {0, 1000000}, "", "Seed of that choice"}};
  return kTable;
}

int LobeRays::side() const { return static_cast<int>(std::lround(std::sqrt(double(rays)))); }

void LobeRays::check() const {
  if (int64_t{side()} * side() != rays)
    throw Error("'rays' is " + std::to_string(rays) + ", not a square number", "rays",
                "give " + std::to_string(side() * side()));
}

void LobeReflections::prepare(frame::Frame& frame, bool fieldHits, bool foundStarts, int64_t treeBytes) {
  gl::ProgramCache& programs = frame.context().programs();
  gl::ShaderDefines defines = frame::surfaceDefines(frame, true);
  if (foundStarts) defines["FIELD_PRIMARY"] = "1";
  makeRays_ = &programs.compute(std::string(kReflectionShaders) + "lobe_rays.comp.glsl", defines);
  defines = frame::mirrorTraceDefines(shading_, frame);
  if (fieldHits) defines["FIELD_HITS"] = "1";
  shade_ = &programs.compute(std::string(kReflectionShaders) + "shade_hits.comp.glsl", defines);
  directions_.emplace(gl::Format::RGBA32F, frame.sizePx(), 1, static_cast<int>(rays_.rays));
  reflected_.emplace(gl::Format::RGBA32F, frame.sizePx());
  frame.passes().setBytesHeld(pass_ + "/rays", directions_->bytes());
  frame.passes().setBytesHeld(pass_ + "/shade", reflected_->bytes() + treeBytes);
  picture_.prepare(frame);
}

void LobeReflections::makeRays(frame::Frame& frame, const LobeStart& start) {
  const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
  const auto scope = frame.passes().open(pass_ + "/rays");
  frame::configureSurfacePoints(*makeRays_, frame, frame.camera());
  makeRays_->set("raySide", rays_.side());
  makeRays_->set("turned", rays_.turned ? 1 : 0);
  makeRays_->set("seed", static_cast<uint32_t>(rays_.seed));
  start.origins->bindTexture(kLobeOriginsUnit);
  start.mirrored->bindTexture(kLobeMirroredUnit);
  if (start.normals) start.normals->bindTexture(kLobeNormalsUnit);
  ids.bindTexture(kLobeIdsUnit);
  directions_->bindImage(kLobeDirectionsImage, gl::Access::Write);
  makeRays_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void LobeReflections::shade(frame::Frame& frame, const LobeStart& start, const gl::Texture* hits,
                            const ray_tracing::RayTree* tree) {
  const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
  {
    const auto scope = frame.passes().open(pass_ + "/shade");
    frame::configureMirrorTrace(*shade_, frame, shading_, tree);
    start.origins->bindTexture(kLobeOriginsUnit);
    ids.bindTexture(kLobeIdsUnit);
    directions_->bindTexture(kLobeDirectionsUnit);
    if (hits) hits->bindTexture(kLobeHitsUnit);
    reflected_->bindImage(kLobeReflectedImage, gl::Access::ReadWrite);
    const int count = static_cast<int>(rays_.rays);
    shade_->set("rayCount", count);
    // A software renderer limits the steps of an invocation.
    const int atOnce = frame.context().device().software ? 1 : count;
    for (int ray = 0; ray < count; ray += atOnce) {
      shade_->set("firstRay", ray);
      shade_->set("lastRay", ray + atOnce - 1);
      shade_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
  }
  picture_.compose(frame, *reflected_);
}

}  // namespace limen::techniques
