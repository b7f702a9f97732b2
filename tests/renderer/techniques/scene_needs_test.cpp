// SPDX-License-Identifier: BSD-3-Clause
// Scenes that are known to need one thing each, and what is found for them. Times are given wherever the
// choice is tested, so that no machine's speed decides a test.
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "perception/metrics/metric.h"
#include "perception/metrics/metric_gpu.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/soft_shadows/scene_needs/shadow_candidates.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

/// Each candidate takes as long as its place in a list says.
class PlaceClock : public CandidateClock {
 public:
  explicit PlaceClock(const std::vector<Candidate>& list) {
    for (const Candidate& candidate : list) places_.push_back(describe(candidate));
  }
  std::vector<double> framesMs(const Candidate& candidate) override {
    const auto place = std::find(places_.begin(), places_.end(), describe(candidate));
    return std::vector<double>(3, 1.0 + double(place - places_.begin()));
  }
  std::string label() const override { return "places in a list"; }

 private:
  std::vector<std::string> places_;
};

class SceneNeedsTest : public TechniqueTest {
 protected:
  /// As given, with maps of `resolution`.
  static std::vector<Candidate> withResolution(std::vector<Candidate> list, int64_t resolution) {
    for (Candidate& candidate : list) candidate.given.emplace("resolution", resolution);
    return list;
  }
  /// From a hard shadow to 256 maps, in the order of their costs.
  static std::vector<Candidate> fewCandidates(int64_t resolution) {
    return withResolution({{"soft_shadows/hard", {}},
                           {"soft_shadows/pcss", {}},
                           {"soft_shadows/bitmask", {{"budget.limit", int64_t{64}}}},
                           {"soft_shadows/bitmask", {{"budget.limit", int64_t{1024}}}},
                           {"soft_shadows/sampled_light", {{"samples", int64_t{16}}}},
                           {"soft_shadows/sampled_light", {{"samples", int64_t{64}}}},
                           {"soft_shadows/sampled_light", {{"samples", int64_t{256}}}}},
                          resolution);
  }

  static SceneNeedsFound find(const scene::Scene& scene, const std::vector<Candidate>& candidates,
                              const NeedsOptions& options, glm::ivec2 sizePx = {64, 48}) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    PlaceClock clock(candidates);
    return findNeeds(frame, candidates, shadowSubject(), options, clock);
  }

  static void expectNothingBeats(const SceneNeedsFound& found) {
    for (const Tried& other : found.tried)
      EXPECT_FALSE(other.time.medianMs < found.chosen().time.medianMs &&
                   other.error.meanSquare < found.chosen().error.meanSquare)
          << describe(other.candidate);
  }
};

TEST_F(SceneNeedsTest, ALightSmallerThanATexelNeedsHardShadows) {
  // The half-plane's edge is thrown onto the line x = 0 of the ground, and from a light of 0.4 mm there is no
  // penumbra to speak of: a hard shadow is wrong by 1 at most within a texel of that line, and nowhere else.
  // If it were wrong there everywhere, its RMSE would be the square root of the share of these pixels.
  constexpr int kResolution = 1024;
  const scene::Scene scene = makeScene("half_plane", {{"light_size", 0.001}});
  const scene::AreaLight& light = scene.lights[0];
  const frame::LightFrustum frustum = frame::LightCasters(scene).fit(glm::dvec2(0.0), kResolution);
  const double texel = (frustum.high.x - frustum.low.x) / kResolution * light.centre.y + light.size.x;
  const Image receivers = render(scene, "soft_shadows/hard", {}, {64, 48}).receivers;
  const glm::dmat4 fromLight = glm::inverse(light.toLightSpace());
  double near = 0.0, all = 0.0;
  for (size_t i = 0; i < receivers.pixels(); ++i) {
    if (receivers.data[4 * i + 3] < 0.0F) continue;
    const glm::dvec3 world = fromLight * glm::dvec4(receivers.data[4 * i], receivers.data[4 * i + 1],
                                                    receivers.data[4 * i + 2], 1.0);
    all += 1.0;
    near += std::abs(world.x) <= texel ? 1.0 : 0.0;
  }
  ASSERT_GT(near, 10.0);
  ASSERT_LT(near, 0.05 * all);
  // Twice that leaves room for what the choice of pixels must not exceed.
  const double target = 2.0 * std::sqrt(near / all);
  const SceneNeedsFound found = find(scene, fewCandidates(kResolution), {.target = RmseTarget{target}});
  EXPECT_EQ(found.chosen().candidate.technique, "soft_shadows/hard");
  EXPECT_TRUE(found.verdict.withinTarget);
  EXPECT_LE(found.check.error.value(), 0.5 * target);
}

