// SPDX-License-Identifier: BSD-3-Clause
// Pictures of stimuli against the renderer used by itself, coded by hand.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "perception/vision/colour.h"
#include "renderer/scene/shapes.h"
#include "study/stimulus/state_view.h"
#include "study/stimulus/stimulus_renderer.h"
#include "tests/experiments/base/declare.h"
#include "tests/study/stimulus/stimulus_fixture.h"

namespace limen::study {
namespace {

constexpr glm::ivec2 kStimulusSize{96, 72};

class StimulusRendererTest : public gl::GlTest {
 protected:
  static scene::Scene sceneOf(const Stimulus& stimulus) {
    return scene::buildScene(stimulus.scene.name, stimulus.scene.values);
  }

  /// Linear light of levels at a time, without the study: `samples` squared samples of one frame, averaged.
  static Image light(const Stimulus& stimulus, double timeS, int level, glm::ivec2 sizePx = kStimulusSize) {
    const frame::SceneOnGpu onGpu(sceneOf(stimulus));
    frame::Frame frame(context(), onGpu, sizePx * stimulus.samples, timeS);
    frame.setLevels(scene::uniformLevels(onGpu.scene, level));
    frame.begin();
    const Image fine = frame.get<frame::Shaded>(frame::ShadedSetting{}).texture().read();
    frame.end();
    return mean(fine, stimulus.samples);
  }

  static Image mean(const Image& fine, int samples) {
    Image out(fine.width / samples, fine.height / samples, 3);
    for (int y = 0; y < out.height; ++y)
      for (int x = 0; x < out.width; ++x)
        for (int c = 0; c < 3; ++c) {
          double sum = 0.0;
          for (int i = 0; i < samples * samples; ++i)
            sum += fine.at(x * samples + i % samples, y * samples + i / samples, c);
          out.at(x, y, c) = static_cast<float>(sum / (samples * samples));
        }
    return out;
  }

  /// Largest difference in codes between what is shown and what the sRGB curve gives in double precision.
  static double largestError(const Image& shown, const Image& linear) {
    EXPECT_EQ(shown.data.size(), linear.data.size());
    double largest = 0.0;
    for (size_t i = 0; i < shown.data.size(); ++i)
      largest = std::max(
          largest, std::abs(255.0 * shown.data[i] -
                            255.0 * perception::encodeSrgb(std::clamp(double{linear.data[i]}, 0.0, 1.0))));
    return largest;
  }
  // Half a code; the rest is single precision in the mean and the thresholds.
  static constexpr double kRounding = 0.5 + 2e-3;

