// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class SoftShadows : public TechniqueTest {
 protected:
  static std::vector<std::string> all() {
    std::vector<std::string> names;
    for (const std::string& name : TechniqueRegistry::instance().names())
      if (name.starts_with("soft_shadows/") && !TechniqueRegistry::instance().get(name).reference &&
          TechniqueRegistry::instance().get(name).product != ProductKind::VisibilityChange)
        names.push_back(name);
    return names;
  }

  /// Its product is that of another, chosen by times measured on the spot.
  static constexpr const char* kChosenByTime = "soft_shadows/scene_needs";
  static constexpr const char* kShaded = "soft_shadows/shaded";

  /// Maps that take a software renderer less time than the usual ones, where the technique reads any.
  static Given smallMap(const std::string& technique) {
    if (technique == kChosenByTime)
      return withMaps(technique, 256, {{"timing.warmup", int64_t{1}}, {"timing.frames", int64_t{1}}});
    return withMaps(technique, 256);
  }

  /// Ends of a parameter's range, or all choices that it has; `few`: the first and the last of them.
  static std::vector<ParameterValue> endsOf(const Parameter& parameter, bool few) {
    // With more texels than a software renderer's loops may visit there is no number rather than a wrong one;
    // and maps that large take it long.
    constexpr int64_t kLargestMap = 128;
    // They are drawn one like the other, before the first that is looked at.
    constexpr int64_t kMostSettleFrames = 64;
    const bool isMap = parameter.name.ends_with("resolution");
    std::vector<ParameterValue> ends;
    if (parameter.type == ParameterType::Choice) {
      for (const std::string& choice : parameter.choices)
        if (!isMap || std::stoi(choice) <= kLargestMap) ends.emplace_back(choice);
      if (few && ends.size() > 2) ends = {ends.front(), ends.back()};
    } else if (!parameter.allowed.empty()) {
      const auto [least, most] = std::minmax_element(parameter.allowed.begin(), parameter.allowed.end());
      ends = {*least, isMap ? std::min(*most, kLargestMap) : *most};
    } else if (parameter.name == "settle_frames") {
      ends = {static_cast<int64_t>(*parameter.minimum),
              std::min(static_cast<int64_t>(*parameter.maximum), kMostSettleFrames)};
    } else if (parameter.type == ParameterType::Integer) {
      ends = {static_cast<int64_t>(*parameter.minimum), static_cast<int64_t>(*parameter.maximum)};
    } else if (parameter.type == ParameterType::Real) {
      ends = {*parameter.minimum, *parameter.maximum};
    }
    return ends;
  }
};

// A half-plane x < 0 at height h under a w x w light at height H. The ground point at x sees light points X
// with x + (X - x) (h / H) > 0, that is X > x (1 - H / h): the share 1/2 + x (H - h) / (h w), clamped.
double halfPlaneVisibility(double x, double H, double h, double w) {
  return std::clamp(0.5 + x * (H - h) / (h * w), 0.0, 1.0);
}

