// SPDX-License-Identifier: BSD-3-Clause
// Rays looked up in fields against what geometry allows.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <vector>

#include "renderer/scene/shapes.h"
#include "renderer/visibility_fields/cpu_field.h"
#include "renderer/visibility_fields/field_batch.h"
#include "tests/renderer/visibility_fields/field_fixture.h"

namespace limen::visibility_fields {
namespace {

/// A square of side 2 in the plane y = 0: its sphere has the radius sqrt(2).
scene::Mesh square() { return scene::card({0, 0, 0}, {0, 0, 1}, {1, 0, 0}); }
constexpr double kReach = 1.41421356;

/// A ray that meets the plane y = 0 in `at` under an angle of incidence with the given cosine, from outside
/// of the sphere.
ray_tracing::BatchRay rayTo(glm::dvec3 at, glm::dvec3 direction, double from) {
  return {glm::vec3(at - from * direction), 0.0F, glm::vec3(direction), 1e30F};
}

glm::dvec3 downwards(std::mt19937_64& engine, double leastCosine) {
  std::uniform_real_distribution<> cosine(leastCosine, 1.0), turn(0.0, 2.0 * M_PI);
  const double y = cosine(engine), phi = turn(engine), r = std::sqrt(1.0 - y * y);
  return {r * std::cos(phi), -y, r * std::sin(phi)};
}

/// What bounds a looked-up ray: how far the nearest position can be from where a ray enters a unit sphere,
/// and the angle between a direction of given local z and its texel's middle.
struct Footprint {
  double position, texel;
  /// The lattice with 32 segments: no point is farther than 2.2 degrees from a position (its cells are
  /// squares and triangles with sides below 90 / 32 / cos 45 degrees). Concentric map: half a texel along
  /// both axes is 1 / side in disc coordinates, which the map stretches by no more than 4 / pi, and the
  /// projection from the disc by 1 / z.
  static Footprint of(int side, double leastZ) {
    return {glm::radians(0.5 * 90.0 / 32.0 / std::cos(M_PI / 4) * std::sqrt(2.0)),
            4.0 / M_PI * std::sqrt(2.0) / side / leastZ};
  }
};

// The ray that stands for another starts up to `position` radii from where that enters the sphere, and
// deviates by up to `texel`: its distance to the plane is that from a height within position radii, along an
// angle of incidence within `texel`.
TEST_F(Field, LookUpFromOutsideIsWithinTheFootprint) {
  constexpr int kSide = 64;
  const RigidObject object = objectOf(square());
  ASSERT_NEAR(object.sphere.radius, kReach, 1e-4);
  const VisibilityFields field =
      make({object}, {PositionForm::Lattice, 4226, DirectionForm::Concentric, kSide, 16});
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<> along(-0.7, 0.7), far(2.0, 50.0);
  std::vector<ray_tracing::BatchRay> rays;
  std::vector<double> exact, height, cosine;
  std::vector<Footprint> footprints;
  for (int i = 0; i < 50000; ++i) {
    const glm::dvec3 at(along(engine), 0.0, along(engine)), d = downwards(engine, 0.3);
    const double from = far(engine) + 2.0 * kReach;
    rays.push_back(rayTo(at, d, from));
    // From the sphere to the plane.
    const double b = glm::dot(at, d), inSphere = b + std::sqrt(b * b - glm::dot(at, at) + kReach * kReach);
    const glm::dvec3 entry = at - inSphere * d;
    exact.push_back(from), height.push_back(-inSphere * d.y), cosine.push_back(-d.y);
    footprints.push_back(Footprint::of(kSide, std::max(0.05, -glm::dot(entry, d) / kReach - 0.06)));
  }
  const std::vector<float> found = lookUp(context(), field, 0, rays, 0.0);
  int tested = 0, wrong = 0;
  double mean = 0.0;
  for (size_t i = 0; i < rays.size(); ++i) {
    const Footprint f = footprints[i];
    const double angle = std::acos(cosine[i]), up = kReach * f.position;
    if (angle + f.texel > 1.4) continue;
    const double before = exact[i] - height[i] / cosine[i];  // to the sphere
    const double least = std::max(height[i] - up, 0.0) / std::cos(std::max(angle - f.texel, 0.0));
    const double most = (height[i] + up) / std::cos(angle + f.texel);
    // The substitute must hit the square as well.
    if (0.7 + up + std::abs(most * std::sin(angle + f.texel) - height[i] * std::tan(angle)) > 1.0) continue;
    ++tested;
    const double slack = 2.0 * kReach * (0.5 / 65534.0) + 1e-5 * exact[i];
    wrong += !(found[i] >= before + least - slack && found[i] <= before + most + slack);
    mean += std::abs(found[i] - exact[i]);
  }
  EXPECT_GT(tested, 5000);
  EXPECT_EQ(wrong, 0);
  // Positions are on average less than half of their bound away.
  EXPECT_LT(mean / tested, kReach * footprints[0].position);
}

// From inside the sphere: a square ahead blocks, one behind does not, and the distance is that of the plane
// within the footprint.
TEST_F(Field, LookUpFromInsideTellsAheadFromBehind) {
  constexpr int kSide = 64;
  constexpr double kSlack = 0.05;
  const VisibilityFields field =
      make({objectOf(square())}, {PositionForm::Lattice, 4226, DirectionForm::Concentric, kSide, 16});
  std::mt19937_64 engine(6);
  std::uniform_real_distribution<> along(-0.4, 0.4), above(0.3, 0.6);
  std::vector<ray_tracing::BatchRay> rays;
  std::vector<bool> ahead;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 d = downwards(engine, 0.8);
    const glm::dvec3 from(along(engine), above(engine), along(engine));
    ahead.push_back(i % 2 == 0);
    rays.push_back({glm::vec3(from), 0.0F, glm::vec3(i % 2 == 0 ? d : -d), 1e30F});
  }
  const std::vector<float> found = lookUp(context(), field, 0, rays, kSlack);
  int wrong = 0;
  double worst = 0.0;
  for (size_t i = 0; i < rays.size(); ++i) {
    wrong += (found[i] >= 0.0F) != ahead[i];
    if (ahead[i] && found[i] >= 0.0F)
      worst = std::max(worst, std::abs(double(found[i]) + double(rays[i].origin.y) / rays[i].direction.y));
  }
  EXPECT_EQ(wrong, 0);
  // The substitute leaves from within position radii of where the ray does, at most 1.2 radii from the square
  // and 37 degrees off its normal, so that a texel of angle a moves its distance by tan(37 deg + a) a of it.
  const Footprint f = Footprint::of(kSide, 0.55);
  EXPECT_LT(worst, kReach * (f.position / 0.75 + 1.2 * 0.9 * f.texel));
}

// Two plates of one object, both ahead of an origin within its sphere and nothing behind it: the way back
// meets the farther one, aimed rays find the nearer one as well, on the GPU and on the CPU. Distances are off
// by no more than half a code, as the plates are across the rays.
TEST_F(Field, AimedLookUpsFromWithinTellTheNearest) {
  scene::Mesh plates = scene::card({0.2, 0.0, 0.0}, {0.0, 0.6, 0.0}, {0.0, 0.0, 0.6});
  scene::append(plates, scene::card({0.8, 0.0, 0.0}, {0.0, 0.6, 0.0}, {0.0, 0.0, 0.6}));
  const RigidObject object = objectOf(plates);
  const FieldForm form{PositionForm::Lattice, 4226, DirectionForm::Concentric, 64, 16};
  const VisibilityFields fields = make({object}, form);
  const CpuField cpu(object, form);
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<> within(-0.3, 0.3);
  std::vector<ray_tracing::BatchRay> rays;
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 from(0.0, within(engine), within(engine));
    ASSERT_LT(glm::distance(from, object.sphere.centre), object.sphere.radius);
    const glm::dvec3 at(0.8, within(engine), within(engine));
    rays.push_back({glm::vec3(from), 0.0F, glm::vec3(glm::normalize(at - from)), 1.0F});
  }
  const std::vector<float> nearest = lookUp(context(), fields, 0, rays, 0.0),
                           aimed = lookUp(context(), fields, 0, rays, 0.0, true);
  for (size_t i = 0; i < rays.size(); ++i) {
    // Within the angle of a footprint, 0.08, of up to 45 degrees' slope.
    const double slope = 1.0 / rays[i].direction.x;
    EXPECT_NEAR(nearest[i], 0.8 * slope, 0.12);
    EXPECT_NEAR(aimed[i], 0.2 * slope, 0.12);
    EXPECT_NEAR(
        cpu.distance(glm::dvec3(rays[i].origin), glm::normalize(glm::dvec3(rays[i].direction)), 0.0, true),
        0.2 * slope, 0.12);
  }
}

