// SPDX-License-Identifier: BSD-3-Clause
// Reference of instant radiosity: the same virtual point lights, each seen or not along a ray through the
// tree of the scene's triangles. It shares the lights and their sum with the techniques that it judges, so
// that it judges shadows alone. Source: Keller 1997; Holländer 2013, section 3.6.1.
#include <optional>

#include "renderer/techniques/many_lods/radiosity.h"
#include "renderer/techniques/many_lods/receiver_surface.h"
#include "renderer/techniques/many_lods/virtual_lights.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

struct TracedRadiositySettings {
  VirtualLightSettings lights;
  ReceiverSurface receivers;
  static const SettingsTable<TracedRadiositySettings>& table() {
    using S = TracedRadiositySettings;
    static const SettingsTable<S> kTable = {included(&S::lights),
                                            {&S::receivers, "receivers", kReceiverText}};
    return kTable;
  }
};

class TracedRadiosity : public Technique {
 public:
  using Settings = TracedRadiositySettings;
  explicit TracedRadiosity(const TracedRadiositySettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    lights_.emplace(frame, settings_.lights);
    radiosity_.emplace(frame, Radiosity::Sight::Rays, settings_.receivers);
  }
  void render(frame::Frame& frame) override {
    lights_->make(frame, step_++, 64, 1.0, 0.0);
    radiosity_->shade(frame, lights_->set(), nullptr, {});
  }
  const gl::Texture& product() const override { return radiosity_->texture(); }

 private:
  TracedRadiositySettings settings_;
  int step_ = 0;
  std::optional<VirtualLights> lights_;
  std::optional<Radiosity> radiosity_;
};

const RegisteredTechnique<TracedRadiosity> kTracedRadiosityRegistered{
    {.name = "many_lods/traced_radiosity",
     .version = 2,
     .summary = "One bounce of light by virtual point lights, each seen along a ray",
     .source = "Keller 1997; Holländer 2013, section 3.6.1 (HOL-25)",
     .product = ProductKind::Colour,
     .needs = {"area_light"},
     .reference = true,
     .effort = "lights"}};

}  // namespace
}  // namespace limen::techniques
