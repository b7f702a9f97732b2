// SPDX-License-Identifier: BSD-3-Clause
#include <random>

#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"
#include "renderer/techniques/many_lods/virtual_lights.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class RadiosityPictures : public TechniqueTest {
 protected:
  static double mean(const Image& picture) {
    double sum = 0.0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        for (int c = 0; c < 3; ++c) sum += double(picture.at(x, y, c));
    return sum / (3.0 * picture.width * picture.height);
  }
};

struct Met {
  double along = INFINITY;
  glm::dvec3 position{0.0}, normal{0.0};  // towards where the ray comes from
  glm::dvec3 albedo{0.0};
};

/// In double precision, one triangle after the other.
Met firstMet(const scene::Scene& scene, glm::dvec3 origin, glm::dvec3 direction, double least, double most) {
  Met out;
  out.along = most;
  bool found = false;
  for (const scene::Part& part : scene.parts)
    for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i) {
      const glm::uvec3 t = scene.mesh.triangles[i];
      const glm::dvec3 a = scene.mesh.positions[t.x], e1 = scene.mesh.positions[t.y] - a,
                       e2 = scene.mesh.positions[t.z] - a;
      const glm::dvec3 p = glm::cross(direction, e2);
      const double determinant = glm::dot(e1, p);
      if (determinant == 0.0) continue;
      const glm::dvec3 s = origin - a, q = glm::cross(s, e1);
      const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
      const double along = glm::dot(e2, q) / determinant;
      if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && along > least && along < out.along)) continue;
      found = true;
      out.along = along;
      out.normal = glm::normalize(glm::cross(e1, e2));
      if (glm::dot(out.normal, direction) > 0.0) out.normal = -out.normal;
      out.albedo = glm::dvec3(scene.materials[part.material].albedo);
    }
  if (!found) out.along = INFINITY;
  if (found) out.position = origin + out.along * direction;
  return out;
}

// The same light by paths in double precision, with directions of its own: from the light's centre with the
// cosine's density to a surface, and from there to the point that a pixel sees. The mean over the picture of
// 12 x 12 pixels and 400 paths has a standard error of less than 2 %, as have 1,024 lights of the pattern.
TEST_F(RadiosityPictures, TracedLightIsThatOfPaths) {
  const scene::Scene scene = makeScene("cornell_box");
  constexpr int kSide = 12, kPaths = 400;
  const Image found = render(scene, "many_lods/traced_radiosity",
                             {{"lights", int64_t{1024}}, {"clamp", 0.1}, {"gain", 1.0}}, {kSide, kSide})
                          .product;
  const scene::AreaLight& light = scene.lights[0];
  const double flux = std::acos(-1.0) * light.area() * double(light.parts[0].radiance.x);
  const double least2 = std::pow(0.1 * scene.bounds().diagonal(), 2.0);
  const scene::Camera camera = scene.camera.at(0.0);
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double tangent = std::tan(glm::radians(0.5 * camera.verticalFovDeg));
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Met> lights;
  for (int i = 0; i < kPaths; ++i) {
    const double radius = std::sqrt(unit(random)), turn = 2.0 * std::acos(-1.0) * unit(random);
    const glm::dvec3 direction = light.axisX * (radius * std::cos(turn)) +
                                 light.axisY * (radius * std::sin(turn)) +
                                 light.direction() * std::sqrt(1.0 - radius * radius);
    const Met at = firstMet(scene, light.centre, direction, 0.0, INFINITY);
    if (std::isfinite(at.along)) lights.push_back(at);
  }
  double sum = 0.0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec3 direction =
          glm::normalize(forward + tangent * ((2.0 * (x + 0.5) / kSide - 1.0) * right -
                                              (2.0 * (y + 0.5) / kSide - 1.0) * up));
      const Met seen = firstMet(scene, camera.eye, direction, 0.0, INFINITY);
      if (!std::isfinite(seen.along)) continue;
      for (const Met& from : lights) {
        const glm::dvec3 path = from.position - seen.position;
        const double distance2 = glm::dot(path, path);
        const double cosines = glm::dot(path, seen.normal) * -glm::dot(path, from.normal) / distance2;
        if (glm::dot(path, seen.normal) <= 0.0 || cosines <= 0.0) continue;
        if (std::isfinite(firstMet(scene, seen.position, path, 1e-6, 1.0 - 1e-6).along)) continue;
        const double share = cosines / (std::acos(-1.0) * std::acos(-1.0) * std::max(distance2, least2));
        for (int c = 0; c < 3; ++c) sum += flux / kPaths * share * from.albedo[c] * seen.albedo[c];
      }
    }
  const double expected = sum / (3.0 * kSide * kSide);
  ASSERT_GT(expected, 0.0);
  EXPECT_NEAR(mean(found), expected, 0.08 * expected);
}