TEST_F(SoftShadows, HalfPlanePenumbraIsTheLinearRampOfTheClosedForm) {
  const scene::Scene scene = makeScene("half_plane");
  const scene::AreaLight& light = scene.lights[0];
  const double H = light.centre.y, h = 1.0, w = light.size.x;
  const frame::GpuScene gpuScene(scene);
  constexpr int kResolution = 256;
  for (const char* technique : {"soft_shadows/backprojection", "soft_shadows/bitmask"}) {
    frame::Frame frame(context(), scene, gpuScene, {64, 48});
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const auto made = info.make(ParameterValues(
        info.parameters, {{"resolution", int64_t{kResolution}}, {"budget.limit", int64_t{0}}}));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    const Image receivers = frame.get<frame::Receivers>().texture().read();
    const Image product = made->product().read();
    const auto& frustum = frame.get<frame::MinMaxPyramid>(frame::ShadowMapSettings{kResolution}).frustum();
    frame.end();
    // The edge lies on the map's grid to within one texel, that is tangent * (H - h) on the occluder and,
    // thrown onto the light, that times H / h; one row of samples more for the mask; 1 % for rounding near
    // the ramp's ends.
    const double texel = (frustum.high.x - frustum.low.x) / kResolution * (H - h) * (H / h) / w;
    const double bound = texel + (std::string(technique) == "soft_shadows/bitmask" ? 1.0 / 16.0 : 0.0) + 0.01;
    int penumbra = 0;
    const glm::dmat4 fromLight = glm::inverse(light.toLightSpace());
    for (int i = 0; i < product.width * product.height; ++i) {
      const auto at = static_cast<size_t>(i);
      if (receivers.data[4 * at + 3] < 0.0F) continue;
      const glm::dvec3 world = fromLight * glm::dvec4(receivers.data[4 * at], receivers.data[4 * at + 1],
                                                      receivers.data[4 * at + 2], 1.0);
      if (world.y > 0.01) continue;  // the half-plane itself
      const double expected = halfPlaneVisibility(world.x, H, h, w);
      ASSERT_NEAR(product.data[at], expected, bound) << technique << " at x = " << world.x;
      if (expected > 0.0 && expected < 1.0) ++penumbra;
    }
    EXPECT_GT(penumbra, 200) << technique;
  }
}

TEST_F(SoftShadows, BitmasksFuseWhatAreasCountTwice) {
  // Evaluated by the exact union of the cards' projections, where it is neither full nor empty. The sum of
  // areas may count each card's overlap with the next; the bitmask must stay at its own resolution of 1/16
  // per edge.
  std::map<std::string, std::vector<double>> largest, total;
  for (const int64_t cards : {1, 2, 4, 8}) {
    const scene::Scene scene =
        makeScene("card_stack", {{"cards", cards}, {"spacing", 0.1}, {"fit", std::string("strips")}});
    const Rendered exact = render(scene, "soft_shadows/exact_union", {}, {48, 36});
    // The map spans the staircase: as many texels for each card.
    const Given given = {{"resolution", 64 * cards},
                         {"budget.limit", int64_t{0}},
                         {"occluders.gap_fill", std::string("none")}};
    for (const char* technique : {"soft_shadows/backprojection", "soft_shadows/bitmask"}) {
      const Rendered rendered = render(scene, technique, given, {48, 36});
      double sum = 0.0, worst = 0.0;
      int count = 0;
      for (size_t i = 0; i < rendered.product.pixels(); ++i) {
        if (rendered.receivers.data[4 * i + 3] < 0.0F) continue;
        const double reference = exact.product.data[i];
        if (reference <= 0.0 || reference >= 1.0) continue;
        const double error = std::abs(rendered.product.data[i] - reference);
        sum += error;
        worst = std::max(worst, error);
        ++count;
      }
      ASSERT_GT(count, 100);
      largest[technique].push_back(worst);
      total[technique].push_back(sum);
    }
  }
  const auto& area = total["soft_shadows/backprojection"];
  const auto& bitmask = total["soft_shadows/bitmask"];
  for (size_t i = 0; i < area.size(); ++i) {
    RecordProperty("total_error_" + std::to_string(i),
                   std::to_string(area[i]) + " " + std::to_string(bitmask[i]));
    RecordProperty("largest_error_" + std::to_string(i),
                   std::to_string(largest["soft_shadows/backprojection"][i]) + " " +
                       std::to_string(largest["soft_shadows/bitmask"][i]));
  }
  // A projection's edge misses its true place by less than one row of samples, however many cards there are.
  for (const double error : largest["soft_shadows/bitmask"]) EXPECT_LT(error, 1.0 / 16.0);
  // One card alone is exact; from two cards on overlaps count twice. The eighth card hides most of the light
  // from where they overlap, so that no more error than at four is left to make.
  EXPECT_LT(largest["soft_shadows/backprojection"][0], 1e-4);
  for (size_t i = 1; i < area.size(); ++i)
    EXPECT_GT(largest["soft_shadows/backprojection"][i], 1.0 / 16.0) << i;
  EXPECT_GT(area[1], area[0]);
  EXPECT_GT(area[2], area[1]);
  EXPECT_GT(area.back(), 2.0 * bitmask.back());
}

