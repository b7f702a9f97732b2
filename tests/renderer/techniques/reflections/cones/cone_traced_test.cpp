// SPDX-License-Identifier: BSD-3-Clause
#include <epoxy/gl.h>

#include <numbers>

#include "renderer/frame/mirror_rays.h"
#include "renderer/techniques/reflections/cones/cone_geometry.h"
#include "renderer/techniques/reflections/cones/disk_overlap.h"
#include "renderer/techniques/reflections/cones/pixel_solid_angles.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

constexpr double kPi = std::numbers::pi;

class ConeTraced : public ReflectionTest {
 protected:
  /// Surfaces of one colour each, and black mirrors before a black background.
  static Given flat(Given given = {}) {
    given.insert({{"shading.ambient", 1.0}, {"shading.diffuse", 0.0}, {"shading.background", 0.0}});
    return given;
  }
  static scene::Material glossy(float gloss) {
    scene::Material material = mirrorMaterial(1.0F);
    material.albedo = glm::vec3(0.0F);
    material.glossRad = gloss;
    return material;
  }
};

/// A glossy mirror below a white ball of the angle `ball` around the middle of its lobe.
scene::Scene ballAbove(const scene::Material& mirror, double ball) {
  scene::Scene scene;
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 0.2, 0.2, 2), mirror);
  const glm::dvec3 middle = 4.0 * glm::normalize(glm::dvec3(0.0, 1.0, -1.0));
  scene::addPart(scene, "ball", scene::sphere(middle, 4.0 * std::sin(ball), 5), glm::vec3(1.0F));
  scene::setStillCamera(scene, {glm::dvec3(0.0, 1.0, 1.0), glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.5});
  return scene;
}

/// A ball that is seen at an angle b fills (tan b / tan a)^2 of a cone of half-angle a. The
/// pixel's own angle of 0.0025 widens a by less than 0.9 % of itself, and moves the eye's cone to a footprint
/// of 0.004 of 4 units: 3 % of the share together; a border of 20 edges takes 2 % of a disk, and corners that
/// lie on the ball but not on its border as much again. Blended until the cone is full, the far side counts
/// as well: twice the share.
TEST_F(ConeTraced, ABallInAConeHasTwiceTheShareOfItsDisk) {
  const double gloss = 0.3, ball = 0.15;
  const scene::Scene scene = ballAbove(glossy(0.3F), ball);
  const double share = std::pow(std::tan(ball) / std::tan(gloss), 2.0);
  const float found =
      render(scene, "reflections/cone_traced", flat({{"layers", int64_t{256}}}), {1, 1}).product.data[0];
  EXPECT_NEAR(found, 2.0 * share, 0.16 * share);
}

/// More triangles in a cone than a software renderer's 65,535 loop rounds have time for, of which
/// an overlap takes some twenty: a card of side 1 across the cone's axis, 4 units away, in 8,192 triangles.
/// The cone meets all of them; those that are kept and those that are left out fill 1 / (pi (4 tan 0.3)^2) of
/// it. A pixel of 0.0087 rad, a cone of 0.005, seen from sqrt(2) away, widens the cone's radius there, 1.237,
/// by at most 4 x 0.005 (1 + tan^2 0.3) and by its footprint's half-diagonal on the tilted mirror,
/// 0.0123: 2.8 %, so 5.5 % of the share; sums of 8,192 floats err by less than 8,192 x 2^-24.
TEST_F(ConeTraced, MeetsMoreTrianglesThanAnInvocationHasRounds) {
  scene::Scene scene;
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 0.2, 0.2, 2), glossy(0.3F));
  scene::Mesh card = scene::planeGrid(glm::dvec3(0.0), 1.0, 1.0, 64);
  // The axis is (0, 1, -1) / sqrt(2); the plane's z is turned to (0, 1, 1) / sqrt(2).
  for (glm::dvec3& position : card.positions)
    position =
        glm::dvec3(position.x, (4.0 + position.z) / std::sqrt(2.0), (-4.0 + position.z) / std::sqrt(2.0));
  const auto triangles = static_cast<double>(card.triangles.size());
  scene::addPart(scene, "card", card, glm::vec3(0.5F));
  scene::setStillCamera(scene, {glm::dvec3(0.0, 1.0, 1.0), glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.5});
  const double share = 1.0 / (kPi * std::pow(4.0 * std::tan(0.3), 2.0));
  ASSERT_EQ(triangles, 8192.0);
  for (const int64_t room : {1, 1 << 20}) {
    const Rendered rendered = render(
        scene, "reflections/cone_traced",
        flat({{"layers", int64_t{256}}, {"fill", std::string("rescaled")}, {"traversal.capacity", room}}),
        {1, 1}, true);
    EXPECT_EQ(rendered.counter("triangles_per_cone"), triangles) << room;
    EXPECT_EQ(rendered.counter("kept_per_cone"), 256.0);
    const double found = rendered.counter("dropped_share") + 1.0 - rendered.counter("uncovered_share");
    EXPECT_LE(found, share * 1.0005);
    EXPECT_GE(found, share * 0.945);
    EXPECT_NEAR(rendered.product.data[0], 0.5, 1e-5);
  }
}