TEST_F(SceneNeedsTest, WhatTheLightsCentreDoesNotSeeNeedsManyMaps) {
  // A high box under a large light: its sides throw shadows that the light sees from its rim alone, so that
  // no technique over the centre's map has them at any budget. A regular grid of n x n maps errs by less than
  // 2 / n wherever one straight edge crosses the light, 0.125 for 16 x 16.
  const scene::Scene scene = makeScene("box_under_light", {{"box_height", 2.0}, {"light_size", 1.5}});
  const std::vector<Candidate> candidates = fewCandidates(256);
  const SceneNeedsFound found = find(scene, candidates, {.target = RmseTarget{0.02}});
  EXPECT_EQ(found.chosen().candidate.technique, "soft_shadows/sampled_light");
  EXPECT_TRUE(found.verdict.withinTarget);
  EXPECT_LE(found.check.error.value(), 0.125);
  for (const Tried& one : found.tried) {
    if (one.candidate.technique == "soft_shadows/sampled_light") continue;
    EXPECT_GT(one.error.low(), 0.02) << describe(one.candidate);
  }
  expectNothingBeats(found);
}

TEST_F(SceneNeedsTest, WithoutACandidateWithinTheTargetTheMostExactIsTaken) {
  const scene::Scene scene = makeScene("box_under_light", {{"box_height", 2.0}, {"light_size", 1.5}});
  const SceneNeedsFound found = find(scene, fewCandidates(256), {.target = RmseTarget{1e-6}});
  EXPECT_FALSE(found.verdict.withinTarget);
  for (const Tried& one : found.tried)
    EXPECT_LE(found.chosen().error.value(), one.error.value() + found.chosen().error.noise());
  expectNothingBeats(found);
}

TEST_F(SceneNeedsTest, WithinAJndIsWhatTheMetricSaysOfTheRunAtFullSize) {
  // The target's figure is that of the metric `jnd`, asked here as a sweep asks it: of the technique's own
  // product, with the shaded frame's surfaces, against rays of another seed.
  const scene::Scene scene = makeScene("two_boxes");
  const std::vector<Candidate> candidates = fewCandidates(256);
  const NeedsReference rays{.samples = 1024, .checkSamples = 1024};
  const glm::ivec2 size(96, 72);
  const SceneNeedsFound found =
      find(scene, candidates, {.target = JndTarget{.value = 2.0}, .reference = rays}, size);
  EXPECT_EQ(found.pictureSizePx, size);
  expectNothingBeats(found);
  const auto p95 = [&](const Candidate& candidate) {
    const Rendered test = render(scene, candidate.technique, candidate.given, size);
    const Rendered truth =
        render(scene, "soft_shadows/ray_traced", {{"samples", int64_t{4096}}, {"seed", int64_t{9}}}, size);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, size);
    frame::ShadedSetting albedo, direct;
    albedo.ambient = 1.0, albedo.diffuse = 0.0, albedo.background = -1.0;
    direct.ambient = 0.0, direct.diffuse = 1.0, direct.background = 0.0;
    frame.begin();
    const perception::LitSurfaces surfaces{&frame.get<frame::Shaded>(albedo).texture(),
                                           &frame.get<frame::Shaded>(direct).texture()};
    frame.end();
    Image mask(size.x, size.y, 1);
    for (size_t i = 0; i < mask.pixels(); ++i)
      mask.data[i] = test.receivers.data[4 * i + 3] >= 0.0F ? 1.0F : 0.0F;
    perception::MetricGpu gpu(context());
    perception::ComparisonInput input;
    input.test = &test.product, input.reference = &truth.product, input.mask = &mask;
    input.gpu = &gpu, input.surfaces = &surfaces, input.depicts = perception::Depicts::ShareOfLight;
    const perception::MetricInfo& metric = perception::MetricRegistry::instance().get("jnd");
    return metric.compare(input, ParameterValues(metric.parameters, {})).value;
  };
  ASSERT_TRUE(found.verdict.withinTarget);
  for (const Tried& one : found.tried)
    // Each figure's own noise is half of what is seen between two references of 1,024 rays.
    EXPECT_NEAR(one.error.value(), p95(one.candidate), found.referenceNoise) << describe(one.candidate);
  EXPECT_LE(found.chosen().error.value(), 2.0);
  // Times are places: all cheaper ones are seen.
  for (const Tried& one : found.tried)
    if (one.time.medianMs < found.chosen().time.medianMs) {
      EXPECT_GT(one.error.value(), 2.0) << describe(one.candidate);
    }
}

