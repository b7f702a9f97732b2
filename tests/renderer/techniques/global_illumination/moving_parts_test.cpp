// SPDX-License-Identifier: BSD-3-Clause
// Indirect light in a scene whose parts move.
#include "renderer/scene/part_motion.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/global_illumination/indirect_light_fixture.h"

namespace limen::techniques {
namespace {

class MovingPartsLight : public IndirectLightTest {
 protected:
  /// A room with a red box that has moved by more than its own width after a second and never leaves the
  /// room, so that voxels are the same at all times.
  static scene::Scene roomWithMovingBox() {
    scene::Scene scene = makeScene("global_illumination/room");
    const scene::Bounds bounds = scene.bounds();
    const glm::dvec3 size = bounds.high - bounds.low, low = bounds.low + glm::dvec3(0.375, 0.02, 0.3) * size;
    scene::addPart(scene, "box", scene::box(low, low + glm::dvec3(0.25) * size), glm::vec3(0.8F, 0.1F, 0.1F));
    scene::PartMotion motion;
    motion.part = static_cast<uint32_t>(scene.parts.size() - 1);
    motion.travel = {0.3 * size.x, 0.0, 0.0};
    motion.periodS = 4.0;
    scene.motions = {motion};
    return scene;
  }
  static Image pictureAt(const scene::Scene& scene, const char* technique, Given given, double timeS) {
    given["light"] = std::string("indirect");
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {32, 24}, 0.0);
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    Image out;
    for (const double time : {0.0, timeS}) {
      frame.setTime(time);
      frame.begin();
      made->render(frame);
      out = made->product().read();
      frame.end();
    }
    return out;
  }
};

/// In the next frame what has moved blocks and reflects where it is: the picture is that of a scene at rest
/// whose box stands there, but for rounding, which moves a few samples and voxels' edges: a twentieth of the
/// change from the box's first place.
TEST_F(MovingPartsLight, IsThatOfPartsWhereTheyAre) {
  const scene::Scene moving = roomWithMovingBox(), moved = scene::movedTo(moving, 1.0);
  ASSERT_TRUE(moved.motions.empty());
  struct Case {
    const char* technique;
    Given given;
  };
  const Case cases[] = {{kPropagation, {{"resolution", int64_t{16}}}},
                        {kPropagation, {{"resolution", int64_t{16}}, {"light", std::string("all")}}},
                        {"global_illumination/voxel_cone_tracing", {{"resolution", int64_t{16}}}},
                        {"global_illumination/path_traced", {{"paths", int64_t{16}}}}};
  for (const Case& each : cases) {
    const Image first = pictureAt(moving, each.technique, each.given, 0.0),
                found = pictureAt(moving, each.technique, each.given, 1.0),
                expected = pictureAt(moved, each.technique, each.given, 0.0);
    const double change = error(first, expected);
    EXPECT_GT(change, 0.01) << each.technique;
    EXPECT_LT(error(found, expected), 0.05 * change) << each.technique;
  }
}

}  // namespace
}  // namespace limen::techniques
