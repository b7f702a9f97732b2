// SPDX-License-Identifier: BSD-3-Clause
// What a scene's mirrors need, as a technique. Times are given wherever a choice by measurement is tested, so
// that no machine's speed decides a test.
#include <gmock/gmock.h>

#include <fstream>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/techniques/reflections/moving_mirrors.h"
#include "renderer/techniques/reflections/scene_needs/mirror_choice.h"
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

constexpr glm::ivec2 kNeedsSize(48, 36);

/// Each candidate takes as long as its place in a list says; the first is the most expensive.
class GivenTimes : public CandidateClock {
 public:
  explicit GivenTimes(const std::vector<Candidate>& list) {
    for (const Candidate& candidate : list) names_.push_back(describe(candidate));
  }
  std::vector<double> framesMs(const Candidate& candidate) override {
    const auto place = std::find(names_.begin(), names_.end(), describe(candidate)) - names_.begin();
    return std::vector<double>(3, 100.0 - double(place));
  }
  std::string label() const override { return "places in a list"; }

 private:
  std::vector<std::string> names_;
};

class ReflectionNeedsTest : public ReflectionTest {
 protected:
  static std::vector<Candidate> fewReflections() {
    return {{"reflections/ray_hierarchy", {}},
            {"reflections/ray_traced", {}},
            {"reflections/environment_map", {{"lookup", std::string("depth")}, {"resolution", int64_t{128}}}},
            {"reflections/environment_map", {{"resolution", int64_t{64}}}},
            {"reflections/planar_mirror", {{"planes", int64_t{1}}}},
            {"reflections/no_such_technique", {}}};
  }
  /// RMS over the pixels that see mirrors and three channels, of its own pictures.
  static double rmseOf(const scene::Scene& scene, const Candidate& candidate, glm::ivec2 sizePx) {
    const Image test = render(scene, candidate.technique, candidate.given, sizePx).product;
    const Image truth = render(scene, "reflections/reference", {}, sizePx).product;
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    frame.begin();
    const Image rays = frame.get<frame::MirrorRays>().origins().read();
    frame.end();
    double sum = 0.0, count = 0.0;
    for (int y = 0; y < sizePx.y; ++y)
      for (int x = 0; x < sizePx.x; ++x) {
        if (rays.at(x, y, 3) <= 0.0F) continue;
        for (int c = 0; c < 3; ++c) {
          sum += std::pow(double(test.at(x, y, c)) - truth.at(x, y, c), 2.0);
          count += 1.0;
        }
      }
    return std::sqrt(sum / count);
  }
  struct Ran {
    Image product;
    std::vector<std::string> remarks;
    std::vector<Counter> counters;
    double counter(const std::string& name) const {
      for (const Counter& one : counters)
        if (one.name == name) return one.value;
      ADD_FAILURE() << "no counter " << name;
      return 0.0;
    }
  };
  static Ran runOn(const scene::Scene& scene, Given given) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get("reflections/scene_needs");
    given.emplace("timing.warmup", int64_t{1});
    given.emplace("timing.frames", int64_t{2});
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, kNeedsSize);
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    Ran out{made->product().read(), made->remarks(), {}};
    frame.end();
    out.counters = made->count(frame);
    for (const Counter& counter : out.counters) {
      EXPECT_THAT(info.counters, Contains(testing::Field(&Quantity::name, counter.name)));
      EXPECT_TRUE(std::isfinite(counter.value)) << counter.name;
    }
    return out;
  }
};

TEST_F(ReflectionNeedsTest, TheChoiceIsTheCheapestOfItsOwnTableWithinTheTarget) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{12}}});
  const std::vector<Candidate> candidates = fewReflections();
  for (const double target : {1.0, 0.25, 0.02, 0.0}) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, kNeedsSize);
    GivenTimes clock(candidates);
    const SceneNeedsFound found =
        findNeeds(frame, candidates, reflectionSubject(false, {}), {.target = RmseTarget{target}}, clock);
    ASSERT_EQ(found.tried.size(), candidates.size() - 1);
    EXPECT_THAT(found.notTried, Contains(StartsWith("reflections/no_such_technique")));
    // The table's errors, rendered and compared anew: sums of the same squares in another order.
    for (const Tried& one : found.tried)
      EXPECT_NEAR(one.error.value(), rmseOf(scene, one.candidate, kNeedsSize), 1e-9)
          << describe(one.candidate);
    // The argument of the least time among those within the target, or of the least error if there is none.
    // What a small picture's choice of pixels may hide is allowed for in the same share for all.
    std::vector<double> shares;
    for (const Tried& one : found.tried)
      if (one.error.value() > 0.0)
        shares.push_back(std::sqrt(one.error.meanSquare + 2.0 * one.error.standardError) / one.error.value() -
                         1.0);
    std::sort(shares.begin(), shares.end());
    const size_t half = shares.size() / 2;
    const double margin = shares.size() % 2 == 1 ? shares[half] : 0.5 * (shares[half - 1] + shares[half]);
    const Tried *cheapest = nullptr, *mostExact = nullptr;
    for (const Tried& one : found.tried) {
      if (one.error.value() * (1.0 + margin) <= target &&
          (!cheapest || one.time.medianMs < cheapest->time.medianMs))
        cheapest = &one;
      // Of equal errors, the cheaper.
      if (!mostExact || std::pair(one.error.value(), one.time.medianMs) <
                            std::pair(mostExact->error.value(), mostExact->time.medianMs))
        mostExact = &one;
    }
    EXPECT_EQ(found.verdict.withinTarget, cheapest != nullptr);
    EXPECT_EQ(describe(found.chosen().candidate), describe((cheapest ? cheapest : mostExact)->candidate))
        << target;
  }
}

