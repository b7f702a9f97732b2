// SPDX-License-Identifier: BSD-3-Clause
// Several shadow maps joined by one mask, against brute force over the same maps and against the exact
// visible area of the light.
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/frame/receivers_from.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/techniques/soft_shadows/bitmask/bitmask_settings.h"
#include "tests/renderer/techniques/mask_twin.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char* kBitmask = "soft_shadows/bitmask";

class LightMapsTest : public TechniqueTest {
 protected:
  static ParameterValues valuesOf(const Given& given) {
    return {TechniqueRegistry::instance().get(kBitmask).parameters, given};
  }

  /// Root mean square of the difference of pictures where both see the same point.
  static double rmsDifference(const Image& product, const Rendered& other, const Image& receivers) {
    double sum = 0.0;
    int count = 0;
    for (size_t i = 0; i < product.pixels(); ++i) {
      if (receivers.data[4 * i + 3] < 0.0F) continue;
      const auto first = receivers.data.begin() + static_cast<std::ptrdiff_t>(4 * i);
      if (!std::equal(first, first + 4, other.receivers.data.begin() + static_cast<std::ptrdiff_t>(4 * i)))
        continue;
      const double difference = double(product.data[i]) - other.product.data[i];
      sum += difference * difference;
      ++count;
    }
    EXPECT_GT(count, 0);
    return std::sqrt(sum / count);
  }

  /// Compares with micropatches of all maps thrown onto all samples. A sample within float rounding of a
  /// patch's edge may fall on either side and take a row along. What the search calls umbra without looking
  /// is dark here, while patches leave gaps: left out where brute force says nearly dark, too.
  static void expectTwin(const scene::Scene& scene, Given given, const std::string& what) {
    given.insert({{"resolution", int64_t{64}},
                  {"budget.limit", int64_t{0}},
                  {"occluders.gap_fill", std::string("none")},
                  {"pattern", std::string("regular_16")}});
    const ParameterValues values = valuesOf(inThesisForm(given));
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {24, 18});
    const auto made = TechniqueRegistry::instance().get(kBitmask).make(values);
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    std::vector<MaskTwin> twins;
    for (const frame::ShadowMapSettings& map :
         lightMaps(BitmaskSettings::table().read(values).maps, scene, {.resolution = 64})) {
      const auto& depth = frame.get<frame::ShadowMap>(map);
      twins.push_back({depth.texture().read(), frame.get<frame::Receivers>().texture().read(),
                       depth.frustum(), scene.lights[0].size});
      if (map.eye != glm::dvec2(0.5))
        twins.back().receivers = frame.get<frame::ReceiversFrom>(frame::EyeSetting{map.eye}).texture().read();
    }
    frame.end();
    const Image product = made->product().read();
    const std::vector<glm::dvec2> samples = lightSamples(LightPattern::Regular16);
    int compared = 0, differing = 0, shadowed = 0;
    for (int y = 0; y < product.height; ++y)
      for (int x = 0; x < product.width; ++x) {
        if (twins[0].receivers.at(x, y, 3) < 0.0F) {
          EXPECT_EQ(product.at(x, y), 1.0F);
          continue;
        }
        std::vector<bool> covered(samples.size(), false);
        for (const MaskTwin& twin : twins) twin.cover(x, y, samples, covered);
        const double expected = 1.0 - double(std::count(covered.begin(), covered.end(), true)) / 256.0;
        if (product.at(x, y) == 0.0F && expected < 0.2) continue;
        ++compared;
        shadowed += expected < 1.0;
        const double error = std::abs(product.at(x, y) - expected);
        EXPECT_LE(error, 16.0 / 256.0 + 1e-6) << what << " at " << x << ' ' << y;
        differing += error > 1e-6;
      }
    EXPECT_GT(compared, 150) << what;
    EXPECT_GT(shadowed, 20) << what;
    EXPECT_LE(differing, compared / 50) << what << ": " << differing << " of " << compared;
  }
};

TEST_F(LightMapsTest, AllMicropatchesOfAllMapsAreJoined) {
  const scene::Scene boxes = makeScene("two_boxes", {{"light_size", 3.0}});
  const scene::Scene box = makeScene("box_under_light");
  const auto text = [](const char* value) { return std::string(value); };
  for (const auto& [scene, name] : {std::pair(&boxes, "two_boxes"), std::pair(&box, "box_under_light")}) {
    const std::string what = name;
    expectTwin(*scene, {{"maps", text("peeled")}, {"maps.layers", int64_t{3}}}, what + ", peeled");
    expectTwin(*scene, {{"maps", text("peeled")}, {"maps.later_extent", 0.6}},
               what + ", later layers smaller");
    expectTwin(*scene, {{"maps", text("light_points")}, {"maps.points", int64_t{5}}}, what + ", points");
    expectTwin(*scene, {{"maps", text("light_points")}, {"maps.points", int64_t{2}}, {"maps.spread", 0.4}},
               what + ", points without the centre");
    expectTwin(*scene, {{"maps", text("per_object")}}, what + ", per object");
  }
}

