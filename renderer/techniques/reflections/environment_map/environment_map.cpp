// SPDX-License-Identifier: BSD-3-Clause
// Reflections from a cube map of the surroundings, drawn from the middle of the largest mirror in every frame
// (Roger 2008, section 1.3.2): at infinity, on a sphere, or with the distance of each texel, through which
// the mirrored ray is followed. The mirror itself is left out of the map, and mirrors in it show their own
// light alone. All mirrors of the scene use the one map. Optionally filtered beforehand for diffuse or glossy
// surfaces; the mean of the light, so that the mirror's share alone decides how bright it is.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/surface_point.h"
#include "renderer/techniques/reflections/environment_map/cube_map.h"
#include "renderer/techniques/reflections/environment_map/surroundings.h"
#include "renderer/techniques/reflections/reflection_bindings.h"
#include "renderer/techniques/reflections/reflection_picture.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char *kMapPass = "reflections/environment_map", *kLookPass = "reflections/environment_lookup",
                     *kPrefilterPass = "reflections/prefilter";

struct InfiniteMap {
  static constexpr const char *kKind = "infinite", *kSummary = "by direction alone";
  static const SettingsTable<InfiniteMap>& table() {
    static const SettingsTable<InfiniteMap> kTable = {};
    return kTable;
  }
};
struct FiniteMap {
  static constexpr const char *kKind = "finite", *kSummary = "on a sphere around the mirror's middle";
  double radius = 0.25;
  static const SettingsTable<FiniteMap>& table() {
    static const SettingsTable<FiniteMap> kTable = {{&FiniteMap::radius,
                                                     "radius",
                                                     {1e-3, 100.0},
                                                     "scene diagonals",
                                                     "Radius of the sphere",
                                                     "Roger 2008, section 1.3.2.1 (1 world unit there)"}};
    return kTable;
  }
};
struct DepthMap {
  static constexpr const char *kKind = "depth",
                              *kSummary = "at the distance of each texel, found along the ray";
  int steps = 32, refinements = 10;
  double crackShare = 0.02;
  static const SettingsTable<DepthMap>& table() {
    using S = DepthMap;
    static const SettingsTable<S> kTable = {
        {&S::steps, "steps", {1, 1024}, "", "Places along the ray", "Roger 2008, section 1.3.2.2"},
        {&S::refinements, "refinements", {0, 32}, "", "Halvings of the step that enters a surface"},
        {&S::crackShare,
         "crack",
         {1e-6, 1.0},
         "",
         "Depth behind a surface, as a share of its distance, beyond which the ray slipped past its border"}};
    return kTable;
  }
};

enum class MapFilter { Nearest, Linear, Mip };
constexpr EnumNames<MapFilter, 3> enumNames(MapFilter) {
  return {{{{MapFilter::Nearest, "nearest"}, {MapFilter::Linear, "linear"}, {MapFilter::Mip, "mip"}}}};
}

struct NotPrefiltered {
  static constexpr const char *kKind = "none", *kSummary = "as it is seen";
  static const SettingsTable<NotPrefiltered>& table() {
    static const SettingsTable<NotPrefiltered> kTable = {};
    return kTable;
  }
};
struct PrefilteredLobe {
  static constexpr const char *kKind = "lobe",
                              *kSummary = "mean over a power of the cosine; 1 is that of diffuse surfaces";
  double exponent = 20.0;
  int resolution = 32, source = 32;
  static const SettingsTable<PrefilteredLobe>& table() {
    using S = PrefilteredLobe;
    static const SettingsTable<S> kTable = {
        {&S::exponent, "exponent", {1.0, 1000.0}, "", "Of the cosine", "Roger 2008, section 1.3.2.3"},
        {&S::resolution, "resolution", {4, 256}, "texels", "Side of a face of the filtered map"},
        {&S::source, "source_resolution", oneOf({8, 16, 32, 64, 128}), "texels",
         "Side of a face of the level that is filtered"}};
    return kTable;
  }
};

struct EnvironmentMapSettings {
  int resolution = 256;
  std::variant<InfiniteMap, FiniteMap, DepthMap> lookup;
  MapFilter filter = MapFilter::Linear;
  std::variant<NotPrefiltered, PrefilteredLobe> prefilter;
  frame::ShadedSetting shading;
  static const SettingsTable<EnvironmentMapSettings>& table() {
    using S = EnvironmentMapSettings;
    static const SettingsTable<S> kTable = {
        {&S::resolution, "resolution", oneOf({16, 32, 64, 128, 256, 512, 1024, 2048}), "texels",
         "Side of a face", "Roger 2008, section 1.3.2"},
        {&S::lookup, "lookup", "Where the map's surroundings are"},
        {&S::filter, "filter", "Nearest texel, four texels, or mip levels by the angle between pixels' rays"},
        {&S::prefilter, "prefilter", "Filters the map for surfaces that are no perfect mirrors"},
        shadingBinding(&S::shading)};
    return kTable;
  }
  void check() const {
    const auto* lobe = std::get_if<PrefilteredLobe>(&prefilter);
    if (lobe && lobe->source > resolution)
      throw Error("the filtered level would have more texels than the map", "prefilter.source_resolution",
                  "give at most " + std::to_string(resolution));
  }
};

class EnvironmentMap : public Technique {
 public:
  using Settings = EnvironmentMapSettings;
  explicit EnvironmentMap(const Settings& settings) : settings_(settings), picture_(settings.shading) {}

