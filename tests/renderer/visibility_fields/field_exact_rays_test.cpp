// SPDX-License-Identifier: BSD-3-Clause
// Look-ups on the GPU against searches over all positions and exact rays in double precision.
#include <stdlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <string>
#include <vector>

#include "renderer/scene/shapes.h"
#include "renderer/visibility_fields/field_batch.h"
#include "renderer/visibility_fields/field_store.h"
#include "renderer/visibility_fields/map_functions.h"
#include "tests/renderer/visibility_fields/field_fixture.h"
#include "tests/renderer/visibility_fields/nearest_search.h"

namespace limen::visibility_fields {
namespace {

glm::dvec3 localOf(glm::vec3 position, glm::dvec3 direction) {
  const glm::vec3 z = -position;
  return {glm::dot(glm::dvec3(fieldTangent(z)), direction),
          glm::dot(glm::dvec3(fieldBitangent(z)), direction), glm::dot(glm::dvec3(z), direction)};
}

class FieldInverses : public Field {
 protected:
  void SetUp() override {
    Field::SetUp();
    std::string pattern = (std::filesystem::temp_directory_path() / "limen_inverses_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    std::filesystem::remove_all(folder_);
    Field::TearDown();
  }
  /// What look-ups say of a field whose ray number i has the share code(i) / 2^15.
  template <class Code>
  std::vector<long> codesOf(const RigidObject& object, const FieldForm& form, size_t rayCount,
                            const std::vector<ray_tracing::BatchRay>& rays, const Code& code) const {
    const FieldStore store(folder_, context().device().line());
    StoredField field;
    for (size_t i = 0; i < rayCount; ++i)
      field.words.push_back(std::bit_cast<uint32_t>(static_cast<float>(code(i)) / 32768.0F));
    store.write(store.path(object, form), field);
    const VisibilityFields fields(context(), {object}, form, 0, folder_);
    EXPECT_EQ(fields.fieldsRead(), 1U);
    std::vector<long> out;
    for (const float found : lookUp(context(), fields, 0, rays, 0.0))
      out.push_back(std::lround((found / object.sphere.radius - kBefore) * 0.5 * 32768.0));
    return out;
  }
  static constexpr double kBefore = 0.5;  // of a ray's origin before the sphere, in radii
  std::string folder_;
};

// The shaders' own maps: in place of distances the field holds numbers of positions and of texels. The
// position is the nearest of all, but where two cosines differ by less than rounding
// (PositionMap.InverseIsTheNearestOfAllPoints; a place on the sphere is known to 1e-6); the texel is the one
// that holds the direction's place in that position's map, to a thousandth of itself.
TEST_F(FieldInverses, OfShadersAreTheNearestOfAll) {
  const RigidObject object = objectOf(coneAndBox());
  constexpr int kSide = 32;
  struct Case {
    PositionForm positions;
    int count;
    DirectionForm directions;
    int rays;
  };
  for (const Case& one : {Case{PositionForm::Lattice, 4226, DirectionForm::Concentric, 1000000},
                          Case{PositionForm::Lattice, 16642, DirectionForm::Concentric, 100000},
                          Case{PositionForm::Lattice, 82, DirectionForm::Polar, 100000},
                          Case{PositionForm::Grid, 1090, DirectionForm::Rejection, 100000},
                          Case{PositionForm::Box, 1090, DirectionForm::Concentric, 100000}}) {
    const FieldForm form{one.positions, one.count, one.directions, kSide, 32};
    const PositionMap map(one.positions, one.count);
    const Search search(map.points());
    std::mt19937_64 engine(21);
    std::vector<ray_tracing::BatchRay> rays;
    std::vector<glm::dvec3> points, ways;
    for (int i = 0; i < one.rays; ++i) {
      const glm::dvec3 p = randomPoint(engine, i);
      glm::dvec3 d = randomPoint(engine, 1);
      if (glm::dot(d, p) > 0.0) d = -d;
      // Grazing rays may not meet the sphere once rounded.
      if (glm::dot(d, p) > -0.01) d = glm::normalize(d - 0.05 * p);
      const glm::vec3 from(object.sphere.centre + object.sphere.radius * (p - kBefore * d));
      rays.push_back({from, 0.0F, glm::vec3(d), 1.0F});
      points.push_back(p), ways.push_back(d);
    }
    const size_t perMap = kSide * kSide, count = map.points().size() * perMap;
    const std::vector<long> maps = codesOf(object, form, count, rays, [&](size_t i) { return i / perMap; }),
                            texels = codesOf(object, form, count, rays, [&](size_t i) { return i % perMap; });
    int far = 0, beside = 0, looked = 0, below = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      ASSERT_TRUE(maps[i] >= 0 && maps[i] < long(map.points().size())) << i;
      const glm::vec3 position = map.points()[size_t(maps[i])];
      const double best = search.nearestDistance(points[i]),
                   found = glm::distance(glm::dvec3(position), points[i]);
      far += found * found > best * best + 12.0 * 0x1p-24 + 2e-6 * best;
      glm::vec3 local(localOf(position, ways[i]));
      // Of a ray that leaves the half space of the nearest position the nearest direction is on its border.
      if (local.z < 0.0F) local = {glm::normalize(glm::vec2(local)), 0.0F}, ++below;
      const glm::dvec2 place =
          double(kSide) * glm::dvec2(fieldPlace(local, static_cast<int>(one.directions)));
      const glm::ivec2 own = glm::clamp(glm::ivec2(place), 0, kSide - 1);
      if (!fieldTexelUsed(own, kSide, static_cast<int>(one.directions))) continue;
      ++looked;
      glm::dvec2 off = place - (glm::dvec2(texels[i] % kSide, texels[i] / kSide) + 0.5);
      if (one.directions == DirectionForm::Polar) off.y -= kSide * std::round(off.y / kSide);
      // About the polar map's axis turns are known the less the nearer it is.
      const double slack =
          one.directions == DirectionForm::Polar ? 1e-3 / std::max(1e-3, place.x / kSide) : 1e-3;
      beside += std::abs(off.x) > 0.5 + slack || std::abs(off.y) > 0.5 + slack;
    }
    EXPECT_EQ(far, 0) << toText(one.positions) << ' ' << one.count;
    if (one.count == 82) {
      EXPECT_GT(below, 500);
    }
    EXPECT_EQ(beside, 0) << toText(one.directions) << ' ' << one.count;
    EXPECT_GT(looked, 0.9 * one.rays * (one.directions == DirectionForm::Rejection ? M_PI / 4.0 : 1.0));
  }
}

/// Two boxes that touch along a face.
const glm::dvec3 kTouchingLow[] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.1}},
                 kTouchingHigh[] = {{1.0, 1.0, 1.0}, {1.8, 0.6, 0.9}};

