// SPDX-License-Identifier: BSD-3-Clause
// Rays shared by squares of pixels, and the filter that joins them.
#include <algorithm>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using FieldRaySetsTest = TechniqueTest;

/// The light is off z = 0, where the axes across the line of sight change their sign from one pixel to the
/// next. A box over the ground, and a view so narrow that all pixels see the same point of it, up to 1e-4.
scene::Scene onePoint() {
  scene::Scene scene;
  scene::addGround(scene, 8.0);
  scene::addPart(scene, "box", scene::box({-0.15, 0.5, -0.25}, {0.6, 1.1, 0.45}), glm::vec3(0.5F));
  scene.lights = {scene::lightTowards({-0.5, 4.0, 0.3}, {0.0, 0.0, 0.0}, glm::dvec2(2.0))};
  scene::setStillCamera(scene, {{0.0, 0.2, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 0.02});
  return scene;
}

double meanOfPixels(const Image& image) {
  double sum = 0.0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y);
  return sum / (double(image.width) * image.height);
}

// 4 x 4 pixels with 4 x 4 rays each have the 16 x 16 rays of one pixel together: cell (i + (k + 0.5) / 4) / 4
// is (4 i + k + 0.5) / 16. Points differ by less than 1e-4 of the distance to the box, so that a ray within
// 1e-4 of its outline may count either way: of 256 rays over the unit disc, or over the light, those near an
// outline below 4 long number 256 * 4 * 2e-4 / pi = 0.07 on average; one is allowed.
TEST_F(FieldRaySetsTest, PixelsOfASquareHaveTheFinerSetTogether) {
  const scene::Scene scene = onePoint();
  struct Choice {
    const char *name, *path, *near;
  };
  for (const auto& [name, path, near] :
       std::initializer_list<Choice>{{"visibility_fields/traced_occlusion", "", ""},
                                     {"visibility_fields/traced_shadows", "", ""},
                                     {"visibility_fields/ambient_occlusion", "combine.near", "field"},
                                     {"visibility_fields/ambient_occlusion", "combine.near", "traced"},
                                     {"visibility_fields/ambient_occlusion", "combine.near", "doubtful"},
                                     {"visibility_fields/soft_shadows", "near", "field"},
                                     {"visibility_fields/soft_shadows", "near", "traced"},
                                     {"visibility_fields/soft_shadows", "near", "doubtful"}}) {
    Given fine = {{"rays", int64_t{256}}},
          shared = {{"rays", int64_t{16}}, {"pattern", std::string("interleaved")}};
    if (*path)
      for (Given* given : {&fine, &shared}) {
        (*given)[path] = std::string(near);
        if (std::string(near) == "doubtful") (*given)[std::string(path) + ".capacity"] = 1.0;
      }
    if (std::string(name).find("occlusion") != std::string::npos)
      for (Given* given : {&fine, &shared}) (*given)["radius"] = 10.0;
    const double expected = meanOfPixels(render(scene, name, fine, {4, 4}).product);
    const Image each = render(scene, name, shared, {4, 4}).product;
    ASSERT_LT(expected, 0.9) << name;
    EXPECT_NEAR(meanOfPixels(each), expected, 1.0 / 256.0 + 1e-5) << name;
    float least = 1.0F, most = 0.0F;
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        least = std::min(least, each.at(x, y)), most = std::max(most, each.at(x, y));
    // Pixels for themselves do not have it.
    EXPECT_GT(most - least, 2.0F / 256.0F) << name;
    // Where all of its window lies in the picture, a filtered pixel is that mean. Neighbours are 4e-6 apart
    // and known to 1e-8, so that planes through them seem to lean by up to 0.0025, and weights are off by
    // that over the filter's sine of 20 degrees, 0.0073; values are within 0.1 of their mean.
    shared["pattern.filter"] = std::string("bilateral");
    const Image filtered = render(scene, name, shared, {16, 16}).product;
    for (int y = 2; y < 14; ++y)
      for (int x = 2; x < 14; ++x)
        ASSERT_NEAR(filtered.at(x, y), expected, 1.0 / 256.0 + 1e-3) << name << ' ' << x << ' ' << y;
  }
}

// The top of a box sees nothing above it; the ground beside it, 0.5 below under the same normal, is dark.
// From the top's rim ground appears 4 pixels, 0.11, aside: 78 degrees below the top's plane.
TEST_F(FieldRaySetsTest, SurfacesDoNotMix) {
  scene::Scene scene;
  scene::addGround(scene, 8.0);
  scene::addPart(scene, "box", scene::box({-0.5, 0.1, -0.5}, {0.5, 0.5, 0.5}), glm::vec3(0.5F));
  scene::setStillCamera(scene, {{0.0, 3.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 40.0});
  constexpr int kSide = 64;
  Given given = {{"rays", int64_t{16}}, {"pattern", std::string("interleaved")}, {"radius", 10.0}};
  given["pattern.side"] = int64_t{8};
  const Image plain = render(scene, "visibility_fields/traced_occlusion", given, {kSide, kSide}).product;
  given["pattern.filter"] = std::string("bilateral");
  const Image filtered = render(scene, "visibility_fields/traced_occlusion", given, {kSide, kSide}).product;
  // Half the top, 0.5 at a distance of 2.5, in pixels, and a pixel within it.
  const int half = static_cast<int>(0.5 / (2.5 * std::tan(glm::radians(20.0))) * kSide / 2) - 1;
  double darkest = 1.0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool top = std::max(std::abs(2 * x + 1 - kSide), std::abs(2 * y + 1 - kSide)) < 2 * half;
      if (top) {
        ASSERT_EQ(plain.at(x, y), 1.0F);
        ASSERT_NEAR(filtered.at(x, y), 1.0F, 1e-6F) << x << ' ' << y;
      } else {
        darkest = std::min(darkest, double(plain.at(x, y)));
      }
    }
  EXPECT_LT(darkest, 0.8);
}

}  // namespace
}  // namespace limen::techniques
