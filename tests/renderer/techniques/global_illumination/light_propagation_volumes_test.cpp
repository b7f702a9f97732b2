// SPDX-License-Identifier: BSD-3-Clause
// Light propagation volumes: what they send, what their blockers take, and what becomes of the flux of a
// floor.
#include "tests/renderer/techniques/global_illumination/indirect_light_fixture.h"

namespace limen::techniques {
namespace {

class LightPropagationVolumes : public IndirectLightTest {};

/// BL-04. A rival must be worth comparing with: where the lamp lights, light propagation volumes are nearer
/// to all light than none is, and they do not send more than it, though they know one bounce only: what they
/// count too often (1.9 times where light comes from all sides) stays below what further bounces add.
TEST_F(LightPropagationVolumes, NeitherMissNorInventTheLamp) {
  for (const char* name : {"cornell_box", "global_illumination/room"}) {
    const scene::Scene scene = makeScene(name);
    const Image reference = truth(scene), nothing(32, 24, 4);
    for (const int64_t resolution : {16, 32}) {
      const Image found = indirect(scene, {{"resolution", resolution}}, false, kPropagationVolumes).product;
      EXPECT_LT(error(found, reference), 0.75 * error(nothing, reference)) << name << ", " << resolution;
      EXPECT_LT(meanOf(found, 0, 32), meanOf(reference, 0, 32)) << name << ", " << resolution;
    }
  }
}

/// BL-04. A floor in the open and a small probe above it: nothing is between. Blocked is what goes against
/// the front of a surface, so that the floor's own light must leave the floor's voxels whole. Blocking both
/// ways takes most of it.
TEST_F(LightPropagationVolumes, BlockersLetTheLightOfTheirOwnVoxelsLeave) {
  const scene::Scene scene = probeAboveFloor();
  const auto volumes = [&](const char* blockers) {
    return meanOf(indirect(scene, {{"resolution", int64_t{20}}, {"blockers", std::string(blockers)}}, false,
                           kPropagationVolumes)
                      .product,
                  0, 32);
  };
  const double none = volumes("none");
  EXPECT_GT(none, 0.01);
  // What meets the probe alone, 1/400 of the floor's size, is blocked behind it.
  EXPECT_NEAR(volumes("fronts"), none, 0.01 * none);
  EXPECT_LT(volumes("sides"), 0.1 * none);
}

/// BL-04. The same floor's flux is known: its radiance is .8 * .8 times the cosine to the lamp, and what of
/// it passes the probe's plane is the reference's irradiance there. Lobes about six axes scatter light at
/// each of the six steps that it takes up there, half of it back to the floor, where it is lost: propagation
/// volumes keep less than half of it, blockers or none, while moments, which go on as they are, keep it
/// within a third.
TEST_F(LightPropagationVolumes, LobesAboutAxesLoseTheLightOfAFloorThatMomentsKeep) {
  const scene::Scene scene = probeAboveFloor();
  const double known = meanOf(truth(scene), 0, 32);
  EXPECT_LT(meanOf(indirect(scene, {{"resolution", int64_t{20}}}, false, kPropagationVolumes).product, 0, 32),
            0.5 * known);
  // The probe is smaller than a voxel: thin voxels would miss it.
  const double moments = meanOf(
      indirect(scene, {{"coverage", std::string("conservative")}, {"resolution", int64_t{20}}}).product, 0,
      32);
  EXPECT_NEAR(moments, known, known / 3.0);
}

}  // namespace
}  // namespace limen::techniques
