// SPDX-License-Identifier: BSD-3-Clause
// Instant radiosity with shadow maps of the scene's triangles, all of them in every light's map: the simplest
// rival of cuts, which the thesis calls polygons, and what its shadow maps approximate. Source: Keller 1997;
// Holländer 2013, section 3.6.2 (table 3.1). Projection and tiles are those of many_lods/instant_radiosity.
#include <optional>

#include "renderer/techniques/many_lods/polygon_tiles.h"
#include "renderer/techniques/many_lods/radiosity.h"
#include "renderer/techniques/many_lods/receiver_surface.h"
#include "renderer/techniques/many_lods/shadow_bias.h"
#include "renderer/techniques/many_lods/virtual_lights.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kPolygonsPass = "many_lods/polygons";

struct PolygonShadowSettings {
  VirtualLightSettings lights;
  int tilePx = 64;
  double bias = 1.0;
  ReceiverSurface receivers;
  static const SettingsTable<PolygonShadowSettings>& table() {
    using S = PolygonShadowSettings;
    static const SettingsTable<S> kTable = {
        included(&S::lights),
        {&S::tilePx, "tile", {4, 512}, "px", "Side of a light's shadow map"},
        {&S::bias,
         "bias",
         {0.0, 16.0},
         "px",
         "How much nearer to a light than a point its occluders are, pixels of the map times 1 + the "
         "surface's "
         "slope"},
        {&S::receivers, "receivers", kReceiverText}};
    return kTable;
  }
};

class PolygonShadowMaps : public Technique {
 public:
  using Settings = PolygonShadowSettings;
  explicit PolygonShadowMaps(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    lights_.emplace(frame, settings_.lights);
    polygons_.emplace(frame);
    atlas_.emplace(frame.context(), lights_->count(), glm::ivec2(settings_.tilePx),
                   many_lods::AtlasForm::Depth);
    radiosity_.emplace(frame, Radiosity::Sight::Atlas, settings_.receivers);
    frame.passes().setBytesHeld(kPolygonsPass, atlas_->bytes());
  }

  void render(frame::Frame& frame) override {
    // As far above the light's surface as a float can tell, so that it does not hide the light.
    lights_->make(frame, step_++, settings_.tilePx, 1.0, 1e-5 * frame.gpuScene().diagonal());
    {
      const auto scope = frame.passes().open(kPolygonsPass);
      polygons_->draw(frame, lights_->views(), lights_->count(), *atlas_);
    }
    radiosity_->shade(frame, lights_->set(), &*atlas_,
                      {0.0, settings_.bias * hemispherePixelSlope(settings_.tilePx)});
  }

  const gl::Texture& product() const override { return radiosity_->texture(); }
  std::vector<Counter> count(frame::Frame& frame) override {
    return {{"triangles_drawn", double(frame.scene().mesh.triangles.size()) * lights_->count()}};
  }

 private:
  PolygonShadowSettings settings_;
  int step_ = 0;
  std::optional<VirtualLights> lights_;
  std::optional<PolygonTiles> polygons_;
  std::optional<many_lods::ViewAtlas> atlas_;
  std::optional<Radiosity> radiosity_;
};

const RegisteredTechnique<PolygonShadowMaps> kPolygonShadowsRegistered{
    {.name = "many_lods/polygon_shadow_maps",
     .version = 1,
     .summary = "One bounce of light by virtual point lights, their shadow maps drawn from all triangles",
     .source = "Keller 1997; Holländer 2013, section 3.6.2 (HOL-25)",
     .product = ProductKind::Colour,
     .needs = {"area_light"},
     .counters = {{"triangles_drawn", "Triangles drawn for all views", "", Direction::LowerIsBetter}},
     .effort = "tile"}};

}  // namespace
}  // namespace limen::techniques