TEST_F(ReflectionNeedsTest, RegretIsTheDistanceFromTheBestOfTheWholeSet) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{12}}});
  const std::vector<Candidate> candidates = fewReflections();
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, kNeedsSize);
  GivenTimes clock(candidates);
  const Candidate choice = candidates[3];  // a map at infinity, at 97 ms
  const WholeSetCheck check = checkWholeSet(frame, choice, candidates, reflectionSubject(false, {}),
                                            {.target = RmseTarget{0.02}}, clock);
  // Only rays are within 0.02 of rays: the tracer, 99 ms, and the hierarchy, 100 ms.
  EXPECT_EQ(check.tried[check.best.chosen].candidate.technique, "reflections/ray_traced");
  EXPECT_EQ(describe(check.tried[check.choice].candidate), describe(choice));
  EXPECT_DOUBLE_EQ(check.regretMs(), 97.0 - 99.0);
  EXPECT_NEAR(check.regretError(),
              rmseOf(scene, choice, kNeedsSize) - rmseOf(scene, candidates[1], kNeedsSize), 1e-9);
  EXPECT_EQ(check.tried.size(), 5U);
}

TEST_F(ReflectionNeedsTest, TheRulesChoiceIsShownAndItsReasonsAreOnRecord) {
  const scene::Scene planes = makeScene("mirrors/planes", {{"planes", int64_t{2}}});
  const Ran ran = runOn(planes, {{"check", std::string("none")}});
  EXPECT_EQ(ran.product.data,
            render(planes, "reflections/planar_mirror", {{"planes", int64_t{2}}}, kNeedsSize).product.data);
  EXPECT_EQ(ran.remarks.at(0), "chosen: reflections/planar_mirror, planes=2");
  EXPECT_THAT(ran.remarks, Contains(AllOf(StartsWith("mirror '"), HasSubstr("a plane"))).Times(2));
  EXPECT_EQ(ran.counter("reflectors"), 2.0);

  const scene::Scene ball = makeScene("mirrors/ball", {{"tessellation", int64_t{12}}});
  EXPECT_EQ(runOn(ball, {{"check", std::string("none")}}).remarks.at(0), "chosen: reflections/ray_traced");
  const Ran moving = runOn(ball, {{"check", std::string("none")}, {"motion", std::string("moving")}});
  EXPECT_THAT(moving.remarks.at(0),
              StartsWith("chosen: reflections/vertex_reflection, surroundings=environment"));
  EXPECT_THAT(moving.remarks, Contains(HasSubstr("in a scene that moves")));
}

TEST_F(ReflectionNeedsTest, TheCheckSaysWhatAComparisonWouldSay) {
  const scene::Scene ball = makeScene("mirrors/ball", {{"tessellation", int64_t{12}}});
  const Ran ran = runOn(ball, {{"motion", std::string("moving")}, {"target.value", 0.001}});
  const Candidate vertices{"reflections/vertex_reflection", {{"surroundings", std::string("environment")}}};
  EXPECT_NEAR(ran.counter("check_rmse"), rmseOf(ball, vertices, kNeedsSize), 1e-9);
  EXPECT_EQ(ran.counter("target_met"), 0.0);
  EXPECT_THAT(ran.remarks, Contains(AllOf(StartsWith("at full size: "), HasSubstr("the target is missed"))));
}

TEST_F(ReflectionNeedsTest, WhatIsCommonGoesToTheChoice) {
  const scene::Scene planes = makeScene("mirrors/planes", {{"planes", int64_t{2}}});
  const Ran ran =
      runOn(planes, {{"check", std::string("choice")}, {"bounces", int64_t{2}}, {"shading.ambient", 0.4}});
  const Given same = {{"planes", int64_t{2}}, {"bounces", int64_t{2}}, {"shading.ambient", 0.4}};
  EXPECT_EQ(ran.product.data, render(planes, "reflections/planar_mirror", same, kNeedsSize).product.data);
  // Planar mirrors are exact on planes, so this fails unless the reference follows two mirrors as well:
  // pixels at edges alone differ, no more than 2 % of them, by no more than 1.
  EXPECT_LT(ran.counter("check_rmse"), std::sqrt(0.02));
}

