// SPDX-License-Identifier: BSD-3-Clause
// Bicubic patches without triangles: curves of constant v so close that each pixel gets a point (SC-34,
// SC-35). Steps are the same all over a patch (Rockwood 1987) or adapt along each curve (Lien, Shantz and
// Pratt 1987), the curves being evenly spaced; or curves adapt, steps being even along each (Elber and Cohen
// 1996); or a patch is halved until its parts suit even steps and curves (Rappoport 1991). Schwarz 2009,
// section 6.5.3, names all four. Points come from forward differences of the homogeneous curve on the screen,
// restarted at times against drift. Choices of the bench: one invocation a curve, or a group for a sixteenth
// of a patch; nearest depths by an atomic maximum, and a second walk that writes the surface of the points
// that won; a part's curves are close where the control polygons between them are short, which folds cannot
// hide from, in place of the roots of their distance.
#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/isocurves/isocurves_bindings.h"
#include "renderer/techniques/ray_casting/hit_counters.h"
#include "renderer/techniques/ray_casting/seen_picture.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/patch_buffers.h"
#include "renderer/techniques/tessellation/surface_view.h"

namespace limen::techniques {
namespace {

struct UniformSteps {
  static constexpr const char *kKind = "uniform", *kSummary = "the same all over a patch";
};
struct AdaptiveSteps {
  static constexpr const char *kKind = "adaptive", *kSummary = "halved and doubled along each curve";
};
struct AdaptiveCurves {
  static constexpr const char *kKind = "adaptive_curves",
                              *kSummary = "even ones on curves that are inserted until they are close";
};
struct HybridParts {
  static constexpr const char *kKind = "hybrid",
                              *kSummary = "the same all over a part of a patch, halved until that suits it";
  double flatnessPx = 2.0, evenness = 1.5;
  static const SettingsTable<HybridParts>& table() {
    using S = HybridParts;
    static const SettingsTable<S> kTable = {
        {&S::flatnessPx,
         "flatness_px",
         {0.01, 64.0},
         "px",
         "Distance that control points of a part that is filled may have from even places on their chords",
         "Schwarz 2009, section 6.5.3 (number: bench)"},
        {&S::evenness,
         "evenness",
         {1.05, 3.0},
         "",
         "Longest leg of a control polygon over its mean leg, at most",
         "Schwarz 2009, section 6.5.3 (number: bench)"}};
    return kTable;
  }
};

struct IsocurveSettings {
  std::variant<UniformSteps, AdaptiveSteps, AdaptiveCurves, HybridParts> stepping;
  double spacingPx = 0.5;
  int restart = 64;
  bool check = true;
  frame::ShadedSetting shading;
  static const SettingsTable<IsocurveSettings>& table() {
    using S = IsocurveSettings;
    static const SettingsTable<S> kTable = {
        {&S::stepping, "stepping", "How far apart points and curves are", "Schwarz 2009, section 6.5.3"},
        {&S::spacingPx, "spacing_px", {0.1, 4}, "px", "Distance of curves, and of points on them, at most"},
        {&S::restart,
         "restart",
         {1, 4096},
         "steps",
         "Steps after which differences are computed anew; a part that is filled has no more",
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
    if (std::holds_alternative<AdaptiveSteps>(settings_.stepping)) defines["ADAPTIVE"] = "1";
    if (std::holds_alternative<AdaptiveCurves>(settings_.stepping)) defines["ADAPTIVE_CURVES"] = "1";
    hybrid_ = std::get_if<HybridParts>(&settings_.stepping);
    inParts_ = hybrid_ || std::holds_alternative<AdaptiveCurves>(settings_.stepping);
    const std::string path = std::string("renderer/techniques/isocurves/") +
                             (inParts_ ? "pieces.comp.glsl" : "isocurves.comp.glsl");
    gl::ProgramCache& programs = frame.context().programs();
    depthProgram_ = &programs.compute(path, defines);
    gl::ShaderDefines counting = defines, surface = defines;
    counting["COUNTING"] = "1", surface["SURFACE_PASS"] = "1";
    countingProgram_ = &programs.compute(path, counting);
    surfaceProgram_ = &programs.compute(path, surface);
    depths_.emplace(gl::Format::R32UI, frame.sizePx());
    frame.passes().setBytesHeld("isocurves/depths", depths_->bytes());
    frame.passes().setBytesHeld("isocurves/surface",
                                picture_->ids().bytes() + picture_->normals().bytes() + patches_->bytes());
  }

  void render(frame::Frame& frame) override {
    {
      const auto scope = frame.passes().open("isocurves/depths");
      walk(frame, *depthProgram_);
    }
    {
      const auto scope = frame.passes().open("isocurves/surface");
      picture_->normals().clear(glm::vec4(0.0F));
      picture_->ids().bindImage(kIsocurveIdsImage, gl::Access::Write);
      picture_->normals().bindImage(kIsocurveNormalsImage, gl::Access::Write);
      dispatch(frame, *surfaceProgram_);
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    picture_->render(frame);
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const gl::Texture counts(gl::Format::R32UI, frame.sizePx());
    counts.clearUint(glm::uvec4(0));
    counts.bindImage(kIsocurveCountsImage, gl::Access::ReadWrite);
    const gl::Buffer drift(std::vector<uint32_t>{0, 0, 0, 0});
    drift.bindStorage(kIsocurveDriftBuffer);
    walk(frame, *countingProgram_);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    double points = 0.0, covered = 0.0;
    for (const uint32_t one : counts.readUint()) points += one, covered += one > 0;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::vector<uint32_t> measured = drift.read<uint32_t>();
    if (frame.context().device().software && measured[3] > uint32_t{kIsocurveRounds})
      throw Error("a part of a patch takes " + std::to_string(measured[3]) +
                      " loop rounds; this software renderer ends loops after " +
                      std::to_string(kIsocurveRounds),
                  "stepping", "raise 'spacing_px', render a smaller picture, use uniform steps, or a GPU");
    std::vector<Counter> out = {{"points_per_px", points / std::max(covered, 1.0)},
                                {"drift_px", double(std::bit_cast<float>(measured[0]))},
                                {"steps_most", double(measured[1])},
                                {"filled_parts", double(measured[2])}};
    if (settings_.check)
      std::ranges::copy(hitCounters(frame, picture_->normals().read()), std::back_inserter(out));
    return out;
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    return withHitQuantities(
        {{"points_per_px", "Points on curves, mean of the pixels with any", "points/px", lower},
         {"drift_px", "Distance of points by differences from the curve in double precision, largest", "px",
          lower},
         {"steps_most", "Steps of the finest curve, or of the finest part of one, over the whole domain",
          "steps", Direction::Neither},
         {"filled_parts", "Parts of patches that were filled each with its own steps", "parts", lower}});
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
    if (hybrid_) {
      program.set("flatness", static_cast<float>(hybrid_->flatnessPx));
      program.set("evenness", static_cast<float>(hybrid_->evenness));
    }
    patches_->bindStorage();
    depths_->bindImage(kIsocurveDepthImage, gl::Access::ReadWrite);
    program.use();
    glDispatchCompute(inParts_ ? kIsocurveParts : kMostIsocurves / kIsocurveGroup + 1, patches_->count(),
                      inParts_ && frame.context().device().software ? kIsocurveSharers : 1);
  }

  Settings settings_;
  std::optional<PatchBuffers> patches_;
  std::optional<SeenPicture> picture_;
  std::optional<gl::Texture> depths_;
  const gl::Program *depthProgram_ = nullptr, *countingProgram_ = nullptr, *surfaceProgram_ = nullptr;
  const HybridParts* hybrid_ = nullptr;
  bool inParts_ = false;
};

const RegisteredTechnique<Isocurves> kIsocurvesRegistered{
    {.name = "isocurves/forward_differences",
     .version = 2,
     .summary = "Bicubic patches as dense curves of points by forward differences, with even or adaptive "
                "steps and curves",
     .source = "Rockwood 1987; Lien, Shantz and Pratt 1987; Elber and Cohen 1996; Rappoport 1991; Schwarz "
               "2009, section 6.5.3 (SC-34, SC-35)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .counters = Isocurves::quantities()}};

}  // namespace
}  // namespace limen::techniques
