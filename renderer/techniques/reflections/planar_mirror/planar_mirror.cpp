// SPDX-License-Identifier: BSD-3-Clause
// Planar mirrors by drawing the scene once more for each, seen from the mirrored eye, where the mirror is
// seen and on the mirror's side of its plane alone; mirrors seen in mirrors again, for each sequence of
// planes. Source: Roger 2008, sections 1.3.1 and 2.1.1. In place of a stencil a texture holds the sequence of
// planes by which each pixel is reached: it may be long. Only planes are served: other mirrors show the
// background.
#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/surface_point.h"
#include "renderer/techniques/reflections/moving_mirrors.h"
#include "renderer/techniques/reflections/planar_mirror/mirror_planes.h"
#include "renderer/techniques/reflections/reflection_bindings.h"
#include "renderer/techniques/reflections/reflection_picture.h"
#include "renderer/techniques/reflections/view_raster.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kPlanarPass = "reflections/planar_mirror";
constexpr const char* kPlanarShader = "renderer/techniques/reflections/planar_mirror/planar_mirror.comp.glsl";
constexpr double kMostSequences = 4096.0;

struct PlanarMirrorSettings {
  int bounces = 1, planes = 4;
  frame::ShadedSetting shading;
  static const SettingsTable<PlanarMirrorSettings>& table() {
    using S = PlanarMirrorSettings;
    static const SettingsTable<S> kTable = {
        {&S::bounces,
         "bounces",
         {1, 8},
         "",
         "Mirrors that light meets on its way to the eye at most",
         "Roger 2008, section 2.1.1"},
        {&S::planes,
         "planes",
         {1, 16},
         "",
         "Planes at most, those with the largest mirrors; other mirrors show the "
         "background"},
        shadingBinding(&S::shading)};
    return kTable;
  }
  void check() const {
    if (planes * std::pow(std::max(planes - 1, 1), bounces - 1) > kMostSequences)
      throw Error("'planes' and 'bounces' allow more than 4096 sequences of planes, each of which is drawn",
                  "bounces", "give fewer bounces or planes");
  }
};

class PlanarMirror : public Technique {
 public:
  using Settings = PlanarMirrorSettings;
  explicit PlanarMirror(const Settings& settings) : settings_(settings), picture_(settings.shading) {}

  void prepare(frame::Frame& frame) override {
    gl::ShaderDefines defines = frame::shadingDefines(settings_.shading, frame);
    defines.merge(frame::surfaceDefines(frame, true));
    defines.erase("SHADOW");
    go_ = &frame.context().programs().compute(kPlanarShader, defines);
    defines["START"] = "1";
    start_ = &frame.context().programs().compute(kPlanarShader, defines);
    refuseMovingMirrors(frame, "a mirror's plane is found once");
    found_ =
        findMirrorPlanes(frame.scene(), frame.gpuScene().anchor(), settings_.planes, frame.shownMirrors());
    raster_.emplace(frame, frame.sizePx(), found_.planeOf, true);
    for (std::optional<gl::Texture>* texture : {&reflected_, &origin_, &direction_, &share_})
      texture->emplace(gl::Format::RGBA32F, frame.sizePx());
    chains_.emplace(gl::Format::R32UI, frame.sizePx());
    frame.passes().setBytesHeld(kPlanarPass, raster_->bytes() + 4 * reflected_->bytes() + chains_->bytes());
    picture_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    const frame::MirrorRays& rays = frame.get<frame::MirrorRays>();
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    {
      const auto scope = frame.passes().open(kPlanarPass);
      rays.origins().bindTexture(kReflectionOriginsUnit);
      rays.directions().bindTexture(kReflectionDirectionsUnit);
      bounce(frame, *start_, ids, true);
      views_ = 0;
      const glm::dvec3 eye(glm::inverse(frame.anchorToCamera())[3]);
      std::vector<View> views = {{0, glm::dmat4(1.0), eye, MirrorPlanes::kNone}};
      for (int level = 0; level < settings_.bounces; ++level) {
        views = drawLevel(frame, views);
        bounce(frame, *go_, raster_->ids(), level + 1 < settings_.bounces);
      }
    }
    picture_.compose(frame, *reflected_);
  }

