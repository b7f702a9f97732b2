// SPDX-License-Identifier: BSD-3-Clause
// Fields made in compute against Embree's, and rays looked up in them against what geometry allows.
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <thread>

#include "renderer/scene/shapes.h"
#include "renderer/visibility_fields/cpu_field.h"
#include "renderer/visibility_fields/field_batch.h"
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/field_store.h"
#include "renderer/visibility_fields/map_functions.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::visibility_fields {
namespace {

RigidObject objectOf(const scene::Mesh& mesh) {
  return makeRigidObject("object", mesh.positions, mesh.triangles);
}

/// A cone beside a box: concave together, with edges and a round side.
scene::Mesh coneAndBox() {
  scene::Mesh mesh = scene::frustum({0.0, 0.0, 0.0}, {0.1, 1.4, 0.0}, 0.5, 0.0, 48);
  scene::append(mesh, scene::box({0.4, 0.0, -0.3}, {0.9, 0.7, 0.4}));
  return mesh;
}

class Field : public gl::GlTest {
 protected:
  static VisibilityFields make(const std::vector<RigidObject>& objects, const FieldForm& form) {
    return VisibilityFields(context(), objects, form);
  }
};

// The same rays, but for the rounding of their directions: some units in the last place, 1e-6. Distances to a
// face differ by that over the sine of the angle between ray and face, and where a ray passes an edge within
// it the two may differ by anything. Edges seen from a position are lines in its map; a texel's ray lies
// within 1e-6 of them for a share 2e-6 of the length of all edges in units of the map, below 20 here: 4e-5 of
// all texels, and as many faces are seen at a sine below 1e-3.
TEST_F(Field, MadeInComputeEqualsEmbreesWithinQuantisation) {
  const RigidObject object = objectOf(coneAndBox());
  for (const DirectionForm directions :
       {DirectionForm::Polar, DirectionForm::Rejection, DirectionForm::Concentric})
    for (const PositionForm positions : {PositionForm::Lattice, PositionForm::Grid, PositionForm::Box})
      for (const int bits : {8, 16, 32}) {
        if (bits == 16 && positions != PositionForm::Lattice) continue;
        const FieldForm form{positions, 290, directions, 16, bits};
        const std::vector<float> gpu = make({object}, form).readShares(0),
                                 cpu = traceFieldOnCpu(object, form);
        ASSERT_EQ(gpu.size(), cpu.size());
        const float allowed = 0.5F * fieldCodeStep(bits) + 1e-5F;
        size_t apart = 0, hits = 0;
        for (size_t i = 0; i < gpu.size(); ++i) {
          hits += cpu[i] >= 0.0F;
          apart += !(std::abs(gpu[i] - cpu[i]) <= allowed);
        }
        EXPECT_LE(double(apart) / double(gpu.size()), 1e-4)
            << toText(directions) << ' ' << toText(positions) << bits;
        EXPECT_GT(hits, gpu.size() / 20);
        EXPECT_LT(hits, gpu.size());
      }
}

// What is read back from words of 8 and 16 bits is the code of the float that the same ray gave, for every
// texel of several objects in many slices.
/// Codes are the nearest ones, but where the product of share and codes lies within its rounding (2^-24 of
/// itself, twice, as a compiler may join product and sum) of the middle between two.
TEST_F(Field, EveryTexelIsUnpackedFromItsOwnPlace) {
  const std::vector<RigidObject> objects = {objectOf(coneAndBox()),
                                            objectOf(scene::box({0, 0, 0}, {1, 2, 3}))};
  for (const int side : {8, 16, 64}) {
    const VisibilityFields exact =
        make(objects, {PositionForm::Lattice, 82, DirectionForm::Concentric, side, 32});
    for (const int bits : {1, 8, 16}) {
      const VisibilityFields coded =
          make(objects, {PositionForm::Lattice, 82, DirectionForm::Concentric, side, bits});
      for (uint32_t object = 0; object < 2; ++object) {
        const std::vector<float> expected = exact.readShares(object), found = coded.readShares(object);
        ASSERT_EQ(expected.size(), found.size());
        size_t wrong = 0;
        for (size_t i = 0; i < found.size(); ++i)
          if (expected[i] < 0.0F || bits == 1)
            wrong += (expected[i] < 0.0F) != (found[i] < 0.0F);
          else
            wrong +=
                std::abs(found[i] - expected[i]) > (0.5 + std::ldexp(1.0, bits - 23)) * fieldCodeStep(bits);
        EXPECT_EQ(wrong, 0U) << bits << ' ' << side;
      }
    }
  }
}

TEST_F(Field, OneBitSavesSevenEighthsAndKeepsTheMeanDistance) {
  const RigidObject object = objectOf(coneAndBox());
  const FieldForm bytes{PositionForm::Lattice, 82, DirectionForm::Concentric, 32, 8};
  FieldForm bit = bytes;
  bit.bits = 1;
  const VisibilityFields fine = make({object}, bytes), coarse = make({object}, bit);
  EXPECT_EQ(8 * coarse.bytes(), fine.bytes());
  const std::vector<float> each = traceFieldOnCpu(object, bytes), found = coarse.readShares(0);
  for (size_t map = 0; map < 82; ++map) {
    double sum = 0.0, mean = -1.0;
    int hits = 0;
    for (size_t i = 1024 * map; i < 1024 * (map + 1); ++i) {
      if (each[i] >= 0.0F) sum += each[i], ++hits;
      if (found[i] >= 0.0F) mean = found[i];
    }
    ASSERT_GT(hits, 0);
    // Single-precision sums of up to 1024 terms: 1e-4 of it. One hit more or less at an edge moves it by 2 /
    // hits.
    EXPECT_NEAR(mean, sum / hits, 1e-4 + 2.0 / hits);
  }
}

// Fields of several forms in one texture, each in slices of its own: what is kept of each object is what it
// has alone, and looking it up gives the same.
TEST_F(Field, SeveralFormsBesideEachOtherAreAsEachAlone) {
  const std::vector<RigidObject> objects = {
      objectOf(coneAndBox()), objectOf(scene::box({0, 0, 0}, {1, 2, 3})), objectOf(coneAndBox())};
  const std::vector<FieldForm> forms = {{PositionForm::Lattice, 290, DirectionForm::Concentric, 32, 8},
                                        {PositionForm::Lattice, 82, DirectionForm::Concentric, 16, 1},
                                        {PositionForm::Lattice, 1090, DirectionForm::Concentric, 8, 32}};
  const VisibilityFields together(context(), objects, forms);
  std::mt19937_64 engine(3);
  std::normal_distribution<> normal;
  int64_t bytes = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    const VisibilityFields alone = make({objects[i]}, forms[i]);
    bytes += alone.bytes();
    EXPECT_EQ(together.readWords(i), alone.readWords(0)) << i;
    EXPECT_EQ(together.readShares(i), alone.readShares(0)) << i;
    std::vector<ray_tracing::BatchRay> rays;
    for (int ray = 0; ray < 4000; ++ray) {
      const Sphere& sphere = objects[i].sphere;
      const glm::dvec3 from =
          sphere.centre + (ray % 2 == 0 ? 3.0 : 0.5) * sphere.radius *
                              glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine)));
      const glm::dvec3 at =
          sphere.centre + 0.3 * sphere.radius * glm::dvec3(normal(engine), normal(engine), normal(engine));
      rays.push_back({glm::vec3(from), 0.0F, glm::vec3(glm::normalize(at - from)), 1.0F});
    }
    EXPECT_EQ(lookUp(context(), together, i, rays, 0.01), lookUp(context(), alone, 0, rays, 0.01)) << i;
  }
  EXPECT_EQ(together.bytes(), bytes);
}