/// A card over half of a cone, and another one behind it: half the cone, by a mask of its area; all of
/// it if cones are blended until they are full. Both cards have the same places of the mask.
TEST_F(ConeTraced, AMaskKnowsWhatIsHidden) {
  scene::Scene scene;
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 0.2, 0.2, 2), glossy(0.3F));
  for (const double height : {3.0, 4.0})
    scene::addPart(scene, "card", scene::planeGrid(glm::dvec3(20.0, height, 0.0), 40.0, 40.0, 1),
                   glm::vec3(1.0F));
  scene::setStillCamera(scene, {glm::dvec3(0.0, 1.0, 0.5), glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.5});
  const auto found = [&](const char* coverage) {
    return render(scene, "reflections/cone_traced", flat({{"coverage", std::string(coverage)}}), {1, 1})
        .product.data[0];
  };
  EXPECT_NEAR(found("saturated"), 1.0, 2e-3);
  EXPECT_NEAR(found("masked"), 0.5, 2e-3);
}

/// Triangles side by side: a white wall in 128 triangles fills every cone, and nothing but its
/// triangles' sum does. Floats of 130 terms of mean 1/130 err by less than 1e-4 in sum, disk_overlap.glsl's
/// own error of 1e-5 each by no more than 1e-3.
TEST_F(ConeTraced, TrianglesSideBySideAddUpToTheirUnion) {
  scene::Scene scene;
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 2.0, 2.0, 2), glossy(0.05F));
  scene::Mesh wall = scene::planeGrid(glm::dvec3(0.0), 40.0, 40.0, 64);
  for (glm::dvec3& position : wall.positions)
    position = glm::dvec3(position.x, 3.0 + 0.25 * position.x, position.z);
  scene::addPart(scene, "wall", wall, glm::vec3(0.5F));
  scene::setStillCamera(scene, {glm::dvec3(0.0, 1.5, 0.5), glm::dvec3(0.0), {0.0, 1.0, 0.0}, 20.0});
  const Rendered rendered =
      render(scene, "reflections/cone_traced", flat({{"layers", int64_t{128}}}), {24, 24}, true);
  EXPECT_EQ(rendered.counter("cones"), 24.0 * 24.0);
  EXPECT_GT(rendered.counter("triangles_per_cone"), 1.5);
  EXPECT_LT(rendered.counter("coverage_error"), 1e-3);
  EXPECT_LT(rendered.counter("dropped_share"), 1e-6);
  for (size_t i = 0; i < rendered.product.pixels(); ++i) ASSERT_NEAR(rendered.product.data[4 * i], 0.5, 1e-3);
}

struct Item {
  double along, share;
  uint32_t triangle;
};

/// What a triangle fills of a cone, in double precision and by cases: the part above the mirror's plane
/// through the cone's start, as a fan.
DiskOverlap overlapByCases(const Cone& cone, glm::dvec3 start, glm::dvec3 above,
                           const std::array<glm::dvec3, 3>& triangle, double tolerance) {
  std::vector<glm::dvec3> part;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 p = triangle[i], q = triangle[(i + 1) % 3];
    const double here = glm::dot(p - start, above) - tolerance,
                 there = glm::dot(q - start, above) - tolerance;
    if (here > 0.0) part.push_back(p);
    if ((here > 0.0) != (there > 0.0)) part.push_back(glm::mix(p, q, here / (here - there)));
  }
  DiskOverlap sum;
  for (size_t i = 1; i + 1 < part.size(); ++i) {
    const std::vector<glm::dvec2> seen = projectedToDisk(cone, {part[0], part[i], part[i + 1]});
    for (size_t k = 1; k + 1 < seen.size(); ++k) {
      const DiskOverlap one = diskOverlapByCases({seen[0], seen[k], seen[k + 1]});
      sum.area += one.area;
      sum.centroid += one.area * one.centroid;
    }
  }
  if (sum.area > 0.0) sum.centroid /= sum.area;
  return sum;
}