  static bool wholeCodes(const Image& shown) {
    return std::all_of(shown.data.begin(), shown.data.end(), [](float value) {
      return std::abs(255.0F * value - std::round(255.0F * value)) < 1e-3F;
    });
  }
};

TEST_F(StimulusRendererTest, FramesAreThoseOfTheRendererAtTheirTimeAndLevel) {
  const Stimulus stimulus = patchStimulus();
  StimulusRenderer renderer(context(), stimulus, kStimulusSize, studyDisplay());
  ASSERT_EQ(renderer.frameCount(), 12);
  EXPECT_EQ(renderer.pictureCount(), 12);
  // The last frame with the coarser level, the first with the finer one, and both ends.
  for (const auto& [frame, level] : {std::pair{0, 1}, {5, 1}, {6, 0}, {11, 0}}) {
    const Image shown = renderer.readBack(frame);
    EXPECT_TRUE(wholeCodes(shown));
    EXPECT_LE(largestError(shown, light(stimulus, frame / 60.0, level)), kRounding) << frame;
  }
  // The change is there to be seen: the other level's picture is another one.
  EXPECT_GT(largestError(renderer.readBack(6), light(stimulus, 6 / 60.0, 1)), 5.0);
}

TEST_F(StimulusRendererTest, TheSameStimulusGivesTheSameBytes) {
  SceneCache scenes;
  StimulusRenderer a(context(), patchStimulus(), kStimulusSize, studyDisplay(), &scenes);
  StimulusRenderer b(context(), patchStimulus(), kStimulusSize, studyDisplay(), &scenes);
  EXPECT_EQ(&a.scene(), &b.scene());
  b.render(11);  // order does not matter
  EXPECT_EQ(a.readBack(3).data, b.readBack(3).data);
}

TEST_F(StimulusRendererTest, AStaticSequenceHasTwoPicturesOfTheTimeOfTheChange) {
  Stimulus stimulus = patchStimulus();
  stimulus.presentation = Presentation::Static;
  stimulus.sceneStartS = 0.25;
  StimulusRenderer renderer(context(), stimulus, kStimulusSize, studyDisplay());
  ASSERT_EQ(renderer.pictureCount(), 2);
  EXPECT_EQ(renderer.pictureOf(5), 0);
  EXPECT_EQ(renderer.pictureOf(6), 1);
  for (const int frame : {0, 5, 6, 11})
    EXPECT_LE(largestError(renderer.readBack(frame), light(stimulus, 0.35, frame < 6 ? 1 : 0)), kRounding)
        << frame;
}

TEST_F(StimulusRendererTest, ACatchShowsOneLevel) {
  Stimulus stimulus = patchStimulus();
  stimulus.changes = false;
  for (const bool after : {false, true}) {
    stimulus.catchShowsAfter = after;
    StimulusRenderer renderer(context(), stimulus, kStimulusSize, studyDisplay());
    EXPECT_EQ(renderer.pictureCount(), 12);
    for (const int frame : {0, 6})
      EXPECT_LE(largestError(renderer.readBack(frame), light(stimulus, frame / 60.0, after ? 0 : 1)),
                kRounding);
  }
  stimulus.presentation = Presentation::Static;
  EXPECT_EQ(StimulusRenderer(context(), stimulus, kStimulusSize, studyDisplay()).pictureCount(), 1);
}

TEST_F(StimulusRendererTest, AStillCameraNeedsTwoPicturesOnly) {
  Stimulus stimulus = patchStimulus();
  stimulus.scene = sceneEntry("lod/patch", {{"distance", 4.0}, {"motion", "still"}});
  StimulusRenderer renderer(context(), stimulus, kStimulusSize, studyDisplay());
  EXPECT_EQ(renderer.pictureCount(), 2);
  EXPECT_EQ(renderer.firstFrameOf(1), 6);
}

TEST_F(StimulusRendererTest, RowZeroIsTheTop) {
  // Of terrain under a dark sky the lower rows are the brighter ones.
  Stimulus stimulus = patchStimulus();
  stimulus.scene = sceneEntry("lod/terrain", {});
  StimulusRenderer renderer(context(), stimulus, kStimulusSize, studyDisplay());
  const Image shown = renderer.readBack(0);
  double top = 0.0, bottom = 0.0;
  for (int x = 0; x < kStimulusSize.x; ++x) {
    top += shown.at(x, 0);
    bottom += shown.at(x, kStimulusSize.y - 1);
  }
  EXPECT_GT(bottom, 1.5 * top);
}

TEST_F(StimulusRendererTest, VisibilityModulatesTheDirectLightOnly) {
  Stimulus stimulus;
  stimulus.scene = sceneEntry("sphere_grid", {});
  stimulus.before = techniqueEntry("soft_shadows/hard");
  stimulus.durationS = 0.1;
  stimulus.changes = false;
  stimulus.samples = 1;
  StimulusRenderer renderer(context(), stimulus, kStimulusSize, studyDisplay());
  const Image shown = renderer.readBack(0);

  // Shares of the light apart: with ambient 0.2 and diffuse 0.8 the shadowed picture is a + v d.
  const frame::SceneOnGpu onGpu(sceneOf(stimulus));
  frame::Frame frame(context(), onGpu, kStimulusSize);
  const auto hard =
      techniques::TechniqueRegistry::instance().get("soft_shadows/hard").make(stimulus.before->values);
  hard->prepare(frame);
  frame.begin();
  hard->render(frame);
  const Image visibility = hard->product().read();
  frame::ShadedSetting ambient, direct;
  ambient.diffuse = 0.0;
  ambient.background = direct.background = 0.0;
  direct.ambient = 0.0;
  const Image a = frame.get<frame::Shaded>(ambient).texture().read(),
              d = frame.get<frame::Shaded>(direct).texture().read();
  const std::vector<uint32_t> ids = frame.get<frame::TriangleIds>().texture().readUint();
  frame.end();
  Image expected(kStimulusSize.x, kStimulusSize.y, 3, 0.05F);
  int shadowed = 0;
  for (size_t i = 0; i < expected.pixels(); ++i) {
    if (ids[i] == frame::TriangleIds::kNone) continue;
    for (size_t c = 0; c < 3; ++c)
      expected.data[3 * i + c] = a.data[4 * i + c] + visibility.data[i] * d.data[4 * i + c];
    if (visibility.data[i] < 0.5F && d.data[4 * i] > 0.05F) ++shadowed;
  }
  EXPECT_GT(shadowed, 20);
  EXPECT_LE(largestError(shown, expected), kRounding);
}

TEST_F(StimulusRendererTest, AColourTechniqueIsShownAsItIs) {
  Stimulus stimulus = patchStimulus();
  stimulus.levels.reset();
  stimulus.before = techniqueEntry("lod/finest", {{"samples", int64_t{1}}});
  stimulus.changes = false;
  StimulusRenderer renderer(context(), stimulus, kStimulusSize, studyDisplay());
  EXPECT_EQ(renderer.pictureCount(), 12);
  EXPECT_LE(largestError(renderer.readBack(4), light(stimulus, 4 / 60.0, 0)), kRounding);
}

TEST(StimulusLevels, OtherObjectsStandAsTheyAreAskedFor) {
  // Three objects of three levels at 4, 6 and 12 from an eye that comes nearer by 1 a second; they switch at
  // 5 and 10. Two seconds on they are at 2, 4 and 10.
  scene::Scene scene;
  scene::LodSet set;
  for (int i = 0; i < 3; ++i) set.levels.push_back({scene::sphere(glm::dvec3(0.0), 0.5, 2), 0.0, 0.0});
  for (const double z : {-4.0, -6.0, -12.0})
    scene::addLodObject(scene, set, {.position = {0.0, 0.0, z}}, {"ball", glm::vec3(0.5F)}, {5.0, 10.0});
  scene::Camera from, to;
  from.eye = {0.0, 0.0, 0.0};
  from.target = {0.0, 0.0, -100.0};
  to = from;
  to.eye.z = -10.0;
  scene.camera.keys = {{0.0, from}, {10.0, to}};
  const auto levels = [&](const char* others, bool after, double timeS) {
    return levelsOf(scene, {1, 2, 0, others}, after, timeS, 100).levels;
  };
  EXPECT_EQ(levels("finest", false, 0.0), (std::vector<int>{0, 2, 0}));
  EXPECT_EQ(levels("finest", true, 0.0), (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(levels("distance", false, 0.0), (std::vector<int>{0, 2, 2}));
  EXPECT_EQ(levels("distance", true, 0.0), (std::vector<int>{0, 0, 2}));
  EXPECT_EQ(levels("distance", true, 3.0), (std::vector<int>{0, 0, 1}));  // the last one at 9
  EXPECT_EQ(levels("omitted", true, 0.0), (std::vector<int>{-1, 0, -1}));
  EXPECT_THROW(levelsOf(scene, {3, 1, 0, "finest"}, true, 0.0, 100), Error);
  EXPECT_THROW(levelsOf(scene, {0, 1, 3, "finest"}, false, 0.0, 100), Error);
}

TEST(StimulusFiles, AFileThatChangedSinceIsRefused) {
  const std::string path =
      (std::filesystem::path(testing::TempDir()) / ("limen_mesh_" + std::to_string(getpid()) + ".obj"))
          .string();
  std::ofstream(path) << "v 0 0 0\n";
  NamedEntry entry;
  entry.values = ParameterValues({fileParameter("file", "")}, {{"file", path}});
  entry.fileHashes = {{"file", sha256("v 0 0 0\n")}};
  EXPECT_NO_THROW(checkFiles(entry, "scene"));
  std::ofstream(path) << "v 0 0 1\n";
  EXPECT_THROW(checkFiles(entry, "scene"), Error);
  std::filesystem::remove(path);
}

TEST_F(StimulusRendererTest, WhatCannotBeShownIsRefused) {
  const auto refused = [](Stimulus stimulus) {
    try {
      StimulusRenderer(context(), stimulus, kStimulusSize, studyDisplay());
    } catch (const Error& error) {
      return !error.hint().empty();
    }
    return false;
  };
  Stimulus stimulus = patchStimulus();
  stimulus.levels->after = 9;
  EXPECT_TRUE(refused(stimulus));
  stimulus = patchStimulus();
  stimulus.levels->object = 3;
  EXPECT_TRUE(refused(stimulus));
  stimulus = patchStimulus();
  stimulus.levels->others = "none";
  EXPECT_TRUE(refused(stimulus));
  stimulus = patchStimulus();
  stimulus.scene.version = 99;
  EXPECT_TRUE(refused(stimulus));
  stimulus = patchStimulus();
  stimulus.samples = 1000;
  EXPECT_TRUE(refused(stimulus));
  stimulus.samples = 0;
  EXPECT_TRUE(refused(stimulus));
  stimulus = patchStimulus();
  stimulus.levels.reset();
  EXPECT_TRUE(refused(stimulus));
  stimulus.before = techniqueEntry("popping/lod_switch");  // no picture
  EXPECT_TRUE(refused(stimulus));
  stimulus.before = techniqueEntry("lod/finest");
  stimulus.scene = sceneEntry("sphere_grid", {});  // no levels of detail
  EXPECT_TRUE(refused(stimulus));
}

}  // namespace
}  // namespace limen::study
