// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/frame_difference.h"

#include <algorithm>
#include <cmath>

#include "perception/metrics/color_video_vdp/reference.h"
#include "perception/vision/colour.h"
#include "study/stimulus/prediction.h"
#include "study/stimulus/stimulus_renderer.h"
#include "tests/study/stimulus/stimulus_fixture.h"

namespace limen::study {
namespace {

constexpr glm::ivec2 kSize{96, 72};

class FrameDifferenceTest : public gl::GlTest {};

TEST_F(FrameDifferenceTest, ErrorsOfThePicturesThatAreShown) {
  const Stimulus stimulus = patchStimulus();
  const FrameDifference difference = FrameComparer(context(), kSize, studyDisplay()).compare(stimulus);

  // The sequence's own frames, one on either side of the change, of a stimulus that does not move.
  Stimulus still = stimulus;
  still.presentation = Presentation::Static;
  StimulusRenderer renderer(context(), still, kSize, studyDisplay());
  const Image before = renderer.readBack(0), after = renderer.readBack(renderer.frameCount() - 1);
  double coded = 0.0, light = 0.0;
  for (size_t i = 0; i < before.data.size(); ++i) {
    coded += std::pow(double{after.data[i]} - double{before.data[i]}, 2.0);
    // IEC 61966-2-1, the display's transfer curve.
    const auto decode = [](double v) {
      return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    light += std::pow(decode(after.data[i]) - decode(before.data[i]), 2.0);
  }
  const auto count = static_cast<double>(before.data.size());
  ASSERT_GT(coded, 0.0);
  EXPECT_NEAR(difference.rmseCoded, std::sqrt(coded / count), 1e-6);
  EXPECT_NEAR(difference.rmse, std::sqrt(light / count), 1e-6);
  EXPECT_GT(difference.flip, 0.0);
  EXPECT_LT(difference.ssim, 1.0);
  // A mean is no larger than the largest, which the predictor's comparator finds by itself.
  const PredictedPopping popping = Predictor(context(), kSize, studyDisplay()).predict(stimulus);
  EXPECT_GT(difference.meanDe94, 0.0);
  EXPECT_LT(difference.meanDe94, popping.largestDe94);
}

TEST_F(FrameDifferenceTest, NothingWhereNothingChanges) {
  Stimulus stimulus = patchStimulus();
  stimulus.levels = LevelChange{0, 1, 1, "finest"};
  const FrameDifference difference = FrameComparer(context(), kSize, studyDisplay()).compare(stimulus);
  EXPECT_EQ(difference.rmse, 0.0);
  EXPECT_EQ(difference.rmseCoded, 0.0);
  EXPECT_EQ(difference.meanDe94, 0.0);
  EXPECT_EQ(difference.flip, 0.0);
  EXPECT_EQ(difference.ssim, 1.0);
  EXPECT_EQ(difference.colorVideoVdp, 0.0);
  EXPECT_FALSE(difference.colorVideoVdpClip);
}

// The clip is the sequence's own frames around the change; its reference, those of the same sequence without
// one.
TEST_F(FrameDifferenceTest, ColorVideoVdpOfPicturesAndClip) {
  for (const Presentation presentation : {Presentation::Static, Presentation::Dynamic}) {
    Stimulus stimulus = patchStimulus();
    stimulus.presentation = presentation;
    const FrameDifference difference =
        FrameComparer(context(), kSize, studyDisplay()).compare(stimulus, true);
    StimulusRenderer renderer(context(), stimulus, kSize, studyDisplay());
    const Timeline& timeline = renderer.timeline();
    const int reach = static_cast<int>(std::lround(0.25 * timeline.refreshHz));
    const int first = std::max(timeline.changed - reach, 0),
              end = std::min(timeline.changed + reach, timeline.frames);
    perception::cvvdp::Options options;
    options.display = perception::cvvdp::displayOf(studyDisplay());
    options.framesPerSecond = timeline.refreshHz;
    options.codeSteps = 255.0;  // what is sent to the display, in place of its light
    const perception::cvvdp::Pair pair = {
        kSize.x, kSize.y, end - first, [&](int i) { return renderer.readBack(first + i); },
        [&](int i) { return renderer.readBackState(timeline.sceneTimeS(first + i), false); }};
    ASSERT_TRUE(difference.colorVideoVdpClip);
    EXPECT_NEAR(*difference.colorVideoVdpClip, 10.0 - perception::cvvdp::evaluate(pair, options).score.jod,
                1e-4);
    EXPECT_GT(*difference.colorVideoVdpClip, 0.0);
    EXPECT_GT(difference.colorVideoVdp, 0.0);
  }
}

}  // namespace
}  // namespace limen::study
