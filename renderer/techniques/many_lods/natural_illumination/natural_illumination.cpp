// SPDX-License-Identifier: BSD-3-Clause
// Natural illumination: an environment around the scene stands for distant lights, each with a shadow map or
// seen along rays, on diffuse and glossy surfaces. Source: Holländer 2013, section 3.6.2 (1,024 lights).
// Views stand so far away that light falls in parallel up to a fraction of a degree.
#include <cmath>
#include <optional>
#include <variant>

#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/many_lods/multi_cut.h"
#include "renderer/many_lods/node_predicate.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"
#include "renderer/techniques/many_lods/polygon_tiles.h"
#include "renderer/techniques/many_lods/radiosity.h"
#include "renderer/techniques/many_lods/receiver_surface.h"
#include "renderer/techniques/many_lods/scene_tree.h"
#include "renderer/techniques/many_lods/shadow_bias.h"
#include "renderer/techniques/many_lods/sky.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kSkyShadowPass = "many_lods/polygons";
/// Distance of views from the middle of what they enclose, diagonals: a parallax of half a diagonal is less
/// than half a degree, and depths keep 2^-17 of the diagonal.
constexpr double kSkyDistance = 64.0;

/// What views enclose.
enum class SkyFit { All, Casters };
constexpr EnumNames<SkyFit, 2> enumNames(SkyFit) {
  return {{{{SkyFit::All, "all"}, {SkyFit::Casters, "casters"}}}};
}
struct SkyMaps {
  int tilePx = 64;
  SkyFit fit = SkyFit::All;
  static const SettingsTable<SkyMaps>& table() {
    using S = SkyMaps;
    static const SettingsTable<S> kTable = {
        {&S::tilePx, "tile", {4, 512}, "px", "Side of a light's shadow map"},
        {&S::fit, "fit",
         "What maps enclose: everything, or the parts that cast shadows, where all others are a ground that "
         "hides "
         "no light"}};
    return kTable;
  }
};

struct SkyCuts {
  static constexpr const char *kKind = "cuts", *kSummary = "shadow maps from cuts of a tree of points";
  TreeSettings tree;
  many_lods::CutMode cuts;
  CutLimits limits{2.0, 16384};
  ShadowBias bias;
  SkyMaps maps;
  static const SettingsTable<SkyCuts>& table() {
    using S = SkyCuts;
    static const SettingsTable<S> kTable = {included(&S::tree),
                                            {&S::cuts, "cuts", kCutsText, kCutsSource},
                                            included(&S::limits),
                                            {&S::bias, "bias", kShadowBiasText},
                                            included(&S::maps)};
    return kTable;
  }
};
struct SkyPolygons {
  static constexpr const char *kKind = "polygons", *kSummary = "shadow maps of all triangles";
  double bias = 1.0;
  SkyMaps maps;
  static const SettingsTable<SkyPolygons>& table() {
    using S = SkyPolygons;
    static const SettingsTable<S> kTable = {
        {&S::bias, "bias", {0.0, 16.0}, "px", "Pixels of the map, times 1 + the surface's slope"},
        included(&S::maps)};
    return kTable;
  }
};
struct SkyRays {
  static constexpr const char *kKind = "rays", *kSummary = "each light is seen along a ray";
  static const SettingsTable<SkyRays>& table() {
    static const SettingsTable<SkyRays> kTable = {};
    return kTable;
  }
};

struct NaturalSettings {
  int64_t lights = 1024;
  SkySettings sky;
  ReceiverSurface receivers;
  std::variant<SkyCuts, SkyPolygons, SkyRays> shadows;
  static const SettingsTable<NaturalSettings>& table() {
    using S = NaturalSettings;
    static const SettingsTable<S> kTable = {
        {&S::lights, "lights", {1, 65536}, "", "Distant lights", "Holländer 2013, section 3.6.2 (1,024)"},
        {&S::sky, "sky", "The environment"},
        {&S::receivers, "receivers", kReceiverText},
        {&S::shadows, "shadows", "How a point sees a light"}};
    return kTable;
  }
};

class NaturalIllumination : public Technique {
 public:
  using Settings = NaturalSettings;
  explicit NaturalIllumination(const Settings& settings)
      : settings_(settings),
        cuts_(std::get_if<SkyCuts>(&settings_.shadows)),
        polygons_(std::get_if<SkyPolygons>(&settings_.shadows)) {}

