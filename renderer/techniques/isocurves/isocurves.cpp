// SPDX-License-Identifier: BSD-3-Clause
// Bicubic patches without triangles: curves of constant v so close that each pixel gets a point (SC-34,
// SC-35). Steps are the same all over a patch (Rockwood 1987) or adapt along each curve (Lien, Shantz and
// Pratt 1987); Schwarz 2009, section 6.5.3, names both. Points come from forward differences of the
// homogeneous curve on the screen, restarted at times against drift. Choices of the bench: one invocation a
// curve, nearest depths by an atomic maximum, and a second walk that writes the surface of the points that
// won. Curves are evenly spaced in both cases.
#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/isocurves/isocurves_bindings.h"
#include "renderer/techniques/ray_casting/hit_counters.h"
#include "renderer/techniques/ray_casting/ray_casting_bindings.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/patch_buffers.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_view.h"

namespace limen::techniques {
namespace {

enum class Stepping { Uniform, Adaptive };
constexpr EnumNames<Stepping, 2> enumNames(Stepping) {
  return {{{{Stepping::Uniform, "uniform"}, {Stepping::Adaptive, "adaptive"}}}};
}

struct IsocurveSettings {
  Stepping stepping = Stepping::Uniform;
  double spacingPx = 0.5;
  int restart = 64;
  bool check = true;
  frame::ShadedSetting shading;
  static const SettingsTable<IsocurveSettings>& table() {
    using S = IsocurveSettings;
    static const SettingsTable<S> kTable = {
        {&S::stepping, "stepping", "Steps along a curve", "Schwarz 2009, section 6.5.3"},
        {&S::spacingPx, "spacing_px", {0.1, 4}, "px", "Distance of curves, and of points on them, at most"},
        {&S::restart,
         "restart",
         {1, 4096},
         "steps",
         "Steps after which differences are computed anew",
         "Schwarz 2009, section 7.6.2"},
        {&S::check, "check", "Compare all pixels with interval arithmetic when counting"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class Isocurves : public Technique {
 public:
  using Settings = IsocurveSettings;
  explicit Isocurves(const Settings& settings) : settings_(settings) {}
  ~Isocurves() override {
    if (vertexArray_) glDeleteVertexArrays(1, &vertexArray_);
  }

  void prepare(frame::Frame& frame) override {
    for (const surfaces::Patch& patch : frame.scene().surfaces.patches)
      if (patch.domain != surfaces::Domain::Rectangle || patch.degreeU != 3 || patch.degreeV != 3)
        throw Error("the scene has patches that are not bicubic", "scene",
                    "use curved/teapot, curved/sheet or curved/herd");
    patches_.emplace(frame.scene(), frame.gpuScene().anchor());
    if (patches_->count() > 65535)
      throw Error("the scene has more than 65,535 patches", "scene", "use fewer patches");
    picture_.emplace(frame, settings_.shading, "isocurves");
    gl::ShaderDefines defines = patches_->defines();
    if (settings_.stepping == Stepping::Adaptive) defines["ADAPTIVE"] = "1";
    const std::string path = "renderer/techniques/isocurves/isocurves.comp.glsl";
    gl::ProgramCache& programs = frame.context().programs();
    depthProgram_ = &programs.compute(path, defines);
    gl::ShaderDefines counting = defines, surface = defines;
    counting["COUNTING"] = "1", surface["SURFACE_PASS"] = "1";
    countingProgram_ = &programs.compute(path, counting);
    surfaceProgram_ = &programs.compute(path, surface);
    const std::string folder = "renderer/techniques/ray_casting/exact/";
    drawProgram_ = &programs.get({folder + "seen.vert.glsl", folder + "seen.frag.glsl"});
    depths_.emplace(gl::Format::R32UI, frame.sizePx());
    ids_.emplace(gl::Format::R32UI, frame.sizePx());
    normals_.emplace(gl::Format::RGBA32F, frame.sizePx());
    glCreateVertexArrays(1, &vertexArray_);
    frame.passes().setBytesHeld("isocurves/depths", depths_->bytes());
    frame.passes().setBytesHeld("isocurves/surface", ids_->bytes() + normals_->bytes() + patches_->bytes());
  }

  void render(frame::Frame& frame) override {
    {
      const auto scope = frame.passes().open("isocurves/depths");
      walk(frame, *depthProgram_);
    }
    {
      const auto scope = frame.passes().open("isocurves/surface");
      normals_->clear(glm::vec4(0.0F));
      ids_->bindImage(kIsocurveIdsImage, gl::Access::Write);
      normals_->bindImage(kIsocurveNormalsImage, gl::Access::Write);
      dispatch(frame, *surfaceProgram_);
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    picture_->render(frame, [&] {
      drawProgram_->use();
      drawProgram_->set("nearest", static_cast<float>(frame::nearPlane(frame)));
      ids_->bindTexture(kSeenIdsUnit);
      normals_->bindTexture(kSeenNormalsUnit);
      glBindVertexArray(vertexArray_);
      glDrawArrays(GL_TRIANGLES, 0, 3);
    });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const gl::Texture counts(gl::Format::R32UI, frame.sizePx());
    counts.clearUint(glm::uvec4(0));
    counts.bindImage(kIsocurveCountsImage, gl::Access::ReadWrite);
    const gl::Buffer drift(std::vector<uint32_t>{0, 0});
    drift.bindStorage(kIsocurveDriftBuffer);
    walk(frame, *countingProgram_);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    double points = 0.0, covered = 0.0;
    for (const uint32_t one : counts.readUint()) points += one, covered += one > 0;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::vector<uint32_t> measured = drift.read<uint32_t>();
    std::vector<Counter> out = {{"points_per_px", points / std::max(covered, 1.0)},
                                {"drift_px", double(std::bit_cast<float>(measured[0]))},
                                {"steps_most", double(measured[1])}};
    if (settings_.check) std::ranges::copy(hitCounters(frame, normals_->read()), std::back_inserter(out));
    return out;
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    return withHitQuantities(
        {{"points_per_px", "Points on curves, mean of the pixels with any", "points/px", lower},
         {"drift_px", "Distance of points by differences from the curve in double precision, largest", "px",
          lower},
         {"steps_most", "Steps of the finest curve, or of the finest part of one, over the whole domain",
          "steps", Direction::Neither}});
  }

 private:
  void walk(frame::Frame& frame, const gl::Program& program) const {
    depths_->clearUint(glm::uvec4(0));
    dispatch(frame, program);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  void dispatch(frame::Frame& frame, const gl::Program& program) const {
    program.set("anchorToClip", frame::anchorToClip(frame));
    program.set("eye", glm::vec3(frame.camera().eye - frame.gpuScene().anchor()));
    program.set("sizePx", frame.sizePx());
    program.set("nearest", static_cast<float>(frame::nearPlane(frame)));
    program.set("spacing", static_cast<float>(settings_.spacingPx));
    program.set("restart", static_cast<uint32_t>(settings_.restart));
    patches_->bindStorage();
    depths_->bindImage(kIsocurveDepthImage, gl::Access::ReadWrite);
    program.use();
    glDispatchCompute(kMostIsocurves / kIsocurveGroup + 1, patches_->count(), 1);
  }

  Settings settings_;
  std::optional<PatchBuffers> patches_;
  std::optional<SurfacePicture> picture_;
  std::optional<gl::Texture> depths_, ids_, normals_;
  const gl::Program *depthProgram_ = nullptr, *countingProgram_ = nullptr, *surfaceProgram_ = nullptr,
                    *drawProgram_ = nullptr;
  uint32_t vertexArray_ = 0;
};

const RegisteredTechnique<Isocurves> kIsocurvesRegistered{
    {.name = "isocurves/forward_differences",
     .version = 1,
     .summary =
         "Bicubic patches as dense curves of points by forward differences, with even or adaptive steps",
     .source = "Rockwood 1987; Lien, Shantz and Pratt 1987; Schwarz 2009, section 6.5.3 (SC-34, SC-35)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .counters = Isocurves::quantities()}};

}  // namespace
}  // namespace limen::techniques