TEST_F(Field, TakesOneByteARay) {
  // 4226 x 32^2 in the thesis: 4.127 MiB, printed to three places (Gaitatzes 2012, Fig. 42).
  const RigidObject object = objectOf(scene::box({0, 0, 0}, {1, 1, 1}));
  const VisibilityFields field =
      make({object}, {PositionForm::Lattice, 4226, DirectionForm::Concentric, 32, 8});
  EXPECT_NEAR(double(field.bytes()) / (1 << 20), 4.127, 0.0005);
}

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

// Lossy compression changes codes by its tolerance at most and no miss, and each word comes back to its own
// place.
TEST_F(Field, ToleranceBoundsWhatCompressionChanges) {
  const std::vector<RigidObject> objects = {objectOf(coneAndBox()),
                                            objectOf(scene::box({0, 0, 0}, {1, 2, 3}))};
  const FieldForm form{PositionForm::Lattice, 290, DirectionForm::Concentric, 16, 8};
  const VisibilityFields exact(context(), objects, form), lossy(context(), objects, form, 4);
  EXPECT_LT(double(lossy.runLengthBytes()), 0.9 * double(exact.runLengthBytes()));
  for (uint32_t object = 0; object < 2; ++object) {
    const std::vector<float> before = exact.readShares(object), after = lossy.readShares(object);
    for (size_t i = 0; i < before.size(); ++i) {
      ASSERT_EQ(before[i] < 0.0F, after[i] < 0.0F);
      ASSERT_LE(std::abs(before[i] - after[i]), 4.001F * fieldCodeStep(8));
    }
  }
}