TEST_F(SceneNeedsTest, AFartherViewerNeedsNoMore) {
  // From twice as far edges subtend half the angle; what is chosen there takes no more time.
  const scene::Scene scene = makeScene("two_boxes");
  const auto chosenAt = [&](double distanceM) {
    JndTarget target{.value = 1.0};
    target.viewing.display = {"desktop_24", ParameterValues(perception::PresetViewing::table().parameters(),
                                                            {{"distance_m", distanceM}})};
    return find(scene, fewCandidates(256), {.target = target, .reference = {.samples = 1024}}, {96, 72})
        .chosen()
        .time.medianMs;
  };
  EXPECT_LE(chosenAt(8.0), chosenAt(0.6));
}

TEST_F(SceneNeedsTest, FrondsGetNothingThatAnotherCandidateBeats) {
  const scene::Scene scene = makeScene("palm");
  const std::vector<Candidate> candidates = fewCandidates(256);
  for (const double target : {0.1, 0.02}) {
    const SceneNeedsFound found = find(scene, candidates, {.target = RmseTarget{target}});
    expectNothingBeats(found);
    if (found.verdict.withinTarget) {
      EXPECT_LE(found.chosen().error.value(), target);
      // Times are places: all that come before are not exact enough.
      for (const Tried& one : found.tried) {
        if (one.time.medianMs >= found.chosen().time.medianMs) continue;
        EXPECT_GT(one.error.value() * (1.0 + margin(found.tried)), target) << describe(one.candidate);
      }
    }
  }
}

TEST_F(SceneNeedsTest, TheSmallPictureForetellsTheErrorAtFullSize) {
  // Limits are two standard errors; four hold in all but one of 10,000 cases if errors are independent of
  // their neighbours', as those of pixels are that lie several texels apart.
  for (const char* name : {"sphere_grid", "foliage"})
    for (const char* technique : {"soft_shadows/hard", "soft_shadows/pcss", "soft_shadows/bitmask"}) {
      const SceneNeedsFound found = find(makeScene(name), withResolution({{technique, {}}}, 256),
                                         {.picturePx = 3072, .reference = {64, 16}}, {256, 192});
      EXPECT_EQ(found.pictureSizePx, glm::ivec2(64, 48));
      const ErrorEstimate &small = found.chosen().error, &full = found.check.error;
      EXPECT_NEAR(full.meanSquare, small.meanSquare,
                  4.0 * std::hypot(small.standardError, full.standardError))
          << name << ", " << technique;
    }
}

TEST_F(SceneNeedsTest, ThePictureIsNotLargerThanTheFrame) {
  const SceneNeedsFound found = find(makeScene("two_boxes"), withResolution({{"soft_shadows/hard", {}}}, 256),
                                     {.picturePx = 1 << 24}, {40, 30});
  EXPECT_EQ(found.pictureSizePx, glm::ivec2(40, 30));
}

