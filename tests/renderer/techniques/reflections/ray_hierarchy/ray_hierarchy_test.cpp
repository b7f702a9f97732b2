// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/shapes.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

class RayHierarchyReflection : public ReflectionTest {};

constexpr glm::ivec2 kHierarchyPicture{160, 120};

/// against the CPU in double precision, which shares no shader. The bounds are those that
/// ray_traced_test.cpp derives for rays from float coordinates; they are the rays', not the tracer's.
TEST_F(RayHierarchyReflection, AgreesWithTheReferencePixelByPixel) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  for (const int bounces : {1, 2, 4})
    for (const int shadows : {0, 1, 4}) {
      const Given given = {
          {"bounces", int64_t{bounces}}, {"shadows", int64_t{shadows}}, {"shading.specular", 0.3}};
      const Image truth = render(scene, "reflections/reference", given, kHierarchyPicture).product;
      const Image found = render(scene, "reflections/ray_hierarchy", given, kHierarchyPicture).product;
      const Differing result = differing(found, truth, bounces == 1 ? 2e-4 : 4e-3);
      EXPECT_LE(result.count, 40U) << bounces << " bounces, " << shadows << " levels of shadows";
    }
}

/// A ray whose light would add no more than this share of itself is not followed: with mirrors of 0.8, light
/// of the second bounce adds 0.64.
TEST_F(RayHierarchyReflection, StopsByContribution) {
  const scene::Scene scene = makeScene("mirrors/box", {{"tessellation", int64_t{8}}, {"reflectance", 0.8}});
  const auto picture = [&](int bounces, double least) {
    return render(scene, "reflections/ray_hierarchy", {{"bounces", int64_t{bounces}}, {"least_share", least}},
                  {64, 48})
        .product;
  };
  const Image one = picture(1, 0.0), two = picture(2, 0.0);
  EXPECT_GT(differing(one, two, 1e-3).count, 100U);
  EXPECT_EQ(differing(picture(4, 0.65), one, 0.0).count, 0U);
  EXPECT_EQ(differing(picture(4, 0.63), two, 0.0).count, 0U);
  const Image truth =
      render(scene, "reflections/reference", {{"bounces", int64_t{4}}, {"least_share", 0.65}}, {64, 48})
          .product;
  EXPECT_LE(differing(one, truth, 4e-3).count, 64U * 48U / 100U);
}

/// primary rays see what the rasteriser sees, but for pixels whose centres an edge passes within
/// rounding of: the rasteriser rounds corners to 1/256 of a pixel, and on 2000 pixels' length of edges that
/// is 8 pixels, if all are at right angles to the grid, where each pixel's centre is at the same distance, up
/// to a row of 160 more for each such edge.
TEST_F(RayHierarchyReflection, TracedPrimaryRaysSeeWhatTheRasteriserSees) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  for (const bool shadow : {false, true}) {
    Given given = {{"bounces", int64_t{2}}, {"shadows", int64_t{1}}, {"shading.shadow", shadow}};
    const Image truth = render(scene, "reflections/reference", given, kHierarchyPicture).product;
    given["primary"] = std::string("traced");
    const Image traced = render(scene, "reflections/ray_hierarchy", given, kHierarchyPicture).product;
    EXPECT_LE(differing(traced, truth, 4e-3).count, 60U) << shadow;
  }
}

