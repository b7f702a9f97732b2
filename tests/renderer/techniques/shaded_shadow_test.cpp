// SPDX-License-Identifier: BSD-3-Clause
// Soft shadows found within the shading pass, against those found before it.
#include <cmath>
#include <map>

#include "renderer/frame/shaded.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char* kShaded = "soft_shadows/shaded";

class ShadedShadowTest : public TechniqueTest {
 protected:
  static Given with(Given given, const Given& more) {
    for (const auto& [name, value] : more) given[name] = value;
    return given;
  }
  static Given form(const char* inner, const char* loop, const Given& more = {}) {
    return with({{"inner", std::string(inner)},
                 {"inner.resolution", int64_t{128}},
                 {"inner.passes", std::string("single")},
                 {"loop", std::string(loop)}},
                more);
  }
};

size_t differing(const Image& a, const Image& b, float limit) {
  EXPECT_EQ(a.data.size(), b.data.size());
  size_t count = 0;
  for (size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i)
    count += !(std::abs(a.data[i] - b.data[i]) <= limit);
  return count;
}

// The same functions of the same pixels. A software renderer compiles them alike for all stages; others may
// fuse other operations in a fragment shader than in a compute shader. A receiver then lies elsewhere by the
// rounding of a dozen operations, 2^-20 of its distance at most, and a sample, a level or a class may be
// another one. So on these no more values may differ than with the camera moved by four times that; those
// within 1e-4 are what rounding leaves of values that vary smoothly.
TEST_F(ShadedShadowTest, EveryFormHasThePictureOfASinglePassOfItsOwn) {
  const bool exact = context().device().software;
  const float limit = exact ? 0.0F : 1e-4F;
  std::map<std::string, size_t> others;
  size_t moved = 0, values = 0;
  for (const char* name : {"sphere_grid", "columns_hall"}) {
    const scene::Scene scene = makeScene(name);
    scene::Scene beside = makeScene(name);
    for (auto& [time, camera] : beside.camera.keys)
      camera.eye += std::ldexp(glm::length(camera.target - camera.eye), -18) * glm::dvec3(0.6, 0.64, 0.48);
    for (const char* inner : {"bitmask", "backprojection"})
      for (const Given& more :
           {Given{}, Given{{"inner.bias", std::string("normal_offset")}},
            Given{{"inner.structure", std::string("ysm")}, {"inner.structure.base", int64_t{64}}},
            Given{{"inner.levels", std::string("blend")}, {"inner.budget.limit", int64_t{36}}}}) {
        const Image own = render(scene, kShaded, form(inner, "own_pass", more), {61, 45}).product;
        values += own.data.size();
        if (!exact)
          moved +=
              differing(render(beside, kShaded, form(inner, "own_pass", more), {61, 45}).product, own, limit);
        for (const char* loop : {"compute", "full_screen", "forward"})
          others[loop] +=
              differing(render(scene, kShaded, form(inner, loop, more), {61, 45}).product, own, limit);
      }
  }
  for (const auto& [loop, count] : others) EXPECT_LE(count, moved) << loop;
  EXPECT_LT(moved, values / 100) << "a camera moved by rounding changes the picture";
}

// Light reaches a point by its visibility: between the picture with ambient light alone and the one without
// shadows, the picture lies at the share that the inner technique finds.
TEST_F(ShadedShadowTest, ThePictureIsLitByTheInnerVisibility) {
  const scene::Scene scene = makeScene("sphere_grid");
  const Rendered visibility =
      render(scene, "soft_shadows/bitmask", {{"resolution", int64_t{128}}, {"passes", std::string("single")}},
             {61, 45});
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {61, 45});
  frame.begin();
  const Image open = frame.get<frame::Shaded>(frame::ShadedSetting{}).texture().read();
  frame::ShadedSetting ambientAlone;
  ambientAlone.diffuse = 0.0;
  const Image ambient = frame.get<frame::Shaded>(ambientAlone).texture().read();
  frame.end();
  // Fragment shaders are compared with these above: on a GPU single samples may differ.
  for (const char* loop : {"own_pass", "compute"}) {
    const Image shaded = render(scene, kShaded, form("bitmask", loop), {61, 45}).product;
    size_t partly = 0;
    for (size_t i = 0; i < visibility.product.pixels(); ++i) {
      const bool averted = visibility.receivers.data[4 * i + 3] < 0.0F;
      const double share = averted ? 0.0 : double{visibility.product.data[i]};
      partly += share > 0.0 && share < 1.0;
      for (size_t c = 0; c < 3; ++c) {
        const double dark = ambient.data[4 * i + c], light = open.data[4 * i + c];
        // Rounding of a few operations on values up to 1.
        ASSERT_NEAR(shaded.data[4 * i + c], dark + share * (light - dark), 1e-6) << loop << ' ' << i;
      }
    }
    EXPECT_GT(partly, 50U);
  }
}

TEST_F(ShadedShadowTest, WhatNeedsOtherPassesIsRefusedWithAWayOut) {
  const auto hintOf = [](const Given& more) {
    const auto error = refusal(kShaded, with(form("bitmask", "compute"), more));
    return error ? error->hint() : std::string();
  };
  EXPECT_EQ(hintOf({}), "");
  EXPECT_NE(hintOf({{"inner.passes", std::string("split")}}).find("passes: single"), std::string::npos);
  EXPECT_NE(hintOf({{"inner.maps", std::string("peeled")}}).find("maps: centre"), std::string::npos);
  EXPECT_NE(hintOf({{"inner.filter", std::string("surface_mean")}}).find("filter: none"), std::string::npos);
  EXPECT_NE(hintOf({{"inner.budget", std::string("radial")}}).find("own_pass"), std::string::npos);
  const auto rays =
      refusal(kShaded, {{"inner", std::string("ray_traced")}, {"loop", std::string("forward")}});
  ASSERT_TRUE(rays);
  EXPECT_NE(rays->hint().find("own_pass"), std::string::npos);
}

TEST_F(ShadedShadowTest, CountersAreThoseOfTheInnerTechnique) {
  const scene::Scene scene = makeScene("sphere_grid");
  const Rendered plain =
      render(scene, "soft_shadows/bitmask", {{"resolution", int64_t{128}}, {"passes", std::string("single")}},
             {61, 45}, true);
  for (const char* loop : {"own_pass", "compute", "forward"}) {
    const Rendered shaded = render(scene, kShaded, form("bitmask", loop), {61, 45}, true);
    for (const char* counter : {"micro_occluders_per_px", "processed_share", "lit_share"})
      EXPECT_EQ(shaded.counter(counter), plain.counter(counter)) << loop << ' ' << counter;
  }
}

}  // namespace
}  // namespace limen::techniques
