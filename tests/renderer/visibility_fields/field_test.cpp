// SPDX-License-Identifier: BSD-3-Clause
// Fields made in compute against Embree's, and how they are stored.
#include <cmath>
#include <random>
#include <vector>

#include "renderer/scene/shapes.h"
#include "renderer/visibility_fields/cpu_field.h"
#include "renderer/visibility_fields/field_batch.h"
#include "renderer/visibility_fields/map_functions.h"
#include "tests/renderer/visibility_fields/field_fixture.h"

namespace limen::visibility_fields {
namespace {

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

}  // namespace
}  // namespace limen::visibility_fields