/// every cone against every triangle on the CPU, in double precision, with areas by
/// the eight cases, which share no formula with the shader's; and the nearest first. The shader's rays are
/// float, so that an edge moves by 1e-5 of a cone's radius or so; an area by as much. Two triangles at nearly
/// the same distance may change places: few pixels.
TEST_F(ConeTraced, EveryConeAgreesWithAllTrianglesInDoublePrecision) {
  struct Case {
    double gloss;
    bool edgeRays;
  };
  for (const auto& [gloss, edgeRays] : {Case{0.0, false}, {0.0, true}, {0.03, true}, {0.2, false}}) {
    scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{8}}});
    for (scene::Material& material : scene.materials) {
      if (material.reflects()) material.glossRad = static_cast<float>(gloss);
      material.pattern.kind = scene::Pattern::Kind::None;
    }
    const glm::ivec2 size(48, 36);
    const Given given =
        flat({{"layers", int64_t{256}}, {"reflection", std::string(edgeRays ? "edge_rays" : "paraxial")}});
    const Image found = render(scene, "reflections/cone_traced", given, size).product;

    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, size);
    frame.begin();
    const frame::MirrorRays& rays = frame.get<frame::MirrorRays>();
    const Image origins = rays.origins().read(), directions = rays.directions().read();
    const std::vector<uint32_t> ids = frame.get<frame::TriangleIds>().texture().readUint();
    const glm::dvec3 eye = frame.camera().eye - gpuScene.anchor();
    const PixelSolidAngles angles(size, frame.tanHalfFov());
    frame.end();
    const frame::BruteForce truth(scene, gpuScene.anchor());
    const double tolerance = frame::rayOriginTolerance(gpuScene);
    std::vector<uint32_t> materialOf(scene.mesh.triangles.size());
    for (const scene::Part& part : scene.parts)
      std::fill_n(materialOf.begin() + part.firstTriangle, part.triangleCount, part.material);

    int cones = 0, wrong = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        if (origins.at(x, y, 3) == 0.0F) continue;
        const glm::dvec3 start(origins.at(x, y, 0), origins.at(x, y, 1), origins.at(x, y, 2));
        const glm::dvec3 axis = glm::normalize(
            glm::dvec3(directions.at(x, y, 0), directions.at(x, y, 1), directions.at(x, y, 2)));
        const uint32_t id =
            ids[static_cast<size_t>(y) * static_cast<size_t>(size.x) + static_cast<size_t>(x)];
        const glm::uvec3 corners = scene.mesh.triangles[id];
        const std::array<glm::dvec3, 3> own{truth.corner(id, 0), truth.corner(id, 1), truth.corner(id, 2)};
        const glm::dvec3 e1 = own[1] - own[0], e2 = own[2] - own[0];
        const glm::dmat2 gram(glm::dot(e1, e1), glm::dot(e1, e2), glm::dot(e1, e2), glm::dot(e2, e2));
        const glm::dvec2 uv =
            glm::inverse(gram) * glm::dvec2(glm::dot(start - own[0], e1), glm::dot(start - own[0], e2));
        const auto& normals = scene.mesh.normals;
        const double curvature = meanCurvature(
            own,
            {glm::dvec3(normals[corners.x]), glm::dvec3(normals[corners.y]), glm::dvec3(normals[corners.z])},
            uv.x, uv.y);
        const double apart = glm::length(eye - start), half = coneHalfAngle(angles.at({x, y}));
        const double cosine = std::max<double>(directions.at(x, y, 3), 1e-4);
        const ReflectedCone reflected = edgeRays ? reflectEdgeRays(apart, cosine, curvature, half)
                                                 : reflectParaxially(apart, cosine, curvature, half);
        if (reflected.kind == ReflectedCone::Kind::Grazing) continue;
        Cone cone;
        cone.axis = axis;
        cone.halfAngle = combinedHalfAngle(reflected.halfAngle, gloss);
        // Grazing views, whose cones are planes nearly.
        if (cone.halfAngle > 1.0) continue;
        cone.nearPlane = apart * std::tan(half) / std::tan(cone.halfAngle);
        cone.apex = start - cone.nearPlane * axis;
        glm::dvec3 above = glm::normalize(glm::cross(e1, e2));
        if (glm::dot(above, axis) < 0.0) above = -above;
        // Of the disk the part above the mirror.
        const double chord = glm::dot(above, axis) /
                             (std::tan(cone.halfAngle) * glm::length(above - glm::dot(above, axis) * axis));
        const double whole = chord < 1.0 ? kPi - circularSegment(2.0 * std::acos(chord)).area : kPi;
        const glm::dvec3 side = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 across = glm::normalize(glm::cross(axis, side)), up = glm::cross(axis, across);
        std::vector<Item> items;
        for (uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
          if (t == id) continue;
          const std::array<glm::dvec3, 3> of{truth.corner(t, 0), truth.corner(t, 1), truth.corner(t, 2)};
          const DiskOverlap overlap = overlapByCases(cone, start, above, of, tolerance);
          if (!(overlap.area > 0.0)) continue;
          const glm::dvec2 aside = std::tan(cone.halfAngle) * overlap.centroid;
          const glm::dvec3 way = axis + aside.x * across + aside.y * up;
          const glm::dvec3 normal = glm::cross(of[1] - of[0], of[2] - of[0]);
          items.push_back({glm::dot(normal, of[0] - cone.apex) / glm::dot(normal, way) - cone.nearPlane,
                           overlap.area / whole, t});
        }
        std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.along < b.along; });
        glm::dvec3 expected(0.0);
        double covered = 0.0;
        for (const Item& item : items) {
          const double weight = std::min(item.share, 1.0 - covered);
          covered += weight;
          expected += weight * glm::dvec3(scene.materials[materialOf[item.triangle]].albedo);
        }
        ++cones;
        const glm::dvec3 local(scene.materials[materialOf[id]].albedo),
            share(scene.materials[materialOf[id]].mirror);
        for (int c = 0; c < 3; ++c)
          if (!(std::abs(found.at(x, y, c) - local[c] - share[c] * expected[c]) < 2e-3)) {
            ++wrong;
            break;
          }
      }
    EXPECT_GT(cones, 200);
    // Of equally distant triangles those that touch along an edge within a cone: less than one cone in fifty.
    EXPECT_LE(wrong, cones / 50) << "gloss " << gloss << (edgeRays ? ", edge rays" : "");
  }
}