  const gl::Texture& product() const override { return picture_.texture(); }
  std::vector<Counter> count(frame::Frame& frame) override {
    return {{"mirror_planes", double(found_.planes.size())},
            {"mirrored_views", double(views_)},
            {"triangles_drawn", double(views_) * frame.gpuScene().triangleCount()}};
  }

 private:
  /// The scene as seen through a sequence of planes.
  struct View {
    uint32_t chain;
    glm::dmat4 mirrored;  ///< of the whole sequence: from the scene to what the camera sees
    glm::dvec3 eye;       ///< where the rays seem to come from before the next plane
    uint32_t last;        ///< the plane that rays have left
  };

  /// Draws the views behind all planes but the last of each; returns them.
  std::vector<View> drawLevel(const frame::Frame& frame, const std::vector<View>& views) {
    const glm::dmat4 clip(frame::anchorToClip(frame));
    const auto planes = static_cast<uint32_t>(found_.planes.size());
    std::vector<View> next;
    raster_->clear();
    for (const View& view : views)
      for (uint32_t plane = 0; plane < planes; ++plane) {
        if (plane == view.last) continue;
        const glm::dvec4 equation = found_.planes[plane];
        const glm::dmat4 mirror = mirrorMatrix(equation);
        const View behind{view.chain * planes + plane + 1, view.mirrored * mirror,
                          glm::dvec3(mirror * glm::dvec4(view.eye, 1.0)), plane};
        // Rays go on where they came from.
        const double side = glm::dot(equation, glm::dvec4(view.eye, 1.0)) < 0.0 ? -1.0 : 1.0;
        raster_->draw(frame, glm::mat4(clip * behind.mirrored), glm::vec4(side * equation), plane, &*chains_,
                      behind.chain);
        next.push_back(behind);
        ++views_;
      }
    return next;
  }

  void bounce(frame::Frame& frame, const gl::Program& program, const gl::Texture& ids, bool followed) {
    frame::configureShading(program, frame, settings_.shading);
    program.set("flatShading", settings_.shading.smoothNormals ? 0 : 1);
    program.set("followed", followed ? 1 : 0);
    program.set("planeCount", static_cast<uint32_t>(found_.planes.size()));
    raster_->groups().bindStorage(kViewGroupsBuffer);
    ids.bindTexture(kReflectionIdsUnit);
    reflected_->bindImage(kReflectionImage, gl::Access::ReadWrite);
    origin_->bindImage(kPlanarOriginImage, gl::Access::ReadWrite);
    direction_->bindImage(kPlanarDirectionImage, gl::Access::ReadWrite);
    share_->bindImage(kPlanarShareImage, gl::Access::ReadWrite);
    chains_->bindImage(kPlanarChainImage, gl::Access::ReadWrite);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  PlanarMirrorSettings settings_;
  ReflectionPicture picture_;
  MirrorPlanes found_;
  const gl::Program *start_ = nullptr, *go_ = nullptr;
  std::optional<ViewRaster> raster_;
  std::optional<gl::Texture> reflected_, origin_, direction_, share_, chains_;
  int64_t views_ = 0;
};

const RegisteredTechnique<PlanarMirror> kPlanarMirrorRegistered{
    {.name = "reflections/planar_mirror",
     .version = 1,
     .summary = "Planar mirrors by drawing the scene from mirrored eyes, for each sequence of planes",
     .source = "Roger 2008, sections 1.3.1 and 2.1.1 (R-53)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .followsMotion = true,
     .counters = {{"mirror_planes", "Planes of mirrors", "", Direction::Neither},
                  {"mirrored_views", "Mirrored views drawn", "", Direction::LowerIsBetter},
                  {"triangles_drawn", "Triangles drawn in further views", "", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
