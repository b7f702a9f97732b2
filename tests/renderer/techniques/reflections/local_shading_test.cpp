// SPDX-License-Identifier: BSD-3-Clause
// Terms of local shading against formulas written here: other forms of the same functions, integrals
// over the hemisphere, and properties that any reflectance has.
#include <numbers>

#include "renderer/frame/shaded.h"
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

constexpr double kPi = std::numbers::pi;

double smithFreeCookTorrance(double m, double f0, glm::dvec3 l, glm::dvec3 v) {  // reflectance; normal +y
  const glm::dvec3 h = glm::normalize(l + v);
  const double cosine2 = h.y * h.y, tangent2 = (1.0 - cosine2) / cosine2;
  const double density = std::exp(-tangent2 / (m * m)) / (kPi * m * m * cosine2 * cosine2);
  const double f = f0 + (1.0 - f0) * std::pow(1.0 - glm::dot(v, h), 5.0);
  const double g = std::min(1.0, 2.0 * h.y * std::min(v.y, l.y) / glm::dot(v, h));
  return f * density * g / (4.0 * v.y * l.y);
}

class LocalShading : public ReflectionTest {
 protected:
  /// What Shaded makes of the plane y = 0, seen along `view` and lit along `light` from afar: its highlight
  /// alone, at the picture's middle.
  static double highlight(frame::ShadedSetting setting, glm::dvec3 light, glm::dvec3 view) {
    scene::Scene scene;
    scene::addPart(scene, "plane", scene::planeGrid(glm::dvec3(0.0), 0.02, 0.02, 1), glm::vec3(0.5F));
    scene.lights = {scene::lightTowards(1e4 * light, glm::dvec3(0.0), glm::dvec2(1.0))};
    scene::setStillCamera(scene, {view, glm::dvec3(0.0), {0.3, 0.1, 0.7}, 0.5});
    setting.ambient = 0.0, setting.diffuse = 0.0, setting.background = 0.0;
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {1, 1});
    frame.begin();
    const double value = frame.get<frame::Shaded>(setting).texture().read().data[0];
    frame.end();
    return value;
  }
  static glm::dvec3 towards(double elevation, double azimuth) {
    return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
            std::cos(elevation) * std::sin(azimuth)};
  }
};

/// Phong: the angle between the light and the mirrored view, from spherical trigonometry; Blinn: cos of the
/// half angle as (sin a + sin b) / |l + v|. Float: relative 1e-4 covers powers of up to 40 of numbers rounded
/// to 2^-22.
TEST_F(LocalShading, PowersOfCosines) {
  for (const auto& [a, b, turn] :
       {std::array{0.9, 0.7, 3.0}, std::array{1.2, 0.5, 2.2}, std::array{0.4, 0.4, 3.1}}) {
    const glm::dvec3 light = towards(a, 0.3), view = towards(b, 0.3 + turn);
    frame::ShadedSetting setting;
    setting.specular = 0.7, setting.shininess = 20.0;
    const double together = std::sin(a) * std::sin(b) + std::cos(a) * std::cos(b) * std::cos(turn);
    const double middle = (std::sin(a) + std::sin(b)) / std::sqrt(2.0 + 2.0 * together);
    EXPECT_NEAR(highlight(setting, light, view) / (0.7 * std::pow(middle, 20.0)), 1.0, 1e-4);
    setting.highlight = frame::PhongHighlight{};
    const double mirrored = std::sin(a) * std::sin(b) - std::cos(a) * std::cos(b) * std::cos(turn);
    EXPECT_NEAR(highlight(setting, light, view) / (0.7 * std::pow(mirrored, 20.0)), 1.0, 1e-4);
  }
}

/// Against the formula above, and the same when light and view change places, which the term times the
/// light's cosine is only after division by that cosine. The plane is seen and lit at elevations known to
/// 1e-4 (a light at 1e4, a pixel of 0.5 degrees at its middle), a sixth decimal of float: relative 1e-3.
TEST_F(LocalShading, MicrofacetsAndTheirReciprocity) {
  for (const double m : {0.15, 0.5})
    for (const auto& [a, b, turn] :
         {std::array{0.9, 0.7, 3.0}, std::array{1.2, 0.8, 2.8}, std::array{0.5, 0.6, 3.1}}) {
      const glm::dvec3 light = towards(a, 0.3), view = towards(b, 0.3 + turn);
      frame::ShadedSetting setting;
      setting.specular = 1.0;
      setting.highlight = frame::CookTorranceHighlight{m, 0.1};
      const double there = highlight(setting, light, view) / light.y,
                   back = highlight(setting, view, light) / view.y;
      EXPECT_NEAR(there / (kPi * smithFreeCookTorrance(m, 0.1, light, view)), 1.0, 1e-3);
      EXPECT_NEAR(there / back, 1.0, 1e-3);
    }
}

