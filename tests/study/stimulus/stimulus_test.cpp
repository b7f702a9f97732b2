// SPDX-License-Identifier: BSD-3-Clause
// Stimuli as data: their canonical form, and which frame of a sequence shows what.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "study/stimulus/display_coding.h"
#include "study/stimulus/timeline.h"
#include "tests/experiments/base/declare.h"
#include "tests/study/stimulus/stimulus_fixture.h"

namespace limen::study {
namespace {

TEST(StimulusForm, ReadsBackFromText) {
  Stimulus stimulus = patchStimulus();
  stimulus.cue = {Cue::Kind::Circle, 10.5, 20.0, 50.0, 2.0};
  stimulus.presentation = Presentation::Static;
  stimulus.shading = ParameterValues({realParameter("ambient", 1.0, 0.0, 1.0, "", "")}, {});
  const nlohmann::json form = toJson(stimulus);
  const Stimulus back = stimulusFromJson(nlohmann::json::parse(form.dump()));
  EXPECT_EQ(toJson(back), form);
  EXPECT_EQ(stimulusHash(back), stimulusHash(stimulus));
  // A real value that happens to be whole stays one.
  EXPECT_EQ(realOf(back.shading, "ambient"), 1.0);
  EXPECT_EQ(back.scene.values.all(), stimulus.scene.values.all());
  EXPECT_EQ(back.levels->after, 0);
  EXPECT_EQ(back.cue.xPx, 10.5);
}

TEST(StimulusForm, HashTellsEveryFieldApart) {
  const Stimulus base = patchStimulus();
  std::vector<Stimulus> others(15, base);
  others[0].scene.version += 1;
  others[1].levels->before = 2;
  others[2].changes = false;
  others[3].catchShowsAfter = true;
  others[4].presentation = Presentation::Static;
  others[5].durationS = 0.3;
  others[6].changeAtS = 0.15;
  others[7].sceneStartS = 0.5;
  others[8].showings = 2;
  others[9].gapS = 2.0;
  others[10].samples = 1;
  others[11].cue.kind = Cue::Kind::Arrow;
  others[12].levels->others = "omitted";
  others[13].scene = sceneEntry("lod/patch", {{"distance", 4.5}});
  others[14].levels.reset();
  std::set<std::string> hashes = {stimulusHash(base)};
  for (const Stimulus& other : others) hashes.insert(stimulusHash(other));
  EXPECT_EQ(hashes.size(), others.size() + 1);
}

TEST(StimulusForm, HashGoesByTheContentOfFilesAndNotTheirPlace) {
  Stimulus here = patchStimulus();
  here.scene.values = ParameterValues({fileParameter("file", "")}, {{"file", std::string("/here/mesh.obj")}});
  here.scene.fileHashes = {{"file", std::string(64, 'a')}};
  Stimulus there = here, edited = here;
  there.scene.values = ParameterValues({fileParameter("file", "")}, {{"file", std::string("/there/m.obj")}});
  edited.scene.fileHashes["file"][0] = 'b';
  EXPECT_EQ(stimulusHash(there), stimulusHash(here));
  EXPECT_NE(toJson(there), toJson(here));
  EXPECT_NE(stimulusHash(edited), stimulusHash(here));
  EXPECT_EQ(stimulusFromJson(toJson(here)).scene.fileHashes, here.scene.fileHashes);
}

TEST(StimulusForm, DamagedTextIsRefused) {
  nlohmann::json form = toJson(patchStimulus());
  form.erase("gap_s");
  EXPECT_THROW(stimulusFromJson(form), Error);
  form = toJson(patchStimulus());
  form["cue"]["kind"] = "star";
  EXPECT_THROW(stimulusFromJson(form), Error);
  EXPECT_THROW(stimulusFromJson("text"), Error);
}

TEST(Timeline, ChangesAtTheFirstFrameThatIsNotBefore) {
  struct Case {
    double durationS, changeAtS, refreshHz;
    int frames, changed;
  };
  // By hand: frames = least n with n / f >= duration, changed = least k with k / f >= change. In binary 0.1 *
  // 60 is a little more than 6 and 0.7 * 60 less than 42: neither may cost a frame.
  for (const Case& c :
       {Case{4.5, 2.25, 60.0, 270, 135}, Case{0.2, 0.1, 60.0, 12, 6}, Case{1.4, 0.7, 60.0, 84, 42},
        Case{1.0, 0.5, 59.94, 60, 30},  // 59.94 -> 60; 29.97 -> 30, at 0.5005 s
        Case{1.0, 0.51, 60.0, 60, 31},  // 30.6 -> 31, at 0.5167 s
        Case{4.0, 2.0, 144.0, 576, 288},
        Case{1.0, 0.016667, 60.0, 60, 1},  // 1/60 s in six decimals, a little late
        Case{0.3, 0.1, 30.0, 9, 3}}) {
    Stimulus stimulus = patchStimulus();
    stimulus.durationS = c.durationS;
    stimulus.changeAtS = c.changeAtS;
    const Timeline line = timelineOf(stimulus, c.refreshHz);
    EXPECT_EQ(line.frames, c.frames) << c.durationS << " s at " << c.refreshHz;
    EXPECT_EQ(line.changed, c.changed) << c.changeAtS << " s at " << c.refreshHz;
    EXPECT_FALSE(line.showsAfter(c.changed - 1));
    EXPECT_TRUE(line.showsAfter(c.changed));
  }
  // Whole frames at any rate come out as themselves.
  for (const double hz : {50.0, 59.94, 60.0, 75.0, 119.88, 143.86})
    for (int frames = 1; frames < 2000; ++frames) EXPECT_EQ(framesFor(frames / hz, hz), frames);
}

TEST(Timeline, TimeRunsFromFrameToFrameOrRestsAtTheChange) {
  Stimulus stimulus = patchStimulus();
  stimulus.sceneStartS = 1.5;
  EXPECT_DOUBLE_EQ(timelineOf(stimulus, 60.0).sceneTimeS(0), 1.5);
  EXPECT_DOUBLE_EQ(timelineOf(stimulus, 60.0).sceneTimeS(9), 1.65);
  stimulus.presentation = Presentation::Static;
  EXPECT_DOUBLE_EQ(timelineOf(stimulus, 60.0).sceneTimeS(0), 1.6);
  EXPECT_DOUBLE_EQ(timelineOf(stimulus, 60.0).sceneTimeS(11), 1.6);
}

TEST(Timeline, ACatchNeverChanges) {
  Stimulus stimulus = patchStimulus();
  stimulus.changes = false;
  for (const bool after : {false, true}) {
    stimulus.catchShowsAfter = after;
    const Timeline line = timelineOf(stimulus, 60.0);
    EXPECT_EQ(line.frames, 12);
    for (int frame = 0; frame < line.frames; ++frame) EXPECT_EQ(line.showsAfter(frame), after);
  }
}

TEST(Timeline, AChangeWithoutAFrameBeforeOrAfterIsRefused) {
  Stimulus stimulus = patchStimulus();
  for (const double at : {0.0, 0.2, 0.19, 7.0, -1.0}) {
    stimulus.changeAtS = at;
    EXPECT_THROW(timelineOf(stimulus, 60.0), Error) << at;
  }
  stimulus.changeAtS = 0.1;
  stimulus.durationS = 0.0;
  EXPECT_THROW(timelineOf(stimulus, 60.0), Error);
}

TEST(DisplayCoding, TakesTheNearestCodeOfTheCurve) {
  for (const perception::TransferCurve curve :
       {perception::TransferCurve::Srgb, perception::TransferCurve::Gamma}) {
    perception::DisplayProfile display = studyDisplay();
    display.transfer = curve;
    display.gamma = 2.4;
    for (int i = 0; i <= 5000; ++i) {
      const double light = i / 5000.0;
      // The curves the other way round, in closed form: IEC 61966-2-1, and the power law.
      const double value = curve == perception::TransferCurve::Gamma ? std::pow(light, 1.0 / 2.4)
                           : light <= 0.0031308                      ? 12.92 * light
                                                : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
      // Half a code, and what single precision moves a threshold by.
      EXPECT_LE(std::abs(displayCode(display, light) - 255.0 * value), 0.5 + 1e-3) << light;
    }
    EXPECT_EQ(displayCode(display, -1.0), 0);
    EXPECT_EQ(displayCode(display, std::nan("")), 0);
    EXPECT_EQ(displayCode(display, 1e9), 255);
  }
}

}  // namespace
}  // namespace limen::study