TEST_F(SoftShadows, GapFillingClosesLeaksStepByStep) {
  // A slanted plane of micropatches: without filling light leaks between them, each kind of filling leaves
  // less.
  const scene::Scene scene = makeScene("sphere_grid");
  std::vector<double> light;
  for (const char* fill : {"none", "limited", "left_bottom", "diagonal"}) {
    const Rendered rendered = render(scene, "soft_shadows/backprojection",
                                     {{"resolution", int64_t{128}},
                                      {"budget.limit", int64_t{0}},
                                      {"occluders.gap_fill", std::string(fill)}},
                                     {64, 48});
    double sum = 0.0;
    for (const float value : rendered.product.data) sum += value;
    light.push_back(sum);
  }
  EXPECT_GT(light[0], light[1]);
  EXPECT_GE(light[1], light[2]);
  EXPECT_GE(light[2], light[3]);
}

TEST_F(SoftShadows, NothingOccludesMeansFullyLit) {
  // One card alone: its own top and everything not below it is exactly lit.
  const scene::Scene scene = makeScene("card_stack", {{"cards", int64_t{1}}});
  const glm::dmat4 fromLight = glm::inverse(scene.lights[0].toLightSpace());
  for (const std::string& technique : all()) {
    // Its product is a picture.
    if (technique == kShaded) continue;
    const Rendered rendered = render(scene, technique, smallMap(technique), {64, 48});
    int lit = 0;
    for (size_t i = 0; i < rendered.product.pixels(); ++i) {
      if (rendered.receivers.data[4 * i + 3] < 0.0F) continue;
      const glm::dvec3 world =
          fromLight * glm::dvec4(rendered.receivers.data[4 * i], rendered.receivers.data[4 * i + 1],
                                 rendered.receivers.data[4 * i + 2], 1.0);
      // Far outside the widest cone from the light over the card: |x| + |z| beyond card and penumbra.
      const bool onCard = world.y > 0.1, farAway = std::max(std::abs(world.x), std::abs(world.z)) > 1.6;
      if (!onCard && !farAway) continue;
      ++lit;
      ASSERT_EQ(rendered.product.data[i * static_cast<size_t>(rendered.product.channels)], 1.0F)
          << technique << " at " << world.x << " " << world.y << " " << world.z;
    }
    EXPECT_GT(lit, 100) << technique;
  }
}

TEST_F(SoftShadows, SameInputGivesTheSameBytes) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const std::string& technique : all()) {
    if (technique == kChosenByTime) continue;
    const Given given = smallMap(technique);
    const Rendered first = render(scene, technique, given, {64, 48}),
                   second = render(scene, technique, given, {64, 48});
    EXPECT_EQ(
        std::memcmp(first.product.data.data(), second.product.data.data(), first.product.data.size() * 4), 0)
        << technique;
  }
}

TEST_F(SoftShadows, ScaleAndDistanceFromTheOriginDoNotMatter) {
  const Rendered plain = render(makeScene("sphere_grid"), "soft_shadows/bitmask", {}, {64, 48});
  for (const Given& given : {Given{{"scale", 1e-5}}, Given{{"scale", 1e5}}, Given{{"offset", 1e5}}}) {
    const Rendered other = render(makeScene("sphere_grid", given), "soft_shadows/bitmask", {}, {64, 48});
    // Rounding may move a silhouette pixel or a sample at an edge; nothing else may change.
    int differing = 0;
    for (size_t i = 0; i < plain.product.pixels(); ++i)
      if (std::abs(plain.product.data[i] - other.product.data[i]) > 17.0F / 256.0F) ++differing;
    EXPECT_LE(differing, 30) << given.begin()->first;
  }
}