  void prepare(frame::Frame& frame) override {
    const auto* lobe = std::get_if<PrefilteredLobe>(&settings_.prefilter);
    drawn_.emplace(frame, settings_.resolution, settings_.filter == MapFilter::Mip || lobe,
                   settings_.shading);
    if (lobe) filtered_.emplace(lobe->resolution, false);
    auto& programs = frame.context().programs();
    const std::string folder = "renderer/techniques/reflections/environment_map/";
    prefilter_ = &programs.compute(folder + "prefilter.comp.glsl", {});
    gl::ShaderDefines look;
    defineEnum(look, "FILTER", settings_.filter);
    if (std::holds_alternative<FiniteMap>(settings_.lookup)) look["FINITE"] = "1";
    if (std::holds_alternative<DepthMap>(settings_.lookup)) look["DEPTH"] = "1";
    look_ = &programs.compute(folder + "environment_look.comp.glsl", look);
    look["COUNT"] = "1";
    countLook_ = &programs.compute(folder + "environment_look.comp.glsl", look);
    reflected_.emplace(gl::Format::RGBA32F, frame.sizePx());
    fates_.emplace(gl::Format::R32UI, frame.sizePx());
    frame.passes().setBytesHeld(kMapPass, drawn_->bytes() + (filtered_ ? filtered_->bytes() : 0));
    frame.passes().setBytesHeld(kLookPass, reflected_->bytes());
    picture_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    {
      const auto scope = frame.passes().open(kMapPass);
      drawn_->draw(frame);
    }
    if (const auto* lobe = std::get_if<PrefilteredLobe>(&settings_.prefilter)) {
      const auto scope = frame.passes().open(kPrefilterPass);
      prefilter(*lobe);
    }
    const frame::MirrorRays& rays = frame.get<frame::MirrorRays>();
    {
      const auto scope = frame.passes().open(kLookPass);
      look(frame, rays, *look_);
    }
    picture_.compose(frame, *reflected_);
  }

  const gl::Texture& product() const override { return picture_.texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    look(frame, frame.get<frame::MirrorRays>(), *countLook_);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    double rays = 0.0, cracks = 0.0, missed = 0.0;
    for (const uint32_t fate : fates_->readUint()) {
      rays += fate != kEnvironmentNoRay;
      cracks += fate == kEnvironmentCrack || fate == kEnvironmentMetBehindCrack;
      missed += fate == kEnvironmentMissed || fate == kEnvironmentCrack;
    }
    return {{"mirror_px", rays},
            {"crack_px", cracks},
            {"missed_px", missed},
            {"triangles_drawn", 6.0 * frame.gpuScene().triangleCount()}};
  }

 private:
  void prefilter(const PrefilteredLobe& lobe) {
    int level = 0;
    while (settings_.resolution >> level > lobe.source) ++level;
    drawn_->map().faces().bindTexture(kEnvironmentFacesUnit);
    filtered_->faces().bindImage(kReflectionImage, gl::Access::Write);
    prefilter_->set("sourceLevel", level);
    prefilter_->set("sourceResolution", settings_.resolution >> level);
    prefilter_->set("resolution", lobe.resolution);
    prefilter_->set("exponent", static_cast<float>(lobe.exponent));
    for (int face = 0; face < 6; ++face) {
      prefilter_->set("face", face);
      prefilter_->dispatch(glm::ivec2(lobe.resolution));
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  void look(frame::Frame& frame, const frame::MirrorRays& rays, const gl::Program& program) {
    const CubeMap& map = filtered_ ? *filtered_ : drawn_->map();
    program.set("sizePx", frame.sizePx());
    program.set("resolution", map.resolution());
    program.set("centre", glm::vec3(drawn_->middle()));
    const double diagonal = frame.gpuScene().diagonal();
    if (const auto* finite = std::get_if<FiniteMap>(&settings_.lookup))
      program.set("radius", static_cast<float>(finite->radius * diagonal));
    if (const auto* depth = std::get_if<DepthMap>(&settings_.lookup)) {
      program.set("steps", depth->steps);
      program.set("refinements", depth->refinements);
      program.set("crackShare", static_cast<float>(depth->crackShare));
      program.set("reach", static_cast<float>(0.1 * diagonal));
    }
    rays.origins().bindTexture(kReflectionOriginsUnit);
    rays.directions().bindTexture(kReflectionDirectionsUnit);
    map.bindCube(kEnvironmentCubeUnit);
    drawn_->map().faces().bindTexture(kEnvironmentFacesUnit);
    reflected_->bindImage(kReflectionImage, gl::Access::Write);
    fates_->bindImage(kEnvironmentFateImage, gl::Access::Write);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  EnvironmentMapSettings settings_;
  ReflectionPicture picture_;
  const gl::Program *prefilter_ = nullptr, *look_ = nullptr, *countLook_ = nullptr;
  std::optional<Surroundings> drawn_;
  std::optional<CubeMap> filtered_;
  std::optional<gl::Texture> reflected_, fates_;
};

const RegisteredTechnique<EnvironmentMap> kEnvironmentMapRegistered{
    {.name = "reflections/environment_map",
     .version = 1,
     .summary = "Mirrors that look their light up in a cube map of their surroundings, drawn each frame",
     .source = "Roger 2008, sections 1.3.2 and 5.1 (R-54 to R-58)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .counters = {
         {"mirror_px", "Pixels that see a mirror", "px", Direction::Neither},
         {"crack_px", "Pixels whose ray slips behind a border in the map", "px", Direction::LowerIsBetter},
         {"missed_px", "Pixels whose ray meets nothing in the map", "px", Direction::LowerIsBetter},
         {"triangles_drawn", "Triangles drawn into the map", "", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