TEST_F(SceneNeedsTest, EveryTechniqueTakesItsBuiltInSettings) {
  const scene::Scene scene = makeScene("two_boxes");
  const std::vector<Candidate> candidates = builtInCandidates({});
  EXPECT_GE(candidates.size(), 40U);
  for (const Candidate& candidate : candidates)
    EXPECT_EQ(obstacleTo(candidate, scene), "") << describe(candidate);
}

TEST_F(SceneNeedsTest, BuiltInCandidatesDiffer) {
  std::set<std::string> seen;
  for (const Candidate& candidate : builtInCandidates({}))
    EXPECT_TRUE(seen.insert(describe(candidate)).second) << describe(candidate);
}

TEST_F(SceneNeedsTest, WhatASceneDoesNotAllowIsLeftOutWithTheReason) {
  const std::vector<Candidate> candidates =
      withResolution({{"soft_shadows/hard", {}}, {"soft_shadows/backprojection", {}}}, 256);
  const SceneNeedsFound found =
      find(makeScene("parallel_rectangle", {{"light_shape", std::string("disc")}}), candidates, {});
  EXPECT_EQ(found.tried.size(), 1U);
  EXPECT_THAT(found.notTried,
              Contains(AllOf(StartsWith("soft_shadows/backprojection"), HasSubstr("rectangular_light"))));
}

TEST_F(SceneNeedsTest, WhenTimeIsUpTheRestIsLeftOut) {
  const std::vector<Candidate> candidates = fewCandidates(256);
  const SceneNeedsFound found = find(makeScene("two_boxes"), candidates, {.seconds = 0.0});
  ASSERT_EQ(found.tried.size(), 1U);
  EXPECT_EQ(describe(found.chosen().candidate), describe(candidates.front()));
  EXPECT_EQ(found.notTried.size(), candidates.size() - 1);
  EXPECT_THAT(found.notTried, testing::Each(HasSubstr("no time was left")));
}

TEST_F(SceneNeedsTest, WithoutCandidatesItIsAnError) {
  EXPECT_THROW(find(makeScene("two_boxes"), {{"soft_shadows/hard", {{"resolution", int64_t{3}}}}}, {}),
               Error);
}

class CandidateFiles : public SceneNeedsTest {
 protected:
  void SetUp() override {
    SceneNeedsTest::SetUp();
    path_ =
        (std::filesystem::temp_directory_path() / ("limen_candidates_" + std::to_string(getpid()) + ".yaml"))
            .string();
  }
  void TearDown() override {
    std::filesystem::remove(path_);
    SceneNeedsTest::TearDown();
  }
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  std::string problemsOf(const std::string& text) const {
    write(text);
    try {
      readCandidates(path_, {});
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }

  std::string path_;
};

TEST_F(CandidateFiles, ListsAreAxes) {
  write(
      "- {name: soft_shadows/hard}\n"
      "- {name: soft_shadows/bitmask, budget: [64, 256], structure: [hsm, ysm], resolution: 512}\n");
  const std::vector<Candidate> candidates = readCandidates(path_, {.resolution = 256});
  ASSERT_EQ(candidates.size(), 5U);
  EXPECT_EQ(describe(candidates[0]), "soft_shadows/hard, resolution=256");
  EXPECT_EQ(describe(candidates[2]), "soft_shadows/bitmask, budget.limit=64, resolution=512, structure=ysm");
}

TEST_F(CandidateFiles, MistakesAreNamedWithTheirPlace) {
  EXPECT_THAT(problemsOf("- {name: soft_shadows/bitmusk}\n"),
              AllOf(HasSubstr(path_ + ":1"), HasSubstr("soft_shadows/bitmask")));
  EXPECT_THAT(problemsOf("- {name: soft_shadows/hard}\n- {name: soft_shadows/pcss, filter_tops: 4}\n"),
              AllOf(HasSubstr(path_ + ":2"), HasSubstr("filter_taps")));
  EXPECT_THAT(problemsOf("- {name: soft_shadows/scene_needs}\n"), HasSubstr("is no candidate"));
  EXPECT_THAT(problemsOf("- {name: perception/threshold_map}\n"), HasSubstr("is no candidate"));
  EXPECT_THAT(problemsOf("name: soft_shadows/hard\n"), HasSubstr("list of candidates"));
}

TEST_F(CandidateFiles, TheTechniqueShowsWhatItChoseAndPutsItOnRecord) {
  write(
      "- {name: soft_shadows/hard, resolution: 256}\n"
      "- {name: soft_shadows/pcss, resolution: 256}\n");
  const scene::Scene scene = makeScene("sphere_grid");
  const TechniqueInfo& info = TechniqueRegistry::instance().get("soft_shadows/scene_needs");
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {64, 48});
  const auto made = info.make(ParameterValues(info.parameters, {{"target.value", 0.04},
                                                                {"candidates", std::string("file")},
                                                                {"candidates.file", path_},
                                                                {"timing.frames", int64_t{3}}}));
  made->prepare(frame);
  frame.begin();
  made->render(frame);
  const Image product = made->product().read();
  frame.end();
  const std::vector<std::string> remarks = made->remarks();
  ASSERT_THAT(remarks.at(0), StartsWith("chosen: soft_shadows/"));
  const std::string chosen = remarks[0].substr(8, remarks[0].find(',') - 8);
  const Rendered alone = render(scene, chosen, {{"resolution", int64_t{256}}}, {64, 48});
  EXPECT_EQ(product.data, alone.product.data);
  EXPECT_THAT(remarks, Contains(StartsWith("at full size: ")));
  const std::vector<Counter> counters = made->count(frame);
  for (const Counter& counter : counters)
    EXPECT_THAT(info.counters, Contains(testing::Field(&Quantity::name, counter.name)));
  EXPECT_THAT(counters, Contains(testing::Field(&Counter::name, "check_rmse")));
  EXPECT_EQ(made->pictures().at("check_error")().width, 64);
}