/// The scene's casters without what does not lie at their greatest height.
scene::Scene topsAlone(scene::Scene scene) {
  const double top = scene.casterBounds().high.y;
  for (const scene::Part& part : scene.parts) {
    if (part.receiverOnly) continue;
    std::optional<glm::uvec3> kept;
    const auto isTop = [&](const glm::uvec3& triangle) {
      return std::abs(scene.mesh.positions[triangle.x].y - top) < 1e-6 &&
             std::abs(scene.mesh.positions[triangle.y].y - top) < 1e-6 &&
             std::abs(scene.mesh.positions[triangle.z].y - top) < 1e-6;
    };
    const auto first = scene.mesh.triangles.begin() + part.firstTriangle, end = first + part.triangleCount;
    for (auto triangle = first; triangle != end; ++triangle)
      if (isTop(*triangle)) kept = *triangle;
    if (!kept) throw std::logic_error("no triangle at the top");
    for (auto triangle = first; triangle != end; ++triangle)
      if (!isTop(*triangle)) *triangle = *kept;
  }
  return scene;
}

/// Figure 4.3. The map from the centre shows the box's top alone, while rays from the ground to the light's
/// far rim meet the sides and pass beneath the top. The layer behind the top holds the sides, seen from
/// inside, and with them all of a convex body. What masks add are the places of two silhouettes on either
/// axis, each to half a row of 16 at worst: 1/32 on average over both signs. So one layer errs as much as an
/// exact shadow of the top alone does, give or take 1/32, and two layers by less than 1/32.
TEST_F(LightMapsTest, ASecondLayerBringsTheShadowOfTheSidesBack) {
  constexpr glm::ivec2 kSize{48, 36};
  constexpr double kMasks = 1.0 / 32.0;
  const scene::Scene scene = makeScene("box_under_light", {{"box_height", 2.0}, {"light_size", 1.5}});
  const Rendered truth = render(scene, "soft_shadows/exact_union", {}, kSize),
                 tops = render(topsAlone(scene), "soft_shadows/exact_union", {}, kSize);
  const auto withLayers = [&](int64_t layers) {
    const Image product = render(scene, kBitmask,
                                 {{"resolution", int64_t{64}},
                                  {"budget.limit", int64_t{0}},
                                  {"maps", std::string("peeled")},
                                  {"maps.layers", layers}},
                                 kSize)
                              .product;
    return rmsDifference(product, truth, tops.receivers);
  };
  const double missing = rmsDifference(tops.product, truth, tops.receivers);
  ASSERT_GT(missing, 2.0 * kMasks);  // otherwise the bounds below could not tell one layer from two
  EXPECT_NEAR(withLayers(1), missing, kMasks);
  EXPECT_LT(withLayers(2), kMasks);
}

TEST_F(LightMapsTest, OneLayerIsTheUsualMap) {
  const scene::Scene scene = makeScene("two_boxes");
  const Given usual = {{"resolution", int64_t{64}}};
  Given one = usual;
  one["maps"] = std::string("peeled");
  one["maps.layers"] = int64_t{1};
  Given spread = usual;
  spread["maps"] = std::string("light_points");
  spread["maps.spread"] = 0.0;
  const Image expected = render(scene, kBitmask, usual, {32, 24}).product;
  EXPECT_EQ(render(scene, kBitmask, one, {32, 24}).product.data, expected.data);
  EXPECT_EQ(render(scene, kBitmask, spread, {32, 24}).product.data, expected.data);
}

