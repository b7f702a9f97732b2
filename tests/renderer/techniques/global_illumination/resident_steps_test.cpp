// SPDX-License-Identifier: BSD-3-Clause
// Steps of light in one dispatch beside one dispatch each.
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "renderer/techniques/global_illumination/voxel_propagation/light_grid.h"
#include "tests/renderer/techniques/global_illumination/indirect_light_fixture.h"

namespace limen::techniques {
namespace {

/// Groups that Mesa's software renderer runs at a time: one for each of its threads, of which it takes 16 at
/// most, even on fewer processors. Set before the context is made.
constexpr int kThreads = 16;
const bool kThreadsSet = setenv("LP_NUM_THREADS", std::to_string(kThreads).c_str(), 1) == 0;

class ResidentLightSteps : public IndirectLightTest {
 protected:
  struct Light {
    bool atOnce = false;
    std::vector<float> field;  ///< of all channels and layers after the last frame
    std::vector<float> arrived;
  };
  /// All in one, where the device may run as many groups; at a software renderer's on request alone.
  static StepDispatch atOnce() {
    if (context().device().software) return OneDispatch{};
    return FittingDispatch{};
  }
  /// What `make` returns; where a software renderer's threads got no turn in time, as on a busy machine, what
  /// it returns when it is called again.
  template <class F>
  static auto inTime(const F& make) {
    for (int attempt = 1; context().device().software && attempt < 4; ++attempt) try {
        return make();
      } catch (const Error&) {
      }
    return make();
  }
  static Light lightOf(LightGrid& grid, frame::Frame& frame, int frames) {
    Light out;
    out.atOnce = grid.stepsAtOnce();
    for (int i = 0; i < frames; ++i) {
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
  static Light lightOf(const scene::Scene& scene, LightGridSettings settings, const StepDispatch& dispatch,
                       int frames = 2) {
    settings.steps.dispatch = dispatch;
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {8, 8});
    LightGrid grid(frame, settings, {});
    return lightOf(grid, frame, frames);
  }
  static void expectSame(const Light& once, const Light& each, const std::string& what) {
    size_t different = 0;
    ASSERT_EQ(once.field.size(), each.field.size());
    double sum = 0.0;
    for (size_t i = 0; i < each.field.size(); ++i) {
      different += once.field[i] != each.field[i];
      sum += std::abs(double(each.field[i]));
    }
    EXPECT_GT(sum, 0.0) << what;
    EXPECT_EQ(different, 0U) << "of " << each.field.size() << ", " << what;
    EXPECT_EQ(once.arrived, each.arrived) << what;
  }
};

/// To the last bit: the same sums, whatever order groups run in, in grids of one group and many, whole ones
/// or not; light that goes on from frame to frame as well. Where the device does not run all groups at a
/// time, nothing is to be compared.
TEST_F(ResidentLightSteps, AreStepsOneByOne) {
  const scene::Scene rooms[] = {makeScene("global_illumination/room"),
                                makeScene("global_illumination/divided_room", {{"transmittance", 0.5}}),
                                makeScene("global_illumination/stand_in", {{"turn_deg", 30.0}})};
  const bool software = context().device().software;  // of whose 16 groups each waits for turns of the others
  int compared = 0;
  for (const scene::Scene& scene : rooms)
    for (const int resolution : {6, 14, 32})
      for (const FieldFormat format : {FieldFormat::Half, FieldFormat::Single})
        for (const int iterations : {2, 7, software ? 20 : 64}) {
          if (&scene != &rooms[0] && (resolution == 14 || iterations == 2)) continue;
          if (software && (resolution == 32 || (resolution == 14 && iterations == 2))) continue;
          LightGridSettings settings;
          settings.resolution = resolution, settings.format = format, settings.iterations = iterations;
          if (iterations == 7) settings.update = UpdateOn{};
          const Light each = lightOf(scene, settings, DispatchEach{});
          EXPECT_FALSE(each.atOnce);
          const Light once = inTime([&] { return lightOf(scene, settings, atOnce()); });
          if (!once.atOnce) continue;
          ++compared;
          expectSame(once, each,
                     std::to_string(resolution) + " voxels, " + std::to_string(iterations) + " steps");
        }
  EXPECT_GT(compared, 0);
}

/// Counts of steps begin so that tags wrap within the first 100, those of the trial among them;
/// light that goes on from frame to frame would keep an error. Two grids of several groups, whose frames take
/// turns, do not share what is counted.
TEST_F(ResidentLightSteps, CountOnPastTheLastTagAndApart) {
  const scene::Scene rooms[] = {makeScene("global_illumination/room"),
                                makeScene("global_illumination/stand_in", {{"turn_deg", 30.0}})};
  LightGridSettings settings;
  settings.resolution = 8, settings.iterations = 13, settings.update = UpdateOn{};
  constexpr int kTurns = 12;
  const auto inTurns = [&]() -> std::array<Light, 2> {
    const frame::GpuScene gpuScenes[] = {frame::GpuScene(rooms[0]), frame::GpuScene(rooms[1])};
    frame::Frame first(context(), rooms[0], gpuScenes[0], {8, 8}),
        second(context(), rooms[1], gpuScenes[1], {8, 8});
    settings.steps.dispatch = atOnce();
    LightGrid one(first, settings, {}), other(second, settings, {});
    std::array<Light, 2> out;
    for (int i = 0; i < kTurns; ++i) out = {lightOf(one, first, 1), lightOf(other, second, 1)};
    return out;
  };
  const std::array<Light, 2> found = inTime(inTurns);
  for (size_t i = 0; i < 2; ++i)
    if (found[i].atOnce)
      expectSame(found[i], lightOf(rooms[i], settings, DispatchEach{}, kTurns), "turn " + std::to_string(i));
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
      const Light each = lightOf(scene, settings, DispatchEach{});
      const Light once = lightOf(scene, settings, FittingDispatch{});
      ASSERT_TRUE(once.atOnce);
      EXPECT_EQ(once.field, each.field);
    }
}

/// A grid of few voxels along two axes is one group only if these and those around them fit into 32 KiB of
/// shared memory.
TEST_F(ResidentLightSteps, FitIntoSharedMemory) {
  scene::Scene stick = makeScene("global_illumination/closed_box", {{"emission", 0.5}});
  for (glm::dvec3& position : stick.mesh.positions) position *= glm::dvec3(1.0, 0.02, 0.02);
  LightGridSettings settings;
  settings.resolution = 28, settings.iterations = 5, settings.format = FieldFormat::Single;
  const Light each = lightOf(stick, settings, DispatchEach{});
  const Light once = inTime([&] { return lightOf(stick, settings, atOnce()); });
  if (once.atOnce) {
    EXPECT_EQ(once.field, each.field);
  }
}

/// A device that does not keep all groups running is found out by the trial; a software renderer is not asked
/// to, unless that is wanted.
TEST_F(ResidentLightSteps, AreOneDispatchEachWhereGroupsDoNotFit) {
  const scene::Scene scene = makeScene("global_illumination/room");
  LightGridSettings settings;
  settings.resolution = context().device().software ? 24 : 128, settings.iterations = 2;
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {8, 8});
  settings.steps.dispatch = FittingDispatch{};
  const LightGrid grid(frame, settings, {});
  EXPECT_FALSE(grid.stepsAtOnce());
  EXPECT_NE(grid.stepsRemark().find("one dispatch each"), std::string::npos) << grid.stepsRemark();
  settings.steps.dispatch = OneDispatch{};
  EXPECT_THROW(LightGrid(frame, settings, {}), Error);
}

/// Groups in one row, twice as many as a software renderer has threads: the first could take some steps and
/// leave before the last begin, so that only a trial of as many steps as there are groups finds out that they
/// do not run at a time. It must not be a frame that does.
TEST_F(ResidentLightSteps, AreTriedForAsLongAsLightTakesFromGroupToGroup) {
  scene::Scene stick = makeScene("global_illumination/closed_box", {{"emission", 0.5}});
  for (glm::dvec3& position : stick.mesh.positions) position *= glm::dvec3(0.02, 0.02, 1.0);
  LightGridSettings settings;
  settings.resolution = 124, settings.iterations = 64;
  if (!context().device().software) {
    expectSame(lightOf(stick, settings, FittingDispatch{}), lightOf(stick, settings, DispatchEach{}),
               "groups in a row");
    return;
  }
  settings.steps.dispatch = OneDispatch{};
  const frame::GpuScene gpuScene(stick);
  frame::Frame frame(context(), stick, gpuScene, {8, 8});
  EXPECT_THROW(LightGrid(frame, settings, {}), Error);
}

}  // namespace
}  // namespace limen::techniques