/// No pair is lost, whatever room there is, and however lists come about: nearest by distance, and of equal
/// ones the lower number, so that not one bit differs.
TEST_F(ConeTraced, NoSettingOfTheTraversalChangesABit) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{4}}, {"gloss", 0.03}});
  const auto picture = [&](Given given) {
    given["layers"] = int64_t{12};
    return render(scene, "reflections/cone_traced", given, {37, 29}).product.data;
  };
  const auto truth = picture({});
  for (const int64_t side : {1, 2, 8}) EXPECT_EQ(picture({{"traversal.leaf_side", side}}), truth) << side;
  for (const int64_t room : {1, 300, 3000}) EXPECT_EQ(picture({{"traversal.capacity", room}}), truth) << room;
  EXPECT_EQ(picture({{"traversal.capacity", int64_t{500}},
                     {"traversal.overflow", std::string("fixed_batches")},
                     {"traversal.overflow.triangles", int64_t{100}}}),
            truth);
  EXPECT_EQ(picture({{"traversal.capacity", int64_t{500}},
                     {"traversal.overflow", std::string("spilled_pairs")},
                     {"traversal.overflow.room", int64_t{200000}}}),
            truth);
  EXPECT_EQ(picture({{"traversal.merge", std::string("mean")}}), truth);
  EXPECT_EQ(picture({{"traversal.reduction", std::string("separate")}}), truth);
}