TEST_F(ReflectionNeedsTest, EveryBuiltInCandidateThatIsThereTakesItsSettings) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{12}}});
  std::set<std::string> names;
  int there = 0;
  for (const Candidate& candidate : builtInReflections(0.1, {})) {
    EXPECT_TRUE(names.insert(describe(candidate)).second) << describe(candidate);
    if (!TechniqueRegistry::instance().find(candidate.technique)) continue;
    ++there;
    EXPECT_EQ(obstacleTo(candidate, scene), "") << describe(candidate);
  }
  EXPECT_GE(there, 14);
  for (const Candidate& candidate : builtInReflections(0.0, {}))
    EXPECT_FALSE(candidate.given.count("prefilter")) << "filtered for mirrors that are not glossy";
}

TEST_F(ReflectionNeedsTest, GlossIsComparedWithASampledReference) {
  const NeedsSubject subject = reflectionSubject(true, {});
  EXPECT_FALSE(subject.exact);
  EXPECT_EQ(subject.reference(16, 5).technique, "reflections/distribution_traced");
  // The mean cosine of a cone of 1 rad is (1 + cos 1) / 2 = 0.770, of cos^n (n + 1) / (n + 2).
  const double n = lobeExponent(1.0);
  EXPECT_NEAR((n + 1.0) / (n + 2.0), 0.5 * (1.0 + std::cos(1.0)), 1e-12);
  EXPECT_EQ(lobeExponent(0.0), 1000.0);
  EXPECT_EQ(lobeExponent(3.0), 1.0);
}

// Of the pane, the egg and the figure each has what the rule says of its kind; the joined picture shows each
// as a frame of its technique alone does, which shows all mirrors.
TEST_F(ReflectionNeedsTest, EachMirrorIsShownByItsOwnTechnique) {
  const scene::Scene scene =
      makeScene("mirrors/several", {{"tessellation", int64_t{12}}, {"motion", std::string("moving")}});
  const Ran ran = runOn(scene, {{"choose", std::string("each_mirror")}, {"check", std::string("none")}});
  const std::map<std::string, Candidate> expected = {
      {"pane", {"reflections/planar_mirror", {{"planes", int64_t{1}}}}},
      {"egg", {"reflections/vertex_reflection", {}}},
      {"figure", {"reflections/ray_hierarchy", {}}}};
  for (const auto& [name, candidate] : expected)
    EXPECT_THAT(ran.remarks,
                Contains(AllOf(StartsWith("mirror '" + name + "'"), HasSubstr(describe(candidate)))));
  EXPECT_EQ(ran.counter("techniques_joined"), 3.0);
  EXPECT_EQ(ran.counter("rule_followed"), 1.0);

  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, kNeedsSize);
  frame.begin();
  const std::vector<uint32_t> ids = frame.get<frame::TriangleIds>().texture().readUint();
  frame.end();
  std::map<std::string, int> seen;
  for (const auto& [name, candidate] : expected) {
    // Vertex reflection refuses scenes with mirrors that no point sees as a whole: the figure's technique
    // aside, the egg is rendered among mirrors of which it alone is shown.
    frame::Frame own(context(), scene, gpuScene, kNeedsSize);
    const auto part = std::find_if(scene.parts.begin(), scene.parts.end(),
                                   [&](const scene::Part& one) { return one.name == name; });
    ASSERT_NE(part, scene.parts.end());
    if (name == "egg") own.setShownMirrors(frame::ShownMirrors({size_t(part - scene.parts.begin())}));
    const auto made = makeTechnique(candidate);
    made->prepare(own);
    own.begin();
    made->render(own);
    own.end();
    const Image alone = made->product().read();
    for (int y = 0; y < kNeedsSize.y; ++y)
      for (int x = 0; x < kNeedsSize.x; ++x) {
        const uint32_t id = ids[static_cast<size_t>(y) * kNeedsSize.x + x];
        if (id < part->firstTriangle || id >= part->firstTriangle + part->triangleCount) continue;
        ++seen[name];
        for (int c = 0; c < 3; ++c) ASSERT_EQ(ran.product.at(x, y, c), alone.at(x, y, c)) << name;
      }
    EXPECT_GT(seen[name], 30) << name;
  }
}

