// SPDX-License-Identifier: BSD-3-Clause
// Voxel cone tracing: a rival must be worth comparing with.
#include "tests/renderer/techniques/global_illumination/indirect_light_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char* kConeTracing = "global_illumination/voxel_cone_tracing";

class VoxelConeTracing : public IndirectLightTest {
 protected:
  static Image traced(const scene::Scene& scene, int64_t bounces) {
    return indirect(scene, {{"resolution", int64_t{16}}, {"bounces", bounces}}, false, kConeTracing).product;
  }
};

/// With as many bounces as the reference it is nearer to it than no indirect light is, by lamps as by
/// emitters.
TEST_F(VoxelConeTracing, IsNearerToPathsThanNoLight) {
  struct Case {
    const char* scene;
    Given given;
  };
  const Case cases[] = {{"cornell_box", {}},
                        {"global_illumination/room", {}},
                        {"global_illumination/room", {{"lit_by", std::string("emitters")}}}};
  for (const Case& each : cases) {
    const scene::Scene scene = makeScene(each.scene, each.given);
    const Image reference = truth(scene), nothing(32, 24, 4);
    EXPECT_LT(error(traced(scene, 8), reference), error(nothing, reference)) << each.scene;
  }
}

/// In a closed box that emits e and reflects a, each further bounce adds the same share of what the one
/// before added, as all points see the same: a, if no cone lost light. Cones read walls between voxels and in
/// steps; of one along an axis 1 % passes, by the largest opacity. A fifth may be lost in all, and none is
/// gained: the logarithm of opacity alone, which lets a seventh through along an axis, lost 29 %.
TEST_F(VoxelConeTracing, LosesLittleThroughTheWallsOfAClosedBox) {
  const double emission = 0.5, albedo = 0.6;
  const scene::Scene box =
      makeScene("global_illumination/closed_box", {{"emission", emission}, {"albedo", albedo}});
  double before = 0.0, added = 0.0;
  for (const int64_t bounces : {1, 2, 3}) {
    const double found = meanOf(traced(box, bounces), 0, 32);
    const double term = found - before;
    EXPECT_GT(term, 0.0) << bounces;
    if (bounces > 1) {
      EXPECT_LT(term / added, albedo) << bounces;
      EXPECT_GT(term / added, 0.8 * albedo) << bounces;
    }
    before = found, added = term;
  }
}

}  // namespace
}  // namespace limen::techniques
