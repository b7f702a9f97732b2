// SPDX-License-Identifier: BSD-3-Clause
// Cases whose visibility is exactly 0, exactly 1 or otherwise known without rounding, at every scale and
// place.
#include <cmath>
#include <cstring>

#include "experiments/base/error.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/renderer/references/render_reference.h"

namespace limen::references {
namespace {

constexpr glm::ivec2 kExactSize{64, 64};

struct Method {
  const char* name;
  Given given;
};

/// Every reference, at a price that suits a test.
std::vector<Method> methods() {
  return {{"soft_shadows/exact_union", {}},
          {"soft_shadows/ray_traced", {{"samples", int64_t{64}}}},
          {"soft_shadows/sampled_light", {{"samples", int64_t{16}}, {"resolution", int64_t{512}}}}};
}

class ExactCases : public gl::GlTest {};

/// One sphere over a plane. Sight lines from p to the light lie within half the light's diagonal of the line
/// from p to the light's centre, so the distance of the sphere's centre from that line tells lit from umbra.
TEST_F(ExactCases, LitSurfacesAreExactlyOneAndUmbraExactlyZeroAtEveryScaleAndPlace) {
  for (const auto& [scale, offset] :
       {std::pair(1.0, 0.0), {1e-4, 0.0}, {1e4, 0.0}, {1.0, 1e4}, {1e-4, 100.0}}) {
    const scene::Scene scene =
        builtScene("sphere_grid", {{"spheres_per_axis", int64_t{1}}, {"scale", scale}, {"offset", offset}});
    const scene::AreaLight& light = scene.lights[0];
    // The sphere is symmetric: its centre is the middle of its bounds.
    const glm::dvec3 centre(light.toLightSpace() * glm::dvec4(scene.casterBounds().centre(), 1.0));
    const double radius = 0.36 * 1.6 * scale, lightRadius = 0.5 * glm::length(light.size);
    for (const Method& method : methods()) {
      const Rendered rendered = renderReference(context(), scene, method.name, method.given, kExactSize);
      size_t litSphere = 0, litGround = 0, umbra = 0, wrong = 0;
      for (size_t i = 0; i < rendered.visibility.pixels(); ++i) {
        if (!rendered.isReceiver(i)) continue;
        const glm::dvec3 p = rendered.point(i), toLight = -glm::normalize(p), fromCentre = p - centre;
        const float visibility = rendered.visibility.data[i];
        const double along = -glm::dot(fromCentre, toLight),
                     beside = glm::length(fromCentre + along * toLight);
        if (glm::length(fromCentre) < 1.01 * radius) {
          // A facet deviates by at most 6 degrees; the light is seen under 5.
          if (glm::dot(fromCentre, toLight) < 0.3 * radius) continue;
          ++litSphere, wrong += visibility != 1.0F;
        } else if (along < 0.0 || beside > radius + lightRadius) {
          ++litGround, wrong += visibility != 1.0F;
        } else if (beside < 0.95 * radius - lightRadius) {
          ++umbra, wrong += visibility != 0.0F;
        }
      }
      EXPECT_EQ(wrong, 0U) << method.name << " at scale " << scale << ", offset " << offset;
      EXPECT_GT(litSphere, 50U);
      EXPECT_GT(litGround, 500U);
      EXPECT_GT(umbra, 20U);
    }
  }
}

/// A tilted open sheet whose plane cuts the light: only the part of the light in front of the sheet is seen.
TEST_F(ExactCases, ASheetHidesThePartOfTheLightBehindItsPlane) {
  scene::Scene scene;
  // The plane x = y / 8 through the origin, nearly upright; the light, 4 wide, is centred 2 above it at x =
  // 1/2 and lies in [-3/2, 5/2]: the plane cuts it at x = 1/4.
  scene::addPart(scene, "sheet", scene::card({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0625, 0.5, 0.0}),
                 glm::vec3(0.7F));
  scene.lights = {scene::lightTowards({0.5, 2.0, 0.0}, {0.5, 0.0, 0.0}, {4.0, 4.0})};
  scene::setStillCamera(scene, {{3.0, 0.5, 0.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 30.0});
  constexpr double kSeen = (2.5 - 0.25) / 4.0;
  for (const Method& method : methods()) {
    const Rendered rendered = renderReference(context(), scene, method.name, method.given, {32, 32});
    EXPECT_GT(rendered.receiverCount(), 50U);
    for (size_t i = 0; i < rendered.visibility.pixels(); ++i) {
      if (!rendered.isReceiver(i)) continue;
      // Grid methods: the cut lies along the grid, so at most one row of cells is misjudged.
      const double bound = std::string(method.name) == "soft_shadows/exact_union"  ? 1e-6
                           : std::string(method.name) == "soft_shadows/ray_traced" ? 1.0 / 8.0
                                                                                   : 0.5 / 4.0 + 1e-6;
      EXPECT_NEAR(rendered.visibility.data[i], kSeen, bound) << method.name;
    }
  }
}

TEST_F(ExactCases, ALightThatFacesAwayGivesNoReceivers) {
  scene::Scene scene = builtScene("two_boxes");
  scene.lights[0].axisX = -scene.lights[0].axisX;  // turns the direction about
  for (const Method& method : methods()) {
    const Rendered rendered = renderReference(context(), scene, method.name, method.given, {33, 17});
    EXPECT_EQ(rendered.receiverCount(), 0U);
    for (const float visibility : rendered.visibility.data) EXPECT_EQ(visibility, 1.0F) << method.name;
  }
}

TEST_F(ExactCases, AOnePixelImageWorks) {
  for (const Method& method : methods()) {
    const Rendered rendered =
        renderReference(context(), builtScene("two_boxes"), method.name, method.given, {1, 1});
    EXPECT_TRUE(rendered.visibility.data[0] >= 0.0F && rendered.visibility.data[0] <= 1.0F);
  }
}

TEST_F(ExactCases, TheSameInputGivesTheSameBytes) {
  const scene::Scene scene = builtScene("sphere_grid", {{"tessellation", int64_t{4}}});
  for (const Method& method : methods()) {
    const Rendered first = renderReference(context(), scene, method.name, method.given, {48, 48});
    const Rendered second = renderReference(context(), scene, method.name, method.given, {48, 48});
    EXPECT_EQ(std::memcmp(first.visibility.data.data(), second.visibility.data.data(),
                          first.visibility.data.size() * sizeof(float)),
              0)
        << method.name;
  }
}

TEST_F(ExactCases, AnotherSeedGivesOtherSamples) {
  const scene::Scene scene = builtScene("half_plane");
  const Rendered first = renderReference(context(), scene, "soft_shadows/ray_traced",
                                         {{"samples", int64_t{16}}, {"seed", int64_t{1}}}, {48, 48});
  const Rendered second = renderReference(context(), scene, "soft_shadows/ray_traced",
                                          {{"samples", int64_t{16}}, {"seed", int64_t{2}}}, {48, 48});
  EXPECT_NE(first.visibility.data, second.visibility.data);
}

/// Cards that are sections of the topmost card's umbra hide nothing that it does not.
TEST_F(ExactCases, CardsInTheUmbraOfACardChangeNothing) {
  const Rendered one =
      renderReference(context(), builtScene("card_stack", {{"cards", int64_t{1}}, {"fit", "umbra"}}),
                      "soft_shadows/exact_union", {}, kExactSize);
  const Rendered many =
      renderReference(context(), builtScene("card_stack", {{"cards", int64_t{16}}, {"fit", "umbra"}}),
                      "soft_shadows/exact_union", {}, kExactSize);
  size_t compared = 0;
  for (size_t i = 0; i < one.visibility.pixels(); ++i) {
    // Ground points that both pictures see; lower cards cover some from the camera.
    if (!one.isReceiver(i) || !many.isReceiver(i) || one.point(i) != many.point(i)) continue;
    // Edges of the umbra's sections coincide with the topmost card's up to float rounding of the vertices.
    EXPECT_NEAR(one.visibility.data[i], many.visibility.data[i], 1e-5);
    compared += one.visibility.data[i] < 1.0F;
  }
  EXPECT_GT(compared, 100U);
}

TEST_F(ExactCases, DegenerateTrianglesGiveFiniteVisibility) {
  const scene::Scene scene = builtScene("degenerate_soup");
  for (const Method& method : methods()) {
    const Rendered rendered = renderReference(context(), scene, method.name, method.given, kExactSize);
    for (const float visibility : rendered.visibility.data)
      EXPECT_TRUE(visibility >= 0.0F && visibility <= 1.0F) << method.name << ' ' << visibility;
  }
}

TEST_F(ExactCases, WrongParametersAreRefusedWithAWayOut) {
  const scene::Scene scene = builtScene("two_boxes");
  const auto message = [&](const std::string& name, const Given& given) -> std::string {
    try {
      renderReference(context(), scene, name, given, {8, 8});
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message("soft_shadows/exact_union", {{"max_triangles", int64_t{3}}}).find("max_triangles"),
            std::string::npos);
  EXPECT_NE(message("soft_shadows/ray_traced", {{"samples", int64_t{1000}}}).find("give 1024"),
            std::string::npos);
  EXPECT_NE(message("soft_shadows/sampled_light", {{"samples", int64_t{1000}}}).find("give 1024"),
            std::string::npos);
  EXPECT_EQ(message("soft_shadows/ray_traced", {{"samples", int64_t{1000}}, {"pattern", "random"}}),
            "no error");
}

}  // namespace
}  // namespace limen::references
