// SPDX-License-Identifier: BSD-3-Clause
// Reflections from a cube map of the surroundings, drawn from the middle of the largest mirror in every frame
// (Roger 2008, section 1.3.2): at infinity, on a sphere, or with the distance of each texel, through which
// the mirrored ray is followed. The mirror itself is left out of the map, and mirrors in it show their own
// light alone. All mirrors of the scene use the one map. Optionally filtered beforehand for diffuse or glossy
// surfaces; the mean of the light, so that the mirror's share alone decides how bright it is.
#include "renderer/techniques/reflections/environment_map/environment_light.h"
#include "renderer/techniques/reflections/reflection_picture.h"

namespace limen::techniques {
namespace {

struct EnvironmentMapSettings {
  EnvironmentLightSettings map;
  frame::ShadedSetting shading;
  static const SettingsTable<EnvironmentMapSettings>& table() {
    using S = EnvironmentMapSettings;
    static const SettingsTable<S> kTable = {included(&S::map), shadingBinding(&S::shading)};
    return kTable;
  }
};

class EnvironmentMap : public Technique {
 public:
  using Settings = EnvironmentMapSettings;
  explicit EnvironmentMap(const Settings& settings)
      : light_(settings.map, settings.shading, false), picture_(settings.shading) {}

  void prepare(frame::Frame& frame) override {
    light_.prepare(frame);
    reflected_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld("reflections/environment_lookup", reflected_->bytes());
    picture_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    light_.draw(frame);
    light_.look(frame, frame.get<frame::MirrorRays>(), *reflected_);
    picture_.compose(frame, *reflected_);
  }

  const gl::Texture& product() const override { return picture_.texture(); }
  std::vector<Counter> count(frame::Frame& frame) override { return light_.count(frame, *reflected_); }

 private:
  EnvironmentLight light_;
  ReflectionPicture picture_;
  std::optional<gl::Texture> reflected_;
};

const RegisteredTechnique<EnvironmentMap> kEnvironmentMapRegistered{
    {.name = "reflections/environment_map",
     .version = 2,
     .summary = "Mirrors that look their light up in a cube map of their surroundings, drawn each frame",
     .source = "Roger 2008, sections 1.3.2 and 5.1 (R-54 to R-58)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .followsMotion = true,
     .counters = EnvironmentLight::counters()}};

}  // namespace
}  // namespace limen::techniques