// Pane and figure are exact but for edges, and the egg's error is that of vertex reflection alone: more than
// the frame-wide choice, the ray hierarchy for all.
TEST_F(ReflectionNeedsTest, TheJoinedPictureIsComparedWithAllCandidates) {
  const scene::Scene scene =
      makeScene("mirrors/several", {{"tessellation", int64_t{12}}, {"motion", std::string("moving")}});
  const Ran each =
      runOn(scene, {{"choose", std::string("each_mirror")}, {"check", std::string("whole_set")}});
  const Ran frameWide = runOn(scene, {{"check", std::string("whole_set")}});
  EXPECT_THAT(frameWide.remarks.at(0), StartsWith("chosen: reflections/ray_hierarchy"));
  EXPECT_GT(each.counter("check_rmse"), frameWide.counter("check_rmse"));
  EXPECT_NEAR(each.counter("regret_rmse"), each.counter("check_rmse") - each.counter("best_rmse"), 1e-9);
  EXPECT_THAT(each.remarks, Contains(HasSubstr("at full size")));
}

TEST_F(ReflectionNeedsTest, EachMirrorIsMeasuredWhereItIsSeen) {
  const scene::Scene scene = makeScene("mirrors/several", {{"tessellation", int64_t{8}}});
  const std::string path = testing::TempDir() + "limen_each_mirror.yaml";
  std::ofstream(path) << "- {name: reflections/ray_traced}\n- {name: reflections/planar_mirror, planes: 1}\n";
  // Only rays meet a target of 0.02 on the egg and the figure.
  const Ran ran = runOn(scene, {{"choose", std::string("each_mirror")},
                                {"decide", std::string("measure")},
                                {"decide.picture_px", int64_t{4096}},
                                {"candidates", std::string("file")},
                                {"candidates.file", path},
                                {"check", std::string("choice")}});
  for (const char* name : {"egg", "figure"})
    EXPECT_THAT(ran.remarks, Contains(AllOf(StartsWith(std::string("mirror '") + name + "'"),
                                            HasSubstr("reflections/ray_traced"))));
  EXPECT_EQ(ran.counter("target_met"), 1.0);
}

// A map has one place, planes are drawn together, and what moves itself is traced.
TEST_F(ReflectionNeedsTest, MirrorsAreGroupedAsTechniquesAllow) {
  std::vector<ReflectorFacts> facts(5);
  for (size_t i = 0; i < facts.size(); ++i)
    facts[i].part = uint32_t(i + 1), facts[i].name = std::to_string(i);
  const Candidate map{"reflections/environment_map", {}}, rays{"reflections/ray_traced", {}};
  const auto planar = [](int64_t planes) {
    return Candidate{"reflections/planar_mirror", {{"planes", planes}}};
  };
  const std::vector<MirrorGroup> groups = groupsOf(
      facts,
      std::vector<MirrorNeed>{{map, ""}, {planar(9), ""}, {map, ""}, {planar(7), ""}, {planar(1), ""}});
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_EQ(groups[0].parts, (std::vector<size_t>{1}));
  EXPECT_EQ(groups[1].parts, (std::vector<size_t>{2, 4}));
  EXPECT_EQ(describe(groups[1].candidate), describe(planar(16)));
  EXPECT_EQ(groups[2].parts, (std::vector<size_t>{3}));
  EXPECT_EQ(groups[3].parts, (std::vector<size_t>{5})) << "a seventeenth plane";
  const Candidate alone =
      candidateOf(groupsOf(std::span(facts).first(1), std::vector<MirrorNeed>{{rays, ""}}));
  EXPECT_EQ(describe(alone), describe(rays)) << "nothing to join";

  const scene::Scene kitchen =
      makeScene("mirrors/kitchen", {{"tessellation", int64_t{6}}, {"motion", std::string("moving")}});
  const std::vector<ReflectorFacts> measured = measureReflectors(kitchen, 10.0);
  const std::vector<MirrorNeed> needs =
      eachByRule(kitchen, measured, decideByRule(measured, true, {}), true, {});
  int moving = 0;
  for (size_t i = 0; i < needs.size(); ++i)
    if (movesPart(kitchen, measured[i].part)) {
      ++moving;
      EXPECT_EQ(needs[i].candidate.technique, "reflections/ray_hierarchy") << measured[i].name;
    }
  EXPECT_GT(moving, 0);
}

TEST_F(ReflectionNeedsTest, HardScenesStayFinite) {
  for (const Given& given : {Given{{"check", std::string("choice")}},
                             Given{{"check", std::string("choice")}, {"motion", std::string("moving")}},
                             Given{{"check", std::string("choice")},
                                   {"motion", std::string("moving")},
                                   {"choose", std::string("each_mirror")}}}) {
    const Ran ran = runOn(makeScene("mirrors/damaged"), given);
    for (const float value : ran.product.data) ASSERT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace limen::techniques
