// SPDX-License-Identifier: BSD-3-Clause
// Reflections found in the picture itself: each mirrored ray is followed through the picture's depths, and
// brings the light of the pixel where it meets a surface. What the picture does not show is left to a
// fallback. Not a method of the theses: the comparator that games use today. Steps of pixels with an interval
// of depths each: McGuire and Mara 2014, "Efficient GPU Screen-Space Ray Tracing"; pyramid of nearest depths:
// Uludag 2014, "Hi-Z Screen-Space Cone-Traced Reflections". Rays are cut to the picture in homogeneous
// coordinates, so that those towards the eye need no case of their own, and depths are reversed, which are
// linear along a ray in pixels. A surface whose other side the ray would meet is none of those that the
// picture shows: that rule takes the place of a bias, without which rays would meet the mirror that they
// leave. Differs from the sources in taking the thickness as a share of the scene, whatever its units.
#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/surface_point.h"
#include "renderer/techniques/reflections/reflection_bindings.h"
#include "renderer/techniques/reflections/reflection_picture.h"
#include "renderer/techniques/reflections/screen_space/screen_space_bindings.h"
#include "renderer/techniques/reflections/screen_space/screen_space_settings.h"
#include "renderer/techniques/reflections/view_raster.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char *kPyramidPass = "reflections/depth_pyramid", *kBehindPass = "reflections/depth_behind",
                     *kMarchPass = "reflections/screen_march";
constexpr const char* kScreenFolder = "renderer/techniques/reflections/screen_space/";

double thicknessOf(const ScreenSpaceSettings& settings) {
  if (const auto* constant = std::get_if<ConstantThickness>(&settings.thickness)) return constant->depth;
  if (const auto* faces = std::get_if<BackFaceThickness>(&settings.thickness)) return faces->least;
  return std::get<SecondLayerThickness>(settings.thickness).depth;
}

class ScreenSpaceReflections : public Technique {
 public:
  using Settings = ScreenSpaceSettings;
  explicit ScreenSpaceReflections(const Settings& settings)
      : settings_(settings), picture_(settings.shading) {
    if (const auto* environment = std::get_if<EnvironmentFallback>(&settings.fallback))
      environment_.emplace(environment->map, settings.shading, true);
  }

  void prepare(frame::Frame& frame) override {
    auto& programs = frame.context().programs();
    const std::string folder = kScreenFolder;
    if (std::holds_alternative<HierarchicalMarch>(settings_.march)) {
      buildPyramid_ = &programs.compute(folder + "screen_pyramid.comp.glsl");
      // Whole cells of the coarsest level: halving them is exact.
      constexpr int kCell = 1 << kScreenPyramidLevels;
      const glm::ivec2 cells = (frame.sizePx() + kCell - 1) / kCell;
      pyramid_.emplace(gl::Format::R32F, cells * (kCell / 2), kScreenPyramidLevels);
      frame.passes().setBytesHeld(kPyramidPass, pyramid_->bytes());
    }
    const bool second = std::holds_alternative<SecondLayerThickness>(settings_.thickness);
    if (second || std::holds_alternative<BackFaceThickness>(settings_.thickness)) {
      behind_.emplace(frame, frame.sizePx(), std::vector<uint32_t>(frame.gpuScene().triangleCount(), 0U),
                      false, second ? ViewRaster::Shown::FrontsBehindDepth : ViewRaster::Shown::BackFaces);
      frame.passes().setBytesHeld(kBehindPass, behind_->bytes());
    }
    if (environment_) environment_->prepare(frame);
    const gl::ShaderDefines defines = marchDefines(frame);
    march_ = &programs.compute(folder + "screen_march.comp.glsl", defines);
    gl::ShaderDefines counting = defines;
    counting["COUNT"] = "1";
    countMarch_ = &programs.compute(folder + "screen_march.comp.glsl", counting);
    reflected_.emplace(gl::Format::RGBA32F, frame.sizePx());
    fates_.emplace(gl::Format::R32UI, frame.sizePx());
    frame.passes().setBytesHeld(kMarchPass, reflected_->bytes());
    picture_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    const frame::MirrorRays& rays = frame.get<frame::MirrorRays>();
    const frame::TriangleIds& ids = frame.get<frame::TriangleIds>();
    const gl::Texture& local = frame.get<frame::Shaded>(settings_.shading).texture();
    if (pyramid_) {
      const auto scope = frame.passes().open(kPyramidPass);
      buildPyramid(frame, ids.depth());
    }
    if (behind_) {
      const auto scope = frame.passes().open(kBehindPass);
      behind_->clear();
      behind_->draw(frame, frame::anchorToClip(frame), glm::vec4(0.0F, 0.0F, 0.0F, 1.0F),
                    ViewRaster::kNoGroup, &ids.depth());
    }
    {
      const auto scope = frame.passes().open(kMarchPass);
      march(frame, *march_, rays, ids, local);
    }
    if (environment_) {
      environment_->draw(frame);
      environment_->look(frame, rays, *reflected_);
    }
    picture_.compose(frame, *reflected_);
  }

  const gl::Texture& product() const override { return picture_.texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    march(frame, *countMarch_, frame.get<frame::MirrorRays>(), frame.get<frame::TriangleIds>(),
          frame.get<frame::Shaded>(settings_.shading).texture());
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    std::array<double, 1U << kScreenFateBits> of{};
    double steps = 0.0;
    for (const uint32_t word : fates_->readUint()) {
      ++of.at(word & ((1U << kScreenFateBits) - 1U));
      steps += word >> kScreenFateBits;
    }
    const double rays =
        of[kScreenMet] + of[kScreenFree] + of[kScreenHidden] + of[kScreenLeft] + of[kScreenCut];
    const double whole = std::max(rays, 1.0);
    return {{"mirror_px", rays},
            {"steps_per_ray", steps / whole},
            {"on_screen_share", (of[kScreenMet] + of[kScreenFree]) / whole},
            {"met_share", of[kScreenMet] / whole},
            {"fallback_share", (of[kScreenHidden] + of[kScreenLeft] + of[kScreenCut]) / whole},
            {"left_share", of[kScreenLeft] / whole},
            {"hidden_share", of[kScreenHidden] / whole},
            {"cut_share", of[kScreenCut] / whole}};
  }