/// Distance to a box along a ray that may start within it; negative: none. By slabs.
double toBox(int box, glm::dvec3 from, glm::dvec3 way) {
  double near = -1e30, far = 1e30;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (kTouchingLow[box][axis] - from[axis]) / way[axis],
                 b = (kTouchingHigh[box][axis] - from[axis]) / way[axis];
    near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
  }
  return near <= far && far > 0.0 ? (near > 0.0 ? near : far) : -1.0;
}

// Where a looked-up ray meets one of two touching boxes, from afar and from the other's surface within the
// sphere: the position nearest to where it enters the sphere or leaves it, found among all, and the texel's
// own direction make a ray, which slabs trace; its distance to the box, and nothing else, is what the look-up
// must say. That ray lies within a footprint of the one that was asked for. Placed as they are, and turned,
// five times as large and 1e5 diagonals from the origin. Rays whose places on the sphere or in a map lie
// within rounding, 1e-6 of a few radii, of the border of a cell or a texel, or of the box's edge, may differ:
// 2e-3 as in Field.MovesWithItsObject.
TEST_F(Field, LookUpsAreExactRaysWithinAFootprintOfThose) {
  constexpr int kSide = 32, kPositions = 1090, kRays = 20000;
  const FieldForm form{PositionForm::Lattice, kPositions, DirectionForm::Concentric, kSide, 32};
  constexpr double kSlack = 0.3;  // diameters, from inside
  const PositionMap map(form.positionMap, form.positions);
  // Cells of 90 / 16 degrees, as in the lattice of 32 segments above (field_look_up_test.cpp).
  // Concentric map, a (cos t, sin t) with t = pi b / (4 a): its derivatives by a and b have lengths sqrt(1 +
  // t^2) and pi / 4 and the product -pi t / 4, so that half a texel along both, 1 / side, is at most sqrt(1 +
  // pi^2 / 4) / side on the disc.
  const double mostAside = glm::radians(0.5 * 90.0 / 16.0 / std::cos(M_PI / 4) * std::sqrt(2.0)),
               mostTurned = std::sqrt(1.0 + 0.25 * M_PI * M_PI) / kSide;
  std::vector<RigidObject> objects;
  for (int box = 0; box < 2; ++box)
    objects.push_back(objectOf(scene::box(kTouchingLow[box], kTouchingHigh[box])));
  VisibilityFields fields = make(objects, form);
  for (const bool moved : {false, true}) {
    const glm::dmat3 turn(moved
                              ? glm::rotate(glm::dmat4(1.0), 0.9, glm::normalize(glm::dvec3(0.3, -1.0, 0.5)))
                              : glm::dmat4(1.0));
    const double scale = moved ? 5.0 : 1.0;
    const glm::dvec3 to = moved ? glm::dvec3(1.2e6, -0.7e6, 0.4e6) : glm::dvec3(0.0),
                     anchor = to + glm::dvec3(1.0, 2.0, 0.5) * scale;
    const auto placed = [&](glm::dvec3 p) { return to + scale * (turn * p); };
    std::vector<Pose> poses;
    for (const RigidObject& object : objects)
      poses.push_back({turn, placed(object.sphere.centre), scale * object.sphere.radius});
    fields.place(poses, anchor);
    for (int box = 0; box < 2; ++box) {
      const Sphere sphere = objects[size_t(box)].sphere;
      std::mt19937_64 engine(31);
      std::uniform_real_distribution<> uniform;
      std::vector<glm::dvec3> origins, ways;
      std::vector<ray_tracing::BatchRay> rays;
      for (int i = 0; i < kRays; ++i) {
        // On the lower box's top or, above that, on the higher one's side, or anywhere around.
        glm::dvec3 from = box == 0 ? glm::dvec3(glm::mix(1.0, 1.8, uniform(engine)), 0.6, uniform(engine))
                                   : glm::dvec3(1.0, glm::mix(0.6, 0.9, uniform(engine)), uniform(engine));
        if (i % 2 == 0) from = sphere.centre + 5.0 * randomPoint(engine, 1);
        const glm::dvec3 at = glm::mix(kTouchingLow[box], kTouchingHigh[box],
                                       glm::dvec3(uniform(engine), uniform(engine), uniform(engine)));
        const glm::dvec3 way = glm::normalize(at - from);
        rays.push_back({glm::vec3(placed(from) - anchor), 0.0F, glm::vec3(turn * way), 1.0F});
        origins.push_back(from), ways.push_back(way);
      }
      const std::vector<float> found = lookUp(context(), fields, uint32_t(box), rays, kSlack);
      int apart = 0, hits = 0, within = 0;
      for (size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 from = (origins[i] - sphere.centre) / sphere.radius, way = ways[i];
        const double along = -glm::dot(from, way),
                     squared = 1.0 - glm::dot(from + along * way, from + along * way);
        double expected = -1.0;
        if (squared > 0.0 && along + std::sqrt(squared) > 0.0) {
          const double half = std::sqrt(squared);
          const bool inside = along < half;
          within += inside;
          const glm::dvec3 point = from + (along + (inside ? half : -half)) * way,
                           asked = inside ? -way : way;
          const glm::vec3 position =
              *std::max_element(map.points().begin(), map.points().end(), [&](glm::vec3 a, glm::vec3 b) {
                return glm::dot(glm::dvec3(a), point) < glm::dot(glm::dvec3(b), point);
              });
          glm::dvec3 local = localOf(position, asked);
          if (local.z < 0.0) local = {glm::normalize(glm::dvec2(local)), 0.0};
          const glm::ivec2 texel = fieldTexel(glm::vec3(local), kSide, kFieldConcentric);
          const glm::dvec3 own(fieldDirection((glm::vec2(texel) + 0.5F) / float(kSide), kFieldConcentric));
          ASSERT_LT(std::acos(std::min(glm::dot(glm::dvec3(position), point), 1.0)), mostAside);
          ASSERT_LT(glm::length(glm::dvec2(own) - glm::dvec2(local)), mostTurned + 1e-5);
          const glm::vec3 z = -position;
          const glm::dvec3 ownWay = own.x * glm::dvec3(fieldTangent(z)) +
                                    own.y * glm::dvec3(fieldBitangent(z)) + own.z * glm::dvec3(z);
          const double met =
              toBox(box, sphere.centre + sphere.radius * glm::dvec3(position), ownWay) / sphere.radius;
          if (met > 0.0 && (!inside || along + half - met > 2.0 * kSlack))
            expected = scale * sphere.radius * (inside ? along + half - met : along - half + met);
        }
        hits += expected >= 0.0;
        apart += expected < 0.0 ? found[i] >= 0.0F : !(std::abs(found[i] - expected) <= 1e-4 * scale);
      }
      EXPECT_GT(hits, kRays / 2) << moved << box;
      EXPECT_GT(within, kRays / 10) << moved << box;
      EXPECT_LT(double(apart) / kRays, 2e-3) << moved << box;
    }
  }
}

}  // namespace
}  // namespace limen::visibility_fields
