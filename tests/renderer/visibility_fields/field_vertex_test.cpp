// SPDX-License-Identifier: BSD-3-Clause
// Occlusion of vertices on the CPU, covers of spheres, other tracers and interleaved rays.
#include <cmath>
#include <random>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/visibility_fields/cpu_field.h"
#include "renderer/visibility_fields/field_batch.h"
#include "renderer/visibility_fields/sphere_cover.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

namespace vf = visibility_fields;

constexpr glm::ivec2 kVertexSizePx{40, 30};
constexpr double kVertexBall = 0.3;
constexpr glm::dvec3 kVertexBalls[] = {{-0.6, 1.0, 0.1}, {0.6, 1.2, -0.1}};

class FieldVertexTest : public TechniqueTest {
 protected:
  /// Two balls as one object above a floor of 33 x 33 vertices, seen from below the balls.
  static scene::Scene ballsOverAGrid(int cells = 24) {
    scene::Scene scene;
    scene::addPart(scene, "floor", scene::planeGrid(glm::dvec3(0.0), 1.0, 1.0, 32), glm::vec3(0.5F),
                   scene::Role::ReceiverOnly);
    scene::Mesh balls = scene::sphere(kVertexBalls[0], kVertexBall, cells);
    scene::append(balls, scene::sphere(kVertexBalls[1], kVertexBall, cells));
    scene::addPart(scene, "balls", balls, glm::vec3(0.5F));
    scene::setStillCamera(scene, {{0.0, 0.4, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 60.0});
    return scene;
  }
  static double openAt(int x, int y) {
    const double half = 0.4 * std::tan(glm::radians(30.0));
    const glm::dvec3 point(
        (2.0 * (x + 0.5) / kVertexSizePx.x - 1.0) * half * kVertexSizePx.x / kVertexSizePx.y, 0.0,
        (2.0 * (y + 0.5) / kVertexSizePx.y - 1.0) * half);
    double open = 1.0;
    // Nusselt's analogue.
    for (const glm::dvec3 ball : kVertexBalls) {
      const glm::dvec3 d = ball - point;
      open -= kVertexBall * kVertexBall / glm::dot(d, d) * glm::normalize(d).y;
    }
    return open;
  }
};

// As FieldOcclusionTest.BallsHideWhatTheirSolidAnglesSay, whose bounds are those of single receivers: 0.017
// for 1024 rays and 0.53 of what is hidden for a field of one object. Between vertices 1 / 32 apart values
// are interpolated: (1 / 32)^2 / 8 times the second derivative, below 2 at a distance of 0.7 from balls of
// 0.3: 3e-4.
TEST_F(FieldVertexTest, BallsHideWhatTheirSolidAnglesSay) {
  const scene::Scene scene = ballsOverAGrid();
  for (const bool traced : {true, false}) {
    Given given = {{"rays", int64_t{1024}}, {"radius", 10.0}};
    if (!traced)
      given.insert(
          {{"positions", int64_t{4226}}, {"directions", int64_t{64}}, {"objects", std::string("parts")}});
    const Image image =
        render(scene,
               traced ? "visibility_fields/traced_vertex_occlusion" : "visibility_fields/vertex_occlusion",
               given, kVertexSizePx)
            .product;
    double sum = 0.0;
    for (int y = 0; y < kVertexSizePx.y; ++y)
      for (int x = 0; x < kVertexSizePx.x; ++x) {
        const double open = openAt(x, y);
        ASSERT_NEAR(image.at(x, y), open, 0.018 + (traced ? 0.0 : 0.53 * (1.0 - open))) << x << ' ' << y;
        sum += image.at(x, y) - open;
      }
    EXPECT_LT(std::abs(sum / (kVertexSizePx.x * kVertexSizePx.y)), traced ? 0.003 : 0.01);
  }
}

// The same rays in the same field, in double precision on the CPU and in floats on the GPU: equal but where
// rounding, 1e-6 of a radius, takes a ray over the border of a texel or of a position's cell: a share of 64
// texels across 1e-5, and as much for cells.
TEST_F(FieldVertexTest, FieldsOnTheCpuGiveTheDistancesOfTheGpu) {
  scene::Mesh mesh = scene::frustum({0.0, 0.0, 0.0}, {0.1, 1.4, 0.0}, 0.5, 0.0, 48);
  scene::append(mesh, scene::box({0.4, 0.0, -0.3}, {0.9, 0.7, 0.4}));
  const vf::RigidObject object = vf::makeRigidObject("object", mesh.positions, mesh.triangles);
  for (const int bits : {8, 16, 32}) {
    const vf::FieldForm form{vf::PositionForm::Lattice, 1090, vf::DirectionForm::Concentric, 32, bits};
    const vf::VisibilityFields gpu(context(), {object}, form);
    const vf::CpuField cpu(object, form);
    std::mt19937_64 engine(9);
    std::normal_distribution<> normal;
    std::vector<ray_tracing::BatchRay> rays;
    for (int i = 0; i < 20000; ++i) {
      const auto random = [&] { return glm::dvec3(normal(engine), normal(engine), normal(engine)); };
      const glm::dvec3 from = object.sphere.centre + (i % 2 == 0 ? 4.0 : 0.2) * glm::normalize(random());
      rays.push_back({glm::vec3(from), 0.0F,
                      glm::vec3(glm::normalize(object.sphere.centre + 0.3 * random() - from)), 1.0F});
    }
    const std::vector<float> found = vf::lookUp(context(), gpu, 0, rays, 0.05);
    size_t apart = 0, hits = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      const double own = cpu.distance(glm::dvec3(rays[i].origin), glm::dvec3(rays[i].direction), 0.05);
      hits += own >= 0.0;
      apart += own < 0.0 ? found[i] >= 0.0F : !(std::abs(found[i] - own) <= 1e-4);
    }
    EXPECT_GT(hits, 5000U);
    EXPECT_LT(double(apart) / double(rays.size()), 2e-3) << bits;
  }
}