/// a glass ball of flat triangles before coloured walls, each pixel's light followed in double
/// precision by the triangles alone: refracted at each surface of glass, mirrored inside where nothing
/// leaves. Directions from float are off by 1e-6 a surface, 1e-5 after a distance of 6: pixels whose path
/// runs that close to an edge of one of the some 500 triangles see another one; edges of 2500 px in all, with
/// 60 px a unit and four surfaces in a row far less than 1 % of 4800 pixels.
TEST_F(RayHierarchyReflection, RefractionFollowsSnell) {
  scene::Scene scene;
  scene::addPart(scene, "wall", scene::box({-3.0, -3.0, -3.2}, {3.0, 3.0, -3.0}), {0.8F, 0.3F, 0.1F});
  scene::addPart(scene, "floor", scene::box({-3.0, -1.2, -3.0}, {3.0, -1.0, 3.0}), {0.1F, 0.6F, 0.3F});
  scene::Material glass = mirrorMaterial(0.1F);
  glass.albedo = glm::vec3(0.05F), glass.transmittance = glm::vec3(0.9F), glass.refractiveIndex = 1.5F;
  scene::addPart(scene, scene::sphere({0.0, 0.0, 0.0}, 1.0, 6), glass);
  scene::setStillCamera(scene, scene::orbitCamera({0.0, 0.0, 0.0}, 5.0, 10.0, 15.0));
  const glm::ivec2 size(80, 60);
  const int bounces = 4;
  const Given given = {{"bounces", int64_t{bounces}},
                       {"refraction", true},
                       {"shading.ambient", 1.0},
                       {"shading.diffuse", 0.0},
                       {"shading.background", 0.25}};
  // The same light by all that follow rays, whether their first rays are refracted where a pixel sees glass
  // or start at the eye.
  Given traced = given;
  traced["primary"] = std::string("traced");
  traced["traversal.start_nodes"] = int64_t{16};
  const auto picture = [&](const char* technique, const Given& by) {
    return render(scene, technique, by, size).product;
  };
  Given rebuilt = given;
  rebuilt["tree"] = std::string("rebuilt");
  const std::vector<std::pair<std::string, Image>> pictures = {
      {"hierarchy, traced", picture("reflections/ray_hierarchy", traced)},
      {"hierarchy", picture("reflections/ray_hierarchy", given)},
      {"rays", picture("reflections/ray_traced", given)},
      {"rays, rebuilt", picture("reflections/ray_traced", rebuilt)},
      {"reference", picture("reflections/reference", given)}};

  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, size);
  frame.begin();
  const frame::BruteForce truth(scene, gpuScene.anchor());
  const glm::dmat4 toAnchor = glm::inverse(frame.anchorToCamera());
  const glm::dvec2 half(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov());
  frame.end();
  std::vector<size_t> wrong(pictures.size(), 0);
  size_t refracted = 0;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const glm::dvec2 place =
          (2.0 * (glm::dvec2(x, y) + 0.5) / glm::dvec2(size) - 1.0) * glm::dvec2(1.0, -1.0) * half;
      glm::dvec3 origin(toAnchor[3]),
          way = glm::normalize(glm::dvec3(toAnchor * glm::dvec4(place, -1.0, 0.0))), sum(0.0), share(1.0);
      for (int bounce = 0; bounce <= bounces; ++bounce) {
        // Nothing on this scene's scale is nearer than 1e-6 but the surface that the ray leaves.
        const frame::Hit hit = truth.trace(origin, way, bounce == 0 ? 0.0 : 1e-6);
        if (hit.triangle == frame::TriangleIds::kNone) {
          sum += share * 0.25;
          break;
        }
        const bool isGlass = hit.triangle >= scene.parts[2].firstTriangle;
        const uint32_t part = isGlass ? 2U : hit.triangle >= scene.parts[1].firstTriangle ? 1U : 0U;
        sum += share * glm::dvec3(scene.materials[scene.parts[part].material].albedo);
        if (!isGlass) break;
        if (bounce == 1) ++refracted;
        origin += hit.t * way;
        glm::dvec3 normal = truth.normal(hit.triangle);
        const bool enters = glm::dot(normal, way) < 0.0;
        if (!enters) normal = -normal;
        const double ratio = enters ? 1.0 / 1.5 : 1.5, cosine = -glm::dot(normal, way);
        const double rest = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
        if (rest < 0.0) {
          way += 2.0 * cosine * normal;
        } else {
          way = ratio * way + (ratio * cosine - std::sqrt(rest)) * normal;
          share *= glm::dvec3(0.9F);
        }
        way = glm::normalize(way);
      }
      for (size_t i = 0; i < pictures.size(); ++i)
        for (int c = 0; c < 3; ++c)
          if (!(std::abs(double(pictures[i].second.at(x, y, c)) - sum[c]) < 1e-5)) {
            ++wrong[i];
            break;
          }
    }
  EXPECT_GT(refracted, 400U);
  for (size_t i = 0; i < pictures.size(); ++i) EXPECT_LE(wrong[i], 48U) << pictures[i].first;
}

/// Same scene, same bits, whatever the order in which the GPU takes its groups.
TEST_F(RayHierarchyReflection, SamePictureTwice) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  const Given given = {{"bounces", int64_t{3}}, {"shadows", int64_t{3}}};
  const Image once = render(scene, "reflections/ray_hierarchy", given, {96, 72}).product;
  EXPECT_EQ(render(scene, "reflections/ray_hierarchy", given, {96, 72}).product.data, once.data);
  Given spilling = given;
  spilling["traversal.capacity"] = int64_t{300};
  spilling["traversal.overflow"] = std::string("spilled_pairs");
  EXPECT_EQ(render(scene, "reflections/ray_hierarchy", spilling, {96, 72}).product.data, once.data);
}

/// Where no pair finds room, invocations go down to the rays on the spot. Triangles around everything
/// meet all 102,400 nodes over 320 x 240 rays, more than the 65,535 rounds that a software renderer's loops
/// have. None may be lost: rays from a flat mirror to a ceiling that covers all they can meet, of the colour
/// that ambient light alone gives it.
TEST_F(RayHierarchyReflection, PairsWithoutRoomMeetAllRaysOfALargePicture) {
  scene::Scene scene;
  scene::Material mirror = mirrorMaterial(0.8F);
  mirror.albedo = glm::vec3(0.0F);
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 9.0, 9.0, 1), mirror);
  scene::addPart(scene, "ceiling", scene::planeGrid(glm::dvec3(0.0, 3.0, 0.0), 90.0, 90.0, 1),
                 glm::vec3(0.5F));
  scene::setStillCamera(scene, {glm::dvec3(0.0, 2.0, 0.5), glm::dvec3(0.0), {0.0, 1.0, 0.0}, 40.0});
  for (const int64_t leaf : {1, 8}) {
    const Rendered found = render(scene, "reflections/ray_hierarchy",
                                  {{"traversal.leaf_side", leaf},
                                   {"traversal.start_nodes", int64_t{1}},
                                   {"traversal.capacity", int64_t{1}},
                                   {"shading.ambient", 1.0},
                                   {"shading.diffuse", 0.0}},
                                  {320, 240}, true);
    EXPECT_EQ(found.counter("mirror_rays"), 320 * 240);
    EXPECT_GT(found.counter("groups_without_room"), 0);
    size_t lost = 0;
    for (size_t i = 0; i < found.product.pixels(); ++i)
      lost += !(std::abs(found.product.data[4 * i] - 0.8F * 0.5F) < 1e-5F);
    EXPECT_EQ(lost, 0U) << leaf;
  }
}

}  // namespace
}  // namespace limen::techniques