/// The distribution of facets covers the surface exactly: the integral of D cos over the hemisphere is 1; and
/// the surface reflects no more than it gets, at any angle, while even a perfect conductor's V-grooves lose
/// light.
TEST_F(LocalShading, MicrofacetsConserveEnergy) {
  constexpr int kRings = 400, kSectors = 400;
  for (const double m : {0.1, 0.3, 0.6}) {
    double covered = 0.0;
    constexpr int kFine = 20000;
    for (int i = 0; i < kFine; ++i) {
      const double cosine = (i + 0.5) / kFine, tangent2 = 1.0 / (cosine * cosine) - 1.0;
      covered +=
          2.0 * kPi / kFine * cosine * std::exp(-tangent2 / (m * m)) / (kPi * m * m * std::pow(cosine, 4.0));
    }
    EXPECT_NEAR(covered, 1.0, 1e-3) << m;
    for (const double elevation : {0.2, 0.7, 1.5}) {
      const glm::dvec3 view = towards(elevation, 0.0);
      double reflected = 0.0;
      for (int i = 0; i < kRings; ++i)
        for (int k = 0; k < kSectors; ++k) {
          const double cosine = (i + 0.5) / kRings;
          const glm::dvec3 light = towards(std::asin(cosine), 2.0 * kPi * (k + 0.5) / kSectors);
          reflected +=
              2.0 * kPi / (kRings * double(kSectors)) * cosine * smithFreeCookTorrance(m, 1.0, light, view);
        }
      EXPECT_LE(reflected, 1.01) << m << " at " << elevation;
    }
  }
}

/// Schlick's rule: a mirror of share 0.1 at normal incidence in front of a white background, over black: at
/// 60 degrees 0.1 + 0.9 / 32.
TEST_F(LocalShading, SchlicksShareOfAMirror) {
  for (const double angleDeg : {0.0, 45.0, 60.0, 80.0}) {
    scene::Scene scene;
    scene::Material material = mirrorMaterial(0.1F);
    material.albedo = glm::vec3(0.0F);
    material.fresnel = true;
    scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 0.02, 0.02, 1), material);
    const double angle = glm::radians(angleDeg);
    scene::setStillCamera(scene,
                          {{std::sin(angle), std::cos(angle), 0.0}, glm::dvec3(0.0), {0.1, 0.2, 1.0}, 0.1});
    const Image found =
        render(scene, "reflections/ray_traced", {{"shading.background", 1.0}}, {1, 1}).product;
    const double c = std::cos(angle), x = 1.0 - c;
    EXPECT_NEAR(found.data[0], 0.1 + 0.9 * x * x * x * x * x, 1e-5) << angleDeg;
  }
}

/// Whitted's sum of two mirrors: what the first adds to its own light is its share of the second's own light
/// plus shares of both of the background. All by hand: a camera looks down on a floor that mirrors a ceiling.
TEST_F(LocalShading, WhittedsSum) {
  scene::Scene scene;
  scene::Material floor = mirrorMaterial(0.5F), ceiling = mirrorMaterial(0.25F);
  floor.albedo = glm::vec3(0.4F), ceiling.albedo = glm::vec3(0.8F);
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 1.0, 1.0, 1), floor);
  scene::addPart(scene, scene::card({3.0, 1.0, 0.0}, {1.5, 0.0, 0.0}, {0.0, 0.0, 1.0}), ceiling);
  scene::setStillCamera(scene, {{-1.0, 0.5, 0.0}, glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.1});
  const Given given = {{"shading.ambient", 1.0}, {"shading.diffuse", 0.0}, {"shading.background", 0.9}};
  for (const int bounces : {1, 2}) {
    Given with = given;
    with["bounces"] = int64_t{bounces};
    const double expected = bounces == 1 ? 0.4 + 0.5 * 0.8 : 0.4 + 0.5 * (0.8 + 0.25 * 0.9);
    for (const char* technique :
         {"reflections/ray_traced", "reflections/reference", "reflections/planar_mirror"})
      EXPECT_NEAR(render(scene, technique, with, {1, 1}).product.data[0], expected, 1e-6) << technique;
  }
}

/// All forms in reflected light as well: the tracer against the reference.
TEST_F(LocalShading, HighlightsInMirrorsAreThoseOfTheReference) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  for (const char* form : {"blinn", "phong", "cook_torrance"}) {
    const Given given = {{"shading.specular", 0.5}, {"shading.highlight", std::string(form)}};
    const Differing result = differing(render(scene, "reflections/ray_traced", given, {96, 72}).product,
                                       render(scene, "reflections/reference", given, {96, 72}).product, 1e-3);
    EXPECT_LE(result.count, 15U) << form;
  }
}

}  // namespace
}  // namespace limen::techniques