  void prepare(frame::Frame& frame) override {
    const auto count = static_cast<uint32_t>(settings_.lights);
    makeLights(frame);
    if (cuts_) {
      tree_.emplace(frame, cuts_->tree);
      cut_.emplace(tree_->cutsFor(frame, count, cuts_->limits, cuts_->cuts));
      frame.passes().setBytesHeld(kCutsPass, cut_->bytes());
    }
    if (polygons_) triangles_.emplace(frame);
    if (cuts_ || polygons_) {
      atlas_.emplace(frame.context(), count, glm::ivec2(tilePx()), many_lods::AtlasForm::Depth,
                     cuts_ ? cuts_->tree.discs : many_lods::Discs::Spheres);
      frame.passes().setBytesHeld(cuts_ ? kSplatPass : kSkyShadowPass, atlas_->bytes());
    }
    radiosity_.emplace(frame, atlas_ ? Radiosity::Sight::Atlas : Radiosity::Sight::Rays, settings_.receivers);
  }

  void render(frame::Frame& frame) override {
    DepthBias bias;
    if (cuts_) {
      tree_->update(frame);
      findCuts(frame, false);
      const auto scope = frame.passes().open(kSplatPass);
      atlas_->draw(*cut_, tree_->tree().nodes(), *views_, tree_->discs(0.0));
      bias =
          cuts_->bias.of(tree_->tree().leafRadius(), pixelSlope_, cuts_->tree.discs, cuts_->limits.epsilonPx);
    } else if (polygons_) {
      const auto scope = frame.passes().open(kSkyShadowPass);
      triangles_->draw(frame, *views_, static_cast<uint32_t>(settings_.lights), *atlas_);
      bias = {0.0, polygons_->bias * pixelSlope_};
    }
    radiosity_->shade(frame, {*lights_, *views_, static_cast<uint32_t>(settings_.lights), 0.0},
                      atlas_ ? &*atlas_ : nullptr, bias);
  }

  const gl::Texture& product() const override { return radiosity_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    if (!cuts_) return {};
    findCuts(frame, true);
    return cutCounters(cut_->control(), cut_->viewCount(), *tree_);
  }

 private:
  SkyMaps maps() const { return cuts_ ? cuts_->maps : polygons_ ? polygons_->maps : SkyMaps{}; }
  int tilePx() const { return maps().tilePx; }

  void makeLights(frame::Frame& frame) {
    scene::Bounds bounds = frame.scene().bounds();
    const double farthest = bounds.diagonal();
    if (maps().fit == SkyFit::Casters && !frame.scene().casterBounds().empty())
      bounds = frame.scene().casterBounds();
    const glm::dvec3 middle = bounds.centre() - frame.gpuScene().anchor();
    const double diagonal = std::max(bounds.diagonal(), 1e-30);
    // Of a sphere around everything, with a little room for discs.
    const double distance = kSkyDistance * diagonal,
                 tangent = 0.51 / std::sqrt(kSkyDistance * kSkyDistance - 0.25);
    const double epsilon = cuts_ ? cuts_->limits.epsilonPx : 1.0;
    std::vector<VirtualLight> lights;
    std::vector<many_lods::CutView> views;
    for (const SkyLight& light : skyLights(settings_.sky, static_cast<int>(settings_.lights))) {
      lights.push_back({glm::vec4(glm::vec3(light.direction), kLightDistant), glm::vec4(0.0F),
                        glm::vec4(glm::vec3(static_cast<float>(light.irradiance)), 0.0F)});
      const glm::dvec3 down =
          std::abs(light.direction.y) < 0.9 ? glm::dvec3(0.0, -1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
      views.push_back(many_lods::perspectiveView(middle + distance * light.direction, -light.direction, down,
                                                 glm::dvec2(tangent), tilePx(), epsilon,
                                                 distance + farthest));
    }
    lights_.emplace(lights);
    views_.emplace(views);
    pixelSlope_ = 2.0 * tangent / tilePx();
  }

  void findCuts(frame::Frame& frame, bool counting) {
    const auto scope = frame.passes().open(kCutsPass);
    cut_->update(tree_->tree().nodes(), *views_, counting);
  }

  NaturalSettings settings_;
  const SkyCuts* cuts_;
  const SkyPolygons* polygons_;
  double pixelSlope_ = 0.0;
  std::optional<gl::Buffer> lights_, views_;
  std::optional<SceneTree> tree_;
  std::optional<many_lods::MultiCut> cut_;
  std::optional<PolygonTiles> triangles_;
  std::optional<many_lods::ViewAtlas> atlas_;
  std::optional<Radiosity> radiosity_;
};

const RegisteredTechnique<NaturalIllumination> kNaturalRegistered{
    {.name = "many_lods/natural_illumination",
     .version = 1,
     .summary = "Light of an environment by distant lights, each with a shadow map from cuts for all of them",
     .source = "Holländer 2013, section 3.6.2 (HOL-27)",
     .product = ProductKind::Colour,
     .counters = cutQuantities(),
     .effort = "lights"}};

}  // namespace
}  // namespace limen::techniques