TEST_F(Field, IsTheSameInEveryRun) {
  const RigidObject object = objectOf(coneAndBox());
  const FieldForm form{PositionForm::Lattice, 290, DirectionForm::Concentric, 32, 32};
  EXPECT_EQ(make({object}, form).readWords(0), make({object}, form).readWords(0));
}

class KeptFields : public Field {
 protected:
  void SetUp() override {
    Field::SetUp();
    std::string pattern = (std::filesystem::temp_directory_path() / "limen_fields_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    std::filesystem::remove_all(folder_);
    Field::TearDown();
  }
  std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) out.push_back(entry.path());
    return out;
  }
  std::string folder_;
};

TEST_F(KeptFields, AreReadAsTheyWereMade) {
  const std::vector<RigidObject> objects = {objectOf(coneAndBox()),
                                            objectOf(scene::box({0, 0, 0}, {1, 2, 3}))};
  for (const int bits : {1, 8, 32}) {
    const FieldForm form{PositionForm::Lattice, 82, DirectionForm::Concentric, 16, bits};
    const VisibilityFields made(context(), objects, form);
    const VisibilityFields first(context(), {objects[1]}, form, 0, folder_);
    EXPECT_EQ(first.fieldsRead(), 0U);
    const VisibilityFields second(context(), objects, form, 0, folder_);
    EXPECT_EQ(second.fieldsRead(), 1U);
    const VisibilityFields third(context(), objects, form, 0, folder_);
    EXPECT_EQ(third.fieldsRead(), 2U);
    for (uint32_t object = 0; object < 2; ++object) {
      EXPECT_EQ(second.readShares(object), made.readShares(object)) << bits;
      EXPECT_EQ(third.readShares(object), made.readShares(object)) << bits;
    }
  }
}

// Another object or form is another file; one that is cut short or has a letter changed is made again and
// replaced.
TEST_F(KeptFields, ADamagedFileIsReplaced) {
  const RigidObject object = objectOf(coneAndBox());
  FieldForm form{PositionForm::Lattice, 82, DirectionForm::Concentric, 16, 8};
  const std::vector<float> right = VisibilityFields(context(), {object}, form, 0, folder_).readShares(0);
  ASSERT_EQ(files().size(), 1U);
  const std::filesystem::path file = files()[0];
  for (const bool cut : {true, false}) {
    if (cut) {
      std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    } else {
      std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
      out.seekp(1000);
      out.put(static_cast<char>(0x5a)), out.put(static_cast<char>(0xa5));
    }
    const VisibilityFields again(context(), {object}, form, 0, folder_);
    EXPECT_EQ(again.fieldsRead(), 0U);
    EXPECT_EQ(again.readShares(0), right);
    EXPECT_EQ(VisibilityFields(context(), {object}, form, 0, folder_).fieldsRead(), 1U);
  }
  form.directions = 8;
  EXPECT_EQ(VisibilityFields(context(), {object}, form, 0, folder_).fieldsRead(), 0U);
  EXPECT_EQ(files().size(), 2U);
}

// Writers and readers at once, as of several processes: whatever is there is whole.
TEST_F(KeptFields, AreWholeWhileOthersWriteThem) {
  const FieldStore store(folder_, "device");
  const std::string path = folder_ + "/one.field";
  const StoredField field{std::vector<uint32_t>(50000, 7U), {}};
  store.write(path, field);
  std::atomic<int> missing = 0;
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 4; ++thread)
      threads.emplace_back([&, thread] {
        for (int i = 0; i < 10; ++i)
          if (thread % 2 == 0)
            store.write(path, field);
          else if (!store.read(path, 50000, 0))
            ++missing;
      });
  }
  EXPECT_EQ(missing, 0);
  EXPECT_EQ(files().size(), 1U);
}

}  // namespace
}  // namespace limen::visibility_fields