/// Peeled layers are the sorted ones, but for rounding of a sum of at most 12 terms and what lies
/// behind the last 1e-5 of a cone; triangles at the same distance in a pixel, of which peeling keeps one, in
/// less than one pixel in two hundred. Where layers cover more than a cone has left, as along the ball's
/// outline, 13 of 980 would differ without their saturation.
TEST_F(ConeTraced, PeeledLayersAreTheSortedOnes) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{4}}, {"gloss", 0.02}});
  struct Tried {
    int64_t layers;
    const char* fill;
  };
  // What is filled is what the layers leave.
  for (const Tried& tried : {Tried{1, "background"}, Tried{2, "background"}, Tried{2, "rescaled"},
                             Tried{2, "environment"}, Tried{12, "rescaled"}}) {
    const auto picture = [&](const char* backEnd) {
      return render(scene, "reflections/cone_traced",
                    {{"layers", tried.layers},
                     {"fill", std::string(tried.fill)},
                     {"back_end", std::string(backEnd)}},
                    {35, 28})
          .product;
    };
    EXPECT_LE(differing(picture("peeled"), picture("sorted"), 1e-4).count, 4U)
        << tried.layers << " " << tried.fill;
  }
}

/// Pairs without room are never left out in silence.
TEST_F(ConeTraced, PeelingWithoutRoomGivesNoPicture) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{4}}});
  const Rendered rendered =
      render(scene, "reflections/cone_traced",
             {{"back_end", std::string("peeled")}, {"back_end.room", int64_t{100}}}, {32, 24}, true);
  EXPECT_GT(rendered.counter("items_without_room"), 0.0);
  int lost = 0;
  for (const float value : rendered.product.data) lost += std::isnan(value);
  EXPECT_GT(lost, 0);
}

/// a mask cannot be peeled.
TEST_F(ConeTraced, RefusesMaskedPeeling) {
  const auto error = refusal("reflections/cone_traced",
                             {{"back_end", std::string("peeled")}, {"coverage", std::string("masked")}});
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where(), "coverage");
}

/// A larger world is the same picture: powers of two are exact in float, so that no bit may differ but
/// where a tolerance or an exponent's end is met: none is.
TEST_F(ConeTraced, ScaleChangesNoPixel) {
  const auto picture = [&](double scale) {
    return render(makeScene("mirrors/bunny", {{"detail", 0.01}, {"gloss", 0.02}, {"scale", scale}}),
                  "reflections/cone_traced", {}, {40, 30})
        .product;
  };
  const Image truth = picture(1.0);
  for (const double scale : {0x1p-13, 0x1p13}) EXPECT_EQ(differing(picture(scale), truth, 1e-3).count, 0U);
  // Other numbers round edges differently.
  for (const double scale : {1e-4, 1e4})
    EXPECT_LE(differing(picture(scale), truth, 1e-2).count, 12U) << scale;
}

/// Against distribution ray tracing, whose standard error at 256 places is at most 0.5 / 16 = 0.03 of a
/// pixel's range of 0.8 and much less on average. Cones are round and pixels square, and colours are those
/// of overlaps' middles: the thesis states no bound. Here: closer than a mirrored ray by a fourth at least.
TEST_F(ConeTraced, IsNearerToTheMeanOfManyRaysThanOneRayIs) {
  const scene::Scene scene = makeScene("mirrors/bunny", {{"detail", 0.02}, {"gloss", 0.03}});
  const glm::ivec2 size(48, 36);
  const Image truth = render(scene, "reflections/distribution_traced",
                             {{"places", int64_t{64}}, {"directions", int64_t{4}}}, size)
                          .product;
  const auto error = [&](const char* technique, const Given& given) {
    const Image found = render(scene, technique, given, size).product;
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, size);
    frame.begin();
    const Image rays = frame.get<frame::MirrorRays>().origins().read();
    frame.end();
    double sum = 0.0;
    for (size_t i = 0; i < found.pixels(); ++i)
      if (rays.data[4 * i + 3] > 0.0F)
        for (size_t c = 0; c < 3; ++c)
          sum += std::pow(double(found.data[4 * i + c]) - truth.data[4 * i + c], 2.0);
    return std::sqrt(sum);
  };
  const double one = error("reflections/ray_traced", {});
  EXPECT_LT(error("reflections/cone_traced", {{"layers", int64_t{60}}}), 0.75 * one);
  EXPECT_LT(error("reflections/cone_traced", {{"layers", int64_t{60}},
                                              {"coverage", std::string("masked")},
                                              {"contribution", std::string("table")}}),
            0.75 * one);
}

}  // namespace
}  // namespace limen::techniques