  std::map<std::string, const gl::Texture*> debugViews() const override {
    return {{"reflected", &*reflected_}};
  }

 private:
  gl::ShaderDefines marchDefines(const frame::Frame& frame) const {
    gl::ShaderDefines defines = frame::shadingDefines(settings_.shading, frame);
    defines.merge(frame::surfaceDefines(frame, true));
    defines.erase("SHADOW");
    constexpr std::array<const char*, 3> kThicknesses = {"THICKNESS_CONSTANT", "THICKNESS_BACK_FACES",
                                                         "THICKNESS_SECOND_LAYER"};
    for (size_t i = 0; i < kThicknesses.size(); ++i) defines[kThicknesses[i]] = std::to_string(i);
    defines["THICKNESS"] = kThicknesses[settings_.thickness.index()];
    if (std::holds_alternative<LinearMarch>(settings_.march)) defines["LINEAR"] = "1";
    if (settings_.light == ScreenLight::Triangle) defines["LIGHT_TRIANGLE"] = "1";
    if (settings_.behind == Behind::GiveUp) defines["GIVE_UP"] = "1";
    if (std::holds_alternative<NoFallback>(settings_.fallback)) defines["NO_FALLBACK"] = "1";
    return defines;
  }

  void buildPyramid(const frame::Frame& frame, const gl::Texture& depth) {
    buildPyramid_->set("sizePx", frame.sizePx());
    depth.bindTexture(kScreenPyramidDepthUnit);
    constexpr std::array<uint32_t, kScreenPyramidLevels> kImages = {
        kScreenPyramid1Image, kScreenPyramid2Image, kScreenPyramid3Image,
        kScreenPyramid4Image, kScreenPyramid5Image, kScreenPyramid6Image};
    for (int level = 0; level < kScreenPyramidLevels; ++level)
      pyramid_->bindImage(kImages.at(static_cast<size_t>(level)), gl::Access::Write, level);
    buildPyramid_->dispatch(pyramid_->sizePx() / 2, glm::ivec2(kScreenPyramidGroup));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  void march(frame::Frame& frame, const gl::Program& program, const frame::MirrorRays& rays,
             const frame::TriangleIds& ids, const gl::Texture& local) {
    frame::configureShading(program, frame, settings_.shading);
    program.set("flatShading", settings_.shading.smoothNormals ? 0 : 1);
    program.set("near", static_cast<float>(frame::nearPlane(frame)));
    program.set("mostSteps", settings_.steps);
    program.set("thickness", static_cast<float>(thicknessOf(settings_) * frame.gpuScene().diagonal()));
    program.set("fade", static_cast<float>(settings_.fade * std::min(frame.sizePx().x, frame.sizePx().y)));
    if (const auto* linear = std::get_if<LinearMarch>(&settings_.march)) {
      program.set("stride", static_cast<float>(linear->stridePx));
      program.set("jitter", static_cast<float>(linear->jitter));
      program.set("refinements", linear->refinements);
      program.set("seed", static_cast<uint32_t>(linear->seed));
    } else {
      program.set("coarsest", std::get<HierarchicalMarch>(settings_.march).coarsest);
      pyramid_->bindTexture(kScreenPyramidUnit);
    }
    rays.origins().bindTexture(kReflectionOriginsUnit);
    rays.directions().bindTexture(kReflectionDirectionsUnit);
    ids.texture().bindTexture(kReflectionIdsUnit);
    local.bindTexture(kScreenPictureUnit);
    ids.depth().bindTexture(kScreenDepthUnit);
    if (behind_) {
      behind_->depth().bindTexture(kScreenBehindDepthUnit);
      behind_->ids().bindTexture(kScreenSecondIdsUnit);
    }
    reflected_->bindImage(kReflectionImage, gl::Access::Write);
    fates_->bindImage(kScreenFateImage, gl::Access::Write);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  ScreenSpaceSettings settings_;
  ReflectionPicture picture_;
  std::optional<EnvironmentLight> environment_;
  const gl::Program *buildPyramid_ = nullptr, *march_ = nullptr, *countMarch_ = nullptr;
  std::optional<ViewRaster> behind_;
  std::optional<gl::Texture> pyramid_, reflected_, fates_;
};

const RegisteredTechnique<ScreenSpaceReflections> kScreenSpaceRegistered{
    {.name = "reflections/screen_space",
     .version = 1,
     .summary = "Mirrors by rays through the depths of the picture, with what it shows",
     .source = "McGuire and Mara 2014; Uludag 2014",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .followsMotion = true,
     .counters = {
         {"mirror_px", "Pixels that see a mirror", "px", Direction::Neither},
         {"steps_per_ray", "Steps per ray", "", Direction::LowerIsBetter},
         {"on_screen_share", "Share of rays that the picture answers", "", Direction::HigherIsBetter},
         {"met_share", "Share of rays that meet a surface of the picture", "", Direction::Neither},
         {"fallback_share", "Share of rays that the picture does not answer", "", Direction::LowerIsBetter},
         {"left_share", "Share of rays that leave the picture", "", Direction::Neither},
         {"hidden_share", "Share of rays that go behind a surface and bring nothing", "", Direction::Neither},
         {"cut_share", "Share of rays for which the most steps are not enough", "",
          Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
