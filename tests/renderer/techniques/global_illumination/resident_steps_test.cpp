// SPDX-License-Identifier: BSD-3-Clause
// Steps of light in one dispatch beside one dispatch each.
#include <vector>

#include "renderer/techniques/global_illumination/voxel_propagation/light_grid.h"
#include "tests/renderer/techniques/global_illumination/indirect_light_fixture.h"

namespace limen::techniques {
namespace {

class ResidentLightSteps : public IndirectLightTest {
 protected:
  struct Light {
    bool atOnce = false;
    std::vector<float> field;  ///< of all channels and layers after the second of two frames
    std::vector<float> arrived;
  };
  static Light lightOf(const scene::Scene& scene, LightGridSettings settings, StepDispatch dispatch) {
    settings.steps.dispatch = dispatch;
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {8, 8});
    LightGrid grid(frame, settings, {});
    Light out;
    out.atOnce = grid.stepsAtOnce();
    for (int i = 0; i < 2; ++i) {
      frame.begin();
      grid.update(frame);
      frame.end();
    }
    grid.checkSteps();
    const int depth = grid.volume().grid().resolution.z;
    // Some layers: an error spreads to all within the steps. Reading many takes long on a GPU.
    for (int layer = 0; layer < 3 * depth; layer += 7) {
      const Image one = grid.fieldLayer(layer / depth, layer % depth);
      out.field.insert(out.field.end(), one.data.begin(), one.data.end());
    }
    for (int layer = 0; layer < 6 * depth; layer += 11) {
      const Image one = grid.arrived().readLayer(layer);
      out.arrived.insert(out.arrived.end(), one.data.begin(), one.data.end());
    }
    return out;
  }
};

/// To the last bit: the same sums, whatever order groups run in, in grids of one group and many, whole ones
/// or not; light that goes on from frame to frame as well. Where the device does not run all groups at a
/// time, nothing is to be compared.
TEST_F(ResidentLightSteps, AreStepsOneByOne) {
  const scene::Scene rooms[] = {makeScene("global_illumination/room"),
                                makeScene("global_illumination/divided_room", {{"transmittance", 0.5}}),
                                makeScene("global_illumination/stand_in", {{"turn_deg", 30.0}})};
  int compared = 0;
  for (const scene::Scene& scene : rooms)
    for (const int resolution : {6, 14, 32})
      for (const FieldFormat format : {FieldFormat::Half, FieldFormat::Single})
        for (const int iterations : {2, 7, 64}) {
          if (&scene != &rooms[0] && (resolution == 14 || iterations == 2)) continue;
          LightGridSettings settings;
          settings.resolution = resolution, settings.format = format, settings.iterations = iterations;
          if (iterations == 7) settings.update = UpdateOn{};
          const Light once = lightOf(scene, settings, StepDispatch::Fitting);
          if (!once.atOnce) break;
          const Light each = lightOf(scene, settings, StepDispatch::Each);
          EXPECT_FALSE(each.atOnce);
          ++compared;
          size_t different = 0;
          for (size_t i = 0; i < each.field.size(); ++i) different += once.field[i] != each.field[i];
          EXPECT_EQ(different, 0U) << "of " << each.field.size() << ", " << resolution << " voxels, "
                                   << iterations << " steps";
          EXPECT_EQ(once.arrived, each.arrived);
        }
  EXPECT_GT(compared, 0);
}

/// All transports and reflections, in one group.
TEST_F(ResidentLightSteps, HoldForAllTransports) {
  const scene::Scene scene = makeScene("global_illumination/slanted_wall");
  for (const LightTransport& transport :
       {LightTransport(MomentTransport{}), LightTransport(FaceTransport{}), LightTransport(ConeTransport{}),
        LightTransport(ComponentTransport{})})
    for (const GridReflection reflection :
         {GridReflection::Axis, GridReflection::Normal, GridReflection::Diffuse}) {
      LightGridSettings settings;
      settings.resolution = 6, settings.iterations = 9, settings.transport = transport,
      settings.reflection = reflection, settings.albedo = GridAlbedo::Half;
      const Light once = lightOf(scene, settings, StepDispatch::Fitting);
      ASSERT_TRUE(once.atOnce);
      EXPECT_EQ(once.field, lightOf(scene, settings, StepDispatch::Each).field);
    }
}

/// A software renderer does not keep more than one group running, and says so; a device that does not is
/// found out by the trial.
TEST_F(ResidentLightSteps, AreOneDispatchEachWhereGroupsDoNotFit) {
  const scene::Scene scene = makeScene("global_illumination/room");
  LightGridSettings settings;
  settings.resolution = context().device().software ? 16 : 128, settings.iterations = 2;
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {8, 8});
  const LightGrid grid(frame, settings, {});
  EXPECT_FALSE(grid.stepsAtOnce());
  EXPECT_NE(grid.stepsRemark().find("one dispatch each"), std::string::npos) << grid.stepsRemark();
  settings.steps.dispatch = StepDispatch::Once;
  EXPECT_THROW(LightGrid(frame, settings, {}), Error);
}

}  // namespace
}  // namespace limen::techniques