/// Objects in turn: the picture is that of all objects anew, though a frame reads one map; and where the
/// camera has moved every mask is made again.
TEST_F(LightMapsTest, MasksOfObjectsAreKeptUntilTheCameraMoves) {
  scene::Scene scene = makeScene("two_boxes");
  scene::Camera end = scene.camera.at(0.0);
  end.eye += glm::dvec3(0.6, 0.1, 0.0);
  scene.camera.keys.push_back({1.0, end});
  const Given all = {{"resolution", int64_t{64}}, {"maps", std::string("per_object")}};
  Given turns = all;
  turns["maps.updates"] = int64_t{1};
  const frame::GpuScene gpuScene(scene);
  const TechniqueInfo& info = TechniqueRegistry::instance().get(kBitmask);
  frame::Frame frame(context(), scene, gpuScene, {32, 24}), whole(context(), scene, gpuScene, {32, 24});
  const auto kept = info.make(ParameterValues(info.parameters, turns));
  const auto anew = info.make(ParameterValues(info.parameters, all));
  kept->prepare(frame);
  anew->prepare(whole);
  const auto rastersIn = [](frame::Frame& of) {
    int count = 0;
    for (const gl::PassList::Pass& pass : of.passes().passes())
      count += pass.ran && pass.name.starts_with("frame/shadow_raster");
    return count;
  };
  int number = 0;
  for (const double time : {0.0, 0.0, 0.0, 1.0, 1.0}) {
    frame.setTime(time);
    whole.setTime(time);
    frame.begin();
    kept->render(frame);
    frame.end();
    whole.begin();
    anew->render(whole);
    whole.end();
    EXPECT_EQ(kept->product().read().data, anew->product().read().data) << number;
    EXPECT_EQ(rastersIn(whole), 2);
    EXPECT_EQ(rastersIn(frame), number == 0 || number == 3 ? 2 : 1) << number;
    ++number;
  }
}

TEST_F(LightMapsTest, ParametersOfOtherMapsCannotBeWritten) {
  const std::string points = "light_points", peeled = "peeled";
  for (const Given& given :
       {Given{{"maps.layers", int64_t{3}}}, Given{{"maps.bias", 0.01}},
        Given{{"maps", points}, {"maps.later_extent", 0.5}},
        Given{{"maps", peeled}, {"maps.points", int64_t{9}}}, Given{{"maps", peeled}, {"maps.spread", 0.5}},
        Given{{"maps", peeled}, {"maps.updates", int64_t{1}}}})
    EXPECT_THROW(valuesOf(given), Error) << given.rbegin()->first;
}

TEST_F(LightMapsTest, SeveralMapsAreNeitherBlendedNorBiasedByTexels) {
  const std::string points = "light_points";
  for (const auto& [given, where] :
       {std::pair<Given, std::string>{{{"maps", points}, {"levels", std::string("blend")}}, "levels"},
        {{{"maps", points}, {"bias", std::string("stored")}}, "bias"}}) {
    const std::optional<Error> error = refusal(kBitmask, given);
    ASSERT_TRUE(error) << where;
    EXPECT_EQ(error->where(), where);
  }
}

/// Areas cannot be joined: what two maps both see would count twice.
TEST_F(LightMapsTest, AreasHaveNoFurtherMaps) {
  for (const Parameter& parameter :
       TechniqueRegistry::instance().get("soft_shadows/backprojection").parameters)
    EXPECT_NE(parameter.name, "maps");
}

TEST_F(LightMapsTest, CountsMapsAndMasks) {
  const scene::Scene scene = makeScene("half_plane");  // two surfaces along a ray at most
  const Rendered result =
      render(scene, kBitmask,
             {{"resolution", int64_t{64}}, {"maps", std::string("peeled")}, {"maps.layers", int64_t{8}}},
             {16, 12}, true);
  EXPECT_EQ(result.counter("maps_read"), 8.0);
  EXPECT_EQ(result.counter("maps_with_casters"), 2.0);
  EXPECT_EQ(result.counter("mask_bytes"), 16.0 * 12.0 * 256.0 / 8.0);
}

/// A plane so tilted that it cuts the light: of the corners of the light some lie before it and see it from
/// its front, the others from its back, where nothing that their maps hold comes between it and the light
/// before it. Rays know the share before the plane without any map.
TEST_F(LightMapsTest, APlaneThatPointsSeeFromBehindHidesNoLightBeforeIt) {
  scene::Scene scene = makeScene("resting_sphere", {{"tilt", 80.0}, {"light_size", 24.0}});
  scene.parts.resize(1);
  scene.mesh.triangles.resize(scene.parts[0].triangleCount);
  const Image truth =
      render(scene, "soft_shadows/ray_traced", {{"samples", int64_t{1024}}}, {32, 24}).product;
  int cut = 0;
  for (const float value : truth.data) cut += value > 0.02F && value < 0.98F;
  ASSERT_GT(cut, 20);
  for (const int64_t points : {2, 4, 5, 9}) {
    const Image product =
        render(scene, kBitmask, {{"maps", std::string("light_points")}, {"maps.points", points}}, {32, 24})
            .product;
    // A line through 16 x 16 samples leaves fewer than 16 undecided; the rays are 32 x 32.
    for (size_t i = 0; i < truth.pixels(); ++i)
      ASSERT_NEAR(product.data[i], truth.data[i], 0.06) << points << " points, " << i;
  }
}