/// A technique at a time: together they take minutes.
class SoftShadowCorners : public SoftShadows, public testing::WithParamInterface<std::string> {
 public:
  static std::vector<std::string> chosen() {
    std::vector<std::string> names = all();
    std::erase(names, kChosenByTime);  // see scene_needs_test.cpp
    return names;
  }
};

TEST_P(SoftShadowCorners, AreFinite) {
  const std::vector<std::string> kDerived = {"soft_shadows/bitmask_coloured",
                                             "soft_shadows/history",
                                             "soft_shadows/in_motion",
                                             "soft_shadows/multisample",
                                             "soft_shadows/multisample_coloured",
                                             "soft_shadows/sparse"};
  const std::string& technique = GetParam();
  const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
  // What runs another technique, or has another's parameters, is tried where more breaks; what has all of
  // another's and few of its own, with few of their choices.
  const bool derived = std::find(kDerived.begin(), kDerived.end(), technique) != kDerived.end();
  const bool few = technique.ends_with("_coloured");
  for (const char* sceneName : {"degenerate_soup", "box_under_light"}) {
    if (derived && sceneName != std::string("degenerate_soup")) continue;
    const scene::Scene scene = makeScene(sceneName, {{"light_size", 3.0}});
    for (const DeclaredAt& at : flatten(info.parameters)) {
      // Needs a picture; see budget_drivers_test.cpp.
      const auto painted = [](const auto& choice) { return choice.second == "painted"; };
      if (std::any_of(at.when.begin(), at.when.end(), painted)) continue;
      // The inner technique's own have been tried with that technique.
      if (at.path.starts_with("inner.")) continue;
      for (const ParameterValue& end : endsOf(*at.parameter, few)) {
        if (end == ParameterValue("painted")) continue;
        Given given(at.when.begin(), at.when.end());
        given[at.path] = end;
        // Drivers differ in the numbers of samples that they have, and say so; see multisample_test.cpp.
        if (technique.starts_with("soft_shadows/multisample") && at.path == "samples")
          given["raster"] = std::string("compute");
        const Given smaller = withMaps(technique, 64, given);
        given.insert(smaller.begin(), smaller.end());
        // What does not go together with the others' defaults; microquads_test.cpp tries those together.
        if (refusal(technique, given)) continue;
        const Rendered rendered = render(scene, technique, given, {24, 18});
        for (const float value : rendered.product.data)
          ASSERT_TRUE(value >= 0.0F && value <= 1.0F) << sceneName << ", " << technique << ", " << at.path
                                                      << " = " << limen::toText(end) << ": " << value;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, SoftShadowCorners, testing::ValuesIn(SoftShadowCorners::chosen()),
                         [](const auto& one) { return one.param.substr(one.param.find('/') + 1); });

TEST_F(SoftShadows, CountersAddUp) {
  for (const std::string& technique : all()) {
    // Those that wrap another, or read no map, count something else.
    if (technique == kChosenByTime) continue;
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const bool readsMap =
        std::any_of(info.parameters.begin(), info.parameters.end(),
                    [](const Parameter& parameter) { return parameter.name == "resolution"; });
    const auto counts = [&](const char* name) {
      return std::any_of(info.counters.begin(), info.counters.end(),
                         [name](const Quantity& counter) { return counter.name == name; });
    };
    if (!readsMap || !counts("lit_share") || !counts("fetches_per_px")) continue;
    const Rendered rendered =
        render(makeScene("sphere_grid"), technique, smallMap(technique), {64, 48}, true);
    EXPECT_NEAR(rendered.counter("lit_share") + rendered.counter("umbra_share") +
                    rendered.counter("processed_share") + rendered.counter("outside_map_share"),
                rendered.counter("receivers_share"), 1e-12)
        << technique;
    EXPECT_GT(rendered.counter("fetches_per_px"), 0.0) << technique;
  }
}

}  // namespace
}  // namespace limen::techniques