TEST_F(CandidateFiles, EveryCornerOfItsParametersIsFinite) {
  write("- {name: soft_shadows/hard}\n- {name: soft_shadows/pcss}\n");
  const scene::Scene scene = makeScene("degenerate_soup", {{"light_size", 3.0}});
  const Given few = {{"candidates", std::string("file")},
                     {"candidates.file", path_},
                     {"resolution", int64_t{64}},
                     {"reference.samples", int64_t{16}},
                     {"reference.check_samples", int64_t{16}},
                     {"timing.warmup", int64_t{1}},
                     {"timing.frames", int64_t{1}}};
  for (const Given& corner :
       {Given{{"target.value", 0.0}}, Given{{"target.value", 1.0}}, Given{{"picture_px", int64_t{64}}},
        Given{{"picture_px", int64_t{1 << 24}}}, Given{{"reference.samples", int64_t{4096}}},
        Given{{"reference.check_samples", int64_t{4096}}}, Given{{"timing.frames", int64_t{1024}}},
        Given{{"timing.warmup", int64_t{256}}}, Given{{"resolution", int64_t{1}}}}) {
    Given given = corner;
    given.insert(few.begin(), few.end());
    const Rendered rendered = render(scene, "soft_shadows/scene_needs", given, {24, 18}, true);
    for (const float value : rendered.product.data)
      ASSERT_TRUE(value >= 0.0F && value <= 1.0F) << corner.begin()->first << ": " << value;
    for (const Counter& counter : rendered.counters)
      EXPECT_TRUE(std::isfinite(counter.value)) << counter.name;
  }
}

TEST_F(SceneNeedsTest, NoShadowInViewIsNoReasonToFail) {
  scene::Scene scene = makeScene("two_boxes");
  scene::Camera camera;
  camera.eye = {0.0, 50.0, 0.0};
  camera.target = {0.0, 100.0, 0.001};
  scene.camera.keys = {{0.0, camera}};
  const SceneNeedsFound found = find(scene, fewCandidates(256), {});
  EXPECT_TRUE(found.verdict.withinTarget);
  EXPECT_EQ(found.chosen().candidate.technique, "soft_shadows/hard");
}

}  // namespace
}  // namespace limen::techniques