TEST_F(Field, MissesWhatTheSphereDoesNotHold) {
  const VisibilityFields field = make({objectOf(square())}, FieldForm{});
  const std::vector<ray_tracing::BatchRay> rays = {
      {{0.0F, 5.0F, 0.0F}, 0.0F, {0.0F, 1.0F, 0.0F}, 1.0F},     // away
      {{2.0F, 5.0F, 0.0F}, 0.0F, {0.0F, -1.0F, 0.0F}, 1.0F},    // past
      {{0.0F, 5.0F, 0.0F}, 0.0F, {0.0F, -1.0F, 0.0F}, 1.0F},    // through
      {{0.0F, 1.35F, 0.35F}, 0.0F, {1.0F, 0.0F, 0.0F}, 1.0F}};  // above the square, within the sphere
  const std::vector<float> found = lookUp(context(), field, 0, rays, 0.01);
  EXPECT_EQ(found[0], kNoDistance);
  EXPECT_EQ(found[1], kNoDistance);
  EXPECT_NEAR(found[2], 5.0F, 0.2F);
  EXPECT_EQ(found[3], kNoDistance);
}

// Where an object stands and its size do not matter: coordinates 1e5 diagonals away are known to 1e5 2^-53 of
// one, so that rays differ as much as by rounding, and scale is a power of two.
TEST_F(Field, DoesNotDependOnPlaceOrSize) {
  scene::Mesh mesh = coneAndBox(), moved = mesh;
  for (glm::dvec3& p : moved.positions) p = 1024.0 * p + glm::dvec3(1e5 * 2048.0);
  const FieldForm form{PositionForm::Lattice, 290, DirectionForm::Concentric, 16, 8};
  const std::vector<float> here = make({objectOf(mesh)}, form).readShares(0),
                           there = make({objectOf(moved)}, form).readShares(0);
  size_t apart = 0;
  for (size_t i = 0; i < here.size(); ++i) apart += here[i] != there[i];
  // As above, and where a distance is within 1e-7 of the middle between two codes.
  EXPECT_LE(double(apart) / double(here.size()), 1e-4);
}