/// Two cards, one above the other's edge: light reaches the ground through the gap between them. Maps from
/// the light's right corners see that gap. Those from its left corners see the upper card's edge before the
/// lower card, and no gap: filled, all the light between the upper card's edge and what they see of the lower
/// card is hidden, which is all that a point of the ground could see. Left open, these maps say nothing of
/// it, and the others what there is.
TEST_F(LightMapsTest, MapsOfPointsSeeIntoGapsThatOneMapFills) {
  constexpr double kUpper = 1.2, kLower = 0.4, kReach = 1.5, kLight = 2.0;  // heights; half the cards' length
  scene::Scene scene;
  scene::addPart(scene, "ground", scene::card({0.0, 0.0, 0.0}, {0.0, 0.0, 4.0}, {4.0, 0.0, 0.0}),
                 glm::vec3(0.7F), scene::Role::ReceiverOnly);
  for (const auto& [centre, height] : {std::pair(-0.5 * kReach, kUpper), {0.5 * kReach, kLower}})
    scene::addPart(scene, "card",
                   scene::card({centre, height, 0.0}, {0.0, 0.0, kReach}, {0.5 * kReach, 0.0, 0.0}),
                   glm::vec3(0.5F));
  scene.lights = {scene::lightTowards({0.0, kLight, 0.0}, glm::dvec3(0.0), glm::dvec2(1.0))};
  scene::setStillCamera(scene, {{-1.0, 0.6, 0.0}, {-0.1, 0.0, 0.0}, {0.0, 1.0, 0.0}, 30.0});
  const glm::dmat4 toWorld = glm::inverse(scene.lights[0].toLightSpace());
  // Both edges lie at x = 0. A point of the ground sees the light between them, the light being 1 wide.
  const auto seenShare = [](double x) {
    const auto onLight = [x](double height) { return std::clamp(x - x * kLight / height, -0.5, 0.5); };
    return std::max(onLight(kLower) - onLight(kUpper), 0.0);
  };
  // Either edge is known to half a column of 16 samples and to half a texel of the map, 1 / 256 of at most 4
  // in tangents, which p_z z / (p_z - z) turns into lengths on the light: 8 for the lower card, 4/3 for the
  // upper one.
  constexpr double kTolerance = 2.0 / 32.0 + 0.5 * (8.0 + 4.0 / 3.0) * 4.0 / 256.0;
  for (const bool thesis : {false, true}) {
    const auto visibility = [&](const char* gaps) {
      Given given = {{"maps", std::string("light_points")}, {"maps.points", int64_t{4}},
                     {"maps.gaps", std::string(gaps)},      {"budget.limit", int64_t{0}},
                     {"resolution", int64_t{256}},          {"pattern", std::string("regular_16")}};
      if (thesis) given = inThesisForm(given);
      return render(scene, kBitmask, given, {32, 24});
    };
    const Rendered open = visibility("open"), filled = visibility("filled");
    int compared = 0;
    for (size_t i = 0; i < open.product.pixels(); ++i) {
      const float* point = &open.receivers.data[4 * i];
      if (point[3] < 0.0F) continue;
      const glm::dvec3 world(toWorld * glm::dvec4(point[0], point[1], point[2], 1.0));
      const double exact = seenShare(world.x);
      if (world.y > 1e-5 || std::abs(world.z) > 0.5 || exact < 2.0 * kTolerance) continue;
      ++compared;
      EXPECT_NEAR(open.product.data[i], exact, kTolerance) << world.x << (thesis ? ", thesis's form" : "");
      EXPECT_LT(filled.product.data[i], kTolerance) << world.x << (thesis ? ", thesis's form" : "");
    }
    EXPECT_GT(compared, 100);
  }
}

/// So it is where many surfaces lie one behind the other: the masks add up what all maps have closed.
TEST_F(LightMapsTest, OpenGapsErrLessThanFilledOnes) {
  constexpr glm::ivec2 kSize{48, 36};
  for (const char* name : {"columns_hall", "foliage"}) {
    const scene::Scene scene = makeScene(name);
    const Rendered truth = render(scene, "soft_shadows/ray_traced", {{"samples", int64_t{256}}}, kSize);
    const auto error = [&](const char* gaps, bool thesis) {
      Given given = {{"maps", std::string("light_points")},
                     {"maps.points", int64_t{4}},
                     {"maps.gaps", std::string(gaps)}};
      if (thesis) given = inThesisForm(given);
      return rmsDifference(render(scene, kBitmask, given, kSize).product, truth, truth.receivers);
    };
    for (const bool thesis : {false, true})
      EXPECT_LT(error("open", thesis), error("filled", thesis)) << name << (thesis ? ", thesis's form" : "");
  }
}

}  // namespace
}  // namespace limen::techniques