// Shadow maps of 64 pixels against rays for the same lights: their discs are a pixel or two in size, so that
// outlines of shadows shift by that, 3 degrees. 10 % of the mean light is allowed.
TEST_F(RadiosityPictures, ShadowMapsFromCutsComeNearToRays) {
  const scene::Scene scene = makeScene("cornell_box");
  const Given lights = {{"lights", int64_t{32}}};
  const Image truth = render(scene, "many_lods/traced_radiosity", lights, {40, 40}).product;
  for (const char* cuts : {"incremental", "in_place"}) {
    Given given = lights;
    given["levels"] = int64_t{14};
    given["cuts"] = std::string(cuts);
    // One, for a software renderer's limit on loops.
    if (std::string(cuts) == "in_place") given["cuts.views_per_group"] = int64_t{1};
    const Rendered found = render(scene, "many_lods/instant_radiosity", given, {40, 40}, true);
    EXPECT_EQ(found.counter("refused_splits"), 0.0) << cuts;
    if (std::string(cuts) == "in_place") {
      ASSERT_EQ(found.counter("unfinished_groups"), 0.0);
      EXPECT_LE(found.counter("stack_entries"), found.counter("stack_bound"));
    }
    EXPECT_LT(meanDifference(found.product, truth), 0.1 * mean(truth)) << cuts;
  }
}

// In place or from lists, cuts are the same from the root.
TEST_F(RadiosityPictures, InPlaceOrOneByOneIsTheSamePicture) {
  const scene::Scene scene = makeScene("columns_hall");
  // Few and small, for a software renderer's limit on loops.
  const Given given = {{"lights", int64_t{10}}, {"levels", int64_t{9}}, {"tile", int64_t{8}}};
  Given inPlace = given;
  inPlace["cuts"] = std::string("in_place");
  inPlace["cuts.views_per_group"] = int64_t{3};
  Given sequential = given;
  sequential["cuts"] = std::string("sequential");
  const Image listed = render(scene, "many_lods/instant_radiosity", given, {24, 24}).product;
  EXPECT_EQ(render(scene, "many_lods/instant_radiosity", inPlace, {24, 24}).product.data, listed.data);
  EXPECT_EQ(render(scene, "many_lods/instant_radiosity", sequential, {24, 24}).product.data, listed.data);
}

// As the light turns by half a degree, lights move by that angle and what the surface's slope makes of it: by
// less than a twentieth of the scene unless their ray meets another surface, and randomly chosen ones would
// be a third of it apart.
TEST_F(RadiosityPictures, LightsStayThemselvesAsTheLightMoves) {
  const scene::Scene scene = makeScene("columns_hall");
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {8, 8});
  const VirtualLights lights(frame, {.count = 512, .turnDeg = 0.5});
  frame.begin();
  lights.make(frame, 0, 64, 1.0, 0.0);
  const std::vector<VirtualLight> before = lights.lights().read<VirtualLight>();
  lights.make(frame, 0, 64, 1.0, 0.0);
  const std::vector<VirtualLight> same = lights.lights().read<VirtualLight>();
  lights.make(frame, 1, 64, 1.0, 0.0);
  const std::vector<VirtualLight> after = lights.lights().read<VirtualLight>();
  frame.end();
  int there = 0, near = 0;
  double moved = 0.0;
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].position, same[i].position);
    if (before[i].position.w == 0.0F || after[i].position.w == 0.0F) continue;
    ++there;
    const double distance = glm::distance(glm::vec3(before[i].position), glm::vec3(after[i].position));
    near += distance < 0.05 * scene.bounds().diagonal() ? 1 : 0;
    moved += distance;
  }
  ASSERT_GT(there, 20);
  EXPECT_GT(near, 0.9 * there);
  EXPECT_GT(moved, 0.0);
}

}  // namespace
}  // namespace limen::techniques