// Moved rigidly and scaled, an object's field gives the distances of the rays that moved with it, scaled.
TEST_F(Field, MovesWithItsObject) {
  const RigidObject object = objectOf(coneAndBox());
  VisibilityFields field = make({object}, {PositionForm::Lattice, 1090, DirectionForm::Concentric, 32, 16});
  std::mt19937_64 engine(8);
  std::normal_distribution<> normal;
  std::vector<ray_tracing::BatchRay> rays, moved;
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 1.1, glm::normalize(glm::dvec3(1.0, 2.0, -0.5))));
  const glm::dvec3 to(300.0, -20.0, 1.0);
  constexpr double kScale = 8.0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 from =
        object.sphere.centre +
        (i % 2 == 0 ? 4.0 : 0.2) * glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine)));
    const glm::dvec3 at =
        object.sphere.centre + 0.3 * glm::dvec3(normal(engine), normal(engine), normal(engine));
    const glm::dvec3 d = glm::normalize(at - from);
    rays.push_back({glm::vec3(from), 0.0F, glm::vec3(d), 1.0F});
    moved.push_back(
        {glm::vec3(to + kScale * (turn * (from - object.sphere.centre))), 0.0F, glm::vec3(turn * d), 1.0F});
  }
  const std::vector<float> before = lookUp(context(), field, 0, rays, 0.01);
  field.place({{turn, to + glm::dvec3(1e7), kScale * object.sphere.radius}}, glm::dvec3(1e7));
  const std::vector<float> after = lookUp(context(), field, 0, moved, 0.01);
  int apart = 0, hits = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    hits += before[i] >= 0.0F;
    apart += before[i] < 0.0F ? after[i] >= 0.0F
                              : after[i] < 0.0F || std::abs(after[i] - kScale * before[i]) > 1e-3 * kScale;
  }
  EXPECT_GT(hits, 5000);
  // Rounding, 300 2^-24 / 8 of the object's size in the origin, moves a ray into the next texel or cell if it
  // lies within 1e-5 of its border: a share of 32 1e-5 for texels along each axis, and as much for cells.
  EXPECT_LT(double(apart) / double(rays.size()), 2e-3);
}

}  // namespace
}  // namespace limen::visibility_fields