// Look-ups do not know of triangles: balls of 64 times as many, whose vertices on the axes and so whose
// spheres are the same.
TEST_F(FieldVertexTest, LookUpsAreAsManyForAnyNumberOfTriangles) {
  const Given given = {{"rays", int64_t{16}}, {"positions", int64_t{290}}};
  const double coarse =
      render(ballsOverAGrid(4), "visibility_fields/ambient_occlusion", given, kVertexSizePx, true)
          .counter("field_lookups_per_px");
  const double fine =
      render(ballsOverAGrid(32), "visibility_fields/ambient_occlusion", given, kVertexSizePx, true)
          .counter("field_lookups_per_px");
  ASSERT_GT(coarse, 1.0);
  EXPECT_NEAR(fine / coarse, 1.0, 0.01);
}

double areaOf(const vf::RigidObject& object) {
  double sum = 0.0;
  for (const glm::uvec3 t : object.triangles) {
    const glm::dvec3 a(object.vertices[t.x]), b(object.vertices[t.y]), c(object.vertices[t.z]);
    sum += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return sum * object.sphere.radius * object.sphere.radius;
}

// Cuts neither lose surface nor add any, to the rounding of single-precision vertices, and spheres take less
// space together.
TEST(SphereCovers, CutLongObjectsAndLeaveRoundOnesAlone) {
  const scene::Mesh cane = scene::frustum({0.0, 0.0, 0.0}, {0.2, 3.0, 0.5}, 0.03, 0.02, 16);
  vf::RigidObject object = vf::makeRigidObject("cane", cane.positions, cane.triangles);
  object.owner = 3;
  for (const int spheres : {2, 5, 16}) {
    const std::vector<vf::RigidObject> pieces = vf::coverWithSpheres(object, spheres);
    ASSERT_EQ(pieces.size(), static_cast<size_t>(spheres));
    double area = 0.0, volume = 0.0;
    for (const vf::RigidObject& piece : pieces) {
      EXPECT_EQ(piece.owner, 3U);
      area += areaOf(piece), volume += std::pow(piece.sphere.radius, 3.0);
      for (const glm::vec3 v : piece.vertices) EXPECT_LE(glm::length(v), 1.0F);
    }
    EXPECT_NEAR(area / areaOf(object), 1.0, 1e-4);
    // n balls over a line, of its length / n each: 1 / n^2 of the volume; twice as much where pieces differ
    // by 2.
    EXPECT_LT(volume, 4.0 / (spheres * spheres) * std::pow(object.sphere.radius, 3.0));
  }
  const scene::Mesh ball = scene::sphere({0.0, 1.0, 0.0}, 0.5, 8);
  EXPECT_EQ(vf::coverWithSpheres(vf::makeRigidObject("ball", ball.positions, ball.triangles), 16).size(), 1U);
}

// The same rays through a grid and through a tree find the same, but where they pass an edge of a silhouette
// within rounding: one ray in 1e4, and of every density the same.
TEST_F(FieldVertexTest, AGridOfTrianglesGivesTheTreesPicture) {
  for (const char* name : {"two_boxes", "foliage", "degenerate_soup"}) {
    const scene::Scene scene = makeScene(name);
    Given given = {{"rays", int64_t{16}}};
    const Image tree = render(scene, "visibility_fields/traced_occlusion", given, kVertexSizePx).product;
    given["tracer"] = std::string("grid");
    for (const double density : {0.05, 4.0, 32.0}) {
      given["tracer.density"] = density;
      const Image grid = render(scene, "visibility_fields/traced_occlusion", given, kVertexSizePx).product;
      EXPECT_LT(meanDifference(grid, tree), 1e-4) << name << ' ' << density;
    }
  }
}

// Sixteen pixels of 4 x 4 tiles with 16 rays each have the 256 rays of 16 x 16 cells between them. On the
// floor, away from the picture's border, what is hidden changes by less than 3e-3 over half a window, and the
// rays' own errors, with outlines that cut some 30 of 256 cells 0.5 * sqrt(30) / 256 = 0.011 as a deviation
// at most, rather half of it as cells are cut in all ratios, are not the same in both, as receivers differ: 3
// deviations of the difference are 3 * sqrt(2) * 0.0055 = 0.023.
TEST_F(FieldVertexTest, InterleavedAndFilteredPixelsHaveTheRaysOfTheirTile) {
  const scene::Scene scene = ballsOverAGrid();
  Given few = {{"rays", int64_t{16}}, {"radius", 10.0}}, many = {{"rays", int64_t{256}}, {"radius", 10.0}};
  const Image plain = render(scene, "visibility_fields/ambient_occlusion", few, kVertexSizePx).product;
  few["pattern"] = std::string("interleaved");
  few["pattern.filter"] = std::string("bilateral");
  const Image filtered = render(scene, "visibility_fields/ambient_occlusion", few, kVertexSizePx).product;
  const Image whole = render(scene, "visibility_fields/ambient_occlusion", many, kVertexSizePx).product;
  double before = 0.0, after = 0.0;
  for (int y = 2; y < kVertexSizePx.y - 2; ++y)
    for (int x = 2; x < kVertexSizePx.x - 2; ++x) {
      before += std::abs(plain.at(x, y) - whole.at(x, y));
      after += std::abs(filtered.at(x, y) - whole.at(x, y));
      ASSERT_NEAR(filtered.at(x, y), whole.at(x, y), 0.026) << x << ' ' << y;
    }
  EXPECT_LT(after, 0.25 * before);
}

// Pixels on either side of an edge have nothing in common: a box before the floor keeps its own values.
TEST_F(FieldVertexTest, TheFilterKeepsEdges) {
  const scene::Scene scene = makeScene("two_boxes");
  Given given = {{"rays", int64_t{16}}, {"pattern", std::string("interleaved")}, {"radius", 0.05}};
  given["pattern.filter"] = std::string("bilateral");
  const Image sharp = render(scene, "visibility_fields/traced_occlusion", given, {80, 60}).product;
  given["pattern.filter.angle_deg"] = 90.0;
  const Image loose = render(scene, "visibility_fields/traced_occlusion", given, {80, 60}).product;
  const Image truth = render(scene, "visibility_fields/traced_occlusion",
                             {{"rays", int64_t{256}}, {"radius", 0.05}}, {80, 60})
                          .product;
  EXPECT_LT(meanDifference(sharp, truth), meanDifference(loose, truth));
}

}  // namespace
}  // namespace limen::techniques
