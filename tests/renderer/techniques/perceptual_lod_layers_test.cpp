// SPDX-License-Identifier: BSD-3-Clause
// How the pipeline takes a picture apart, against ordinary renderings.
#include <limits>

#include "experiments/base/error.h"
#include "perception/threshold_maps/reference.h"
#include "perception/thresholds/thresholds.h"
#include "tests/renderer/techniques/perceptual_lod_fixture.h"

namespace limen::techniques {
namespace {

LayerPartition uniform(int count) { return UniformLayers{{.count = count}}; }
LayerPartition logarithmic(int count) { return LogLayers{{.count = count}}; }

TEST(PerceptualLodLayers, DivideTheRangeOfDistances) {
  const std::vector<double> distances = {1.0, 3.0, 5.0, 9.0};
  // (9 - 1) / 4 = 2, and (9 / 1)^(1/2) = 3; a distance on a border belongs to the farther layer.
  EXPECT_EQ(layerBorders(uniform(4), distances), (std::vector<double>{3.0, 5.0, 7.0}));
  EXPECT_EQ(assignLayers(uniform(4), distances), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(layerBorders(logarithmic(2), distances), (std::vector<double>{3.0}));
  EXPECT_EQ(assignLayers(logarithmic(2), distances), (std::vector<int>{0, 1, 1, 1}));
  EXPECT_EQ(assignLayers(ExplicitLayers{"2, 6"}, distances), (std::vector<int>{0, 1, 1, 2}));
  // A range that is given does not move with the objects.
  const LayerPartition fixed = UniformLayers{{.count = 2, .nearest = 1.0, .farthest = 21.0}};
  EXPECT_EQ(assignLayers(fixed, distances), (std::vector<int>{0, 0, 0, 0}));
}

TEST(PerceptualLodLayers, SurviveRangesWithoutExtent) {
  for (const auto layersOf : {uniform, logarithmic}) {
    EXPECT_TRUE(assignLayers(layersOf(8), {}).empty());
    EXPECT_EQ(assignLayers(layersOf(8), {2.0, 2.0}), (std::vector<int>{0, 0}));
    EXPECT_EQ(assignLayers(layersOf(1), {0.0, 5.0}), (std::vector<int>{0, 0}));
    // The eye in the middle of an object: no logarithm.
    EXPECT_EQ(assignLayers(layersOf(2), {0.0, 5.0}), (std::vector<int>{0, 1}));
  }
}

TEST(PerceptualLodLayers, BordersAreCheckedBeforeAnythingRuns) {
  const auto read = [](const std::string& borders) {
    const SettingsTable<ExplicitLayers>& table = ExplicitLayers::table();
    return table.read({table.parameters(), {{"borders", borders}}});
  };
  EXPECT_EQ(read("2.5, 5,10").distances(), (std::vector<double>{2.5, 5.0, 10.0}));
  EXPECT_EQ(layerCount(read("2.5, 5,10")), 4);
  for (const char* wrong : {"", "5, 2", "1 x", "-1", "0", "nan", "inf", "1,2,3,4,5,6,7,8"})
    EXPECT_THROW(read(wrong), Error) << wrong;
}

TEST(PerceptualLodRule, ThresholdsAreCheckedAndHiddenObjectsKept) {
  const SettingsTable<LevelRule>& table = LevelRule::table();
  const auto read = [&](const char* kind) {
    table.read({table.parameters(), {{"limits", kind}, {"limits.lower", 0.9}, {"limits.upper", 0.8}}});
  };
  EXPECT_THROW(read("px"), Error);
  EXPECT_THROW(read("share"), Error);
  LevelRule rule{PixelLimits{4.0, 8.0}};
  EXPECT_EQ(rule.step({0, 1, 100, 3, 0}), 1);
  EXPECT_EQ(rule.step({0, 1, 100, 4, 0}), 0);
  EXPECT_EQ(rule.step({0, 1, 100, 8, 0}), 0);
  EXPECT_EQ(rule.step({0, 1, 100, 9, 0}), -1);
  EXPECT_EQ(rule.step({0, 1, 0, 0, 0}), 0);
  rule.coarsen = Coarsen::IfInvisible;
  EXPECT_EQ(rule.step({0, 1, 100, 3, 9}), 0);
  EXPECT_EQ(rule.step({0, 1, 100, 3, 8}), 1);
}

class PerceptualLodPicture : public PerceptualLodTest {
 protected:
  static std::vector<uint32_t> idsOf(Bench& bench, const scene::LodSelection& selection) {
    frame::Frame frame(context(), bench.frame.scene(), bench.gpuScene, bench.frame.sizePx());
    frame.setLevels(selection);
    frame.begin();
    return frame.get<frame::TriangleIds>().texture().readUint();
  }

  static scene::Scene field() {
    return makeScene("lod/field", {{"grid.rows", int64_t{4}},
                                   {"grid.columns", int64_t{3}},
                                   {"levels.tessellation", int64_t{8}},
                                   {"motion", std::string("approach")},
                                   {"motion.speed", 1.5}});
  }
};

TEST_F(PerceptualLodPicture, CompositeOfAllLayersIsTheOrdinaryPictureBitForBit) {
  const scene::Scene scene = field();
  const std::vector<Given> cases = {
      {{"layers.count", int64_t{1}}},
      {{"layers.count", int64_t{4}}, {"shading.shadow", true}},
      {{"layers.count", int64_t{8}},
       {"layers", std::string("uniform")},
       {"shading.shadow", true},
       {"shading.specular", 0.5}},
      {{"layers", std::string("explicit")}, {"layers.borders", std::string("4, 5.2")}}};
  for (const Given& given : cases) {
    const PerceptualLodSettings chosen = settings(given);
    Bench bench(scene, chosen, {97, 61});
    std::set<std::vector<int>> assignments;
    // On the way objects cross the borders between layers and change their levels.
    for (int i = 0; i < 8; ++i) {
      const double timeS = 0.25 * i;
      bench.run(1, timeS);
      assignments.insert(bench.pipeline.layerOf());
      ASSERT_EQ(bench.pipeline.picture().read().data,
                picture(bench, bench.pipeline.shown(), chosen.shading, timeS).data)
          << "frame " << i;
    }
    EXPECT_EQ(assignments.size() > 1, layerCount(chosen.layers) > 1);
    EXPECT_GT(bench.pipeline.control().switches(), 0);
  }
}

TEST_F(PerceptualLodPicture, RastersInComputeGiveTheSamePictureAndTheSameTests) {
  const scene::Scene scene = field();
  for (const bool shadow : {false, true}) {
    const PerceptualLodSettings chosen = settings({{"shading.shadow", shadow},
                                                   {"tests.objects_per_frame", int64_t{3}},
                                                   {"rule.coarsen", std::string("if_invisible")}});
    Bench bench(scene, chosen, {80, 60}, frame::Raster::Compute), hardware(scene, chosen, {80, 60});
    int64_t tests = 0, visible = 0;
    for (int i = 0; i < 6; ++i) {
      bench.run(1, 0.25 * i);
      hardware.run(1, 0.25 * i);
      const Image found = bench.pipeline.picture().read();
      const Image wanted = picture(bench, bench.pipeline.shown(), chosen.shading, 0.25 * i);
      int others = 0;
      for (size_t p = 0; p < found.pixels(); ++p) others += found.data[4 * p] != wanted.data[4 * p];
      // The ordinary picture's shadow map is the driver's here: it may differ at edges.
      EXPECT_LE(others, shadow ? 10 : 0);
      ASSERT_EQ(bench.pipeline.taken().size(), hardware.pipeline.taken().size());
      for (size_t t = 0; t < bench.pipeline.taken().size(); ++t, ++tests) {
        const LevelTest &a = bench.pipeline.taken()[t], &b = hardware.pipeline.taken()[t];
        EXPECT_EQ(a.object, b.object);
        EXPECT_NEAR(a.coveredPx, b.coveredPx, 2);
        EXPECT_NEAR(a.nextVisiblePx, b.nextVisiblePx, 4);
        visible += a.nextVisiblePx;
      }
    }
    EXPECT_EQ(tests, 15);
    EXPECT_GT(visible, 0);
  }
}

TEST_F(PerceptualLodPicture, IntersectingSurfacesOfTwoLayersMeetWhereTheRasterSaysSo) {
  // Two squares at a slant through each other, and two at the very same place.
  scene::Scene scene = wall(0.2F);
  scene::LodSet left{"left", {{scene::card({-0.1, 0.0, 0.0}, {0.8, 0.0, 0.31}, {0.0, 0.9, 0.0})}}};
  scene::LodSet right{"right", {{scene::card({0.1, 0.0, 0.0}, {0.8, 0.0, -0.27}, {0.0, 0.7, 0.0})}}};
  addSquares(scene, left, {0.0, 0.0, 0.01}, 0.4F);
  addSquares(scene, right, glm::dvec3(0.0), 0.9F);
  addSquares(scene, squares({0.4}), {1.2, 1.2, 0.0}, 0.5F);
  addSquares(scene, squares({0.4}), {1.2, 1.2, 0.0}, 0.7F);
  const PerceptualLodSettings chosen =
      settings(unlit({{"layers", std::string("explicit")}, {"layers.borders", std::string("4.995, 5.1")}}));
  Bench bench(scene, chosen, {101, 99});
  bench.run(1);
  EXPECT_EQ(bench.pipeline.picture().read().data,
            picture(bench, bench.pipeline.shown(), chosen.shading).data);
}

TEST_F(PerceptualLodPicture, ContextOfALayerIsThePictureWithoutItsObjects) {
  const scene::Scene scene = field();
  for (const int64_t layers : {1, 3}) {
    const PerceptualLodSettings chosen = settings({{"layers.count", layers},
                                                   {"tests.threshold_maps", std::string("all")},
                                                   {"start_level", std::string("coarsest")}});
    Bench bench(scene, chosen, {80, 60});
    bench.run(1);
    for (int layer = 1; layer <= layers; ++layer) {
      scene::LodSelection others = bench.pipeline.shown();
      for (size_t i = 0; i < others.levels.size(); ++i)
        if (bench.pipeline.layerOf()[i] == layer) others.levels[i] = scene::LodSelection::kOmitted;
      const perception::Plane wanted =
          perception::luminancePlane(picture(bench, others, chosen.shading), chosen.model.seenOn().display);
      const Image found = bench.pipeline.surroundings(layer).context->read();
      for (size_t i = 0; i < found.data.size(); ++i)
        ASSERT_NEAR(found.data[i], wanted.data[i], 1e-6 * wanted.data[i])
            << "pixel " << i << ", layer " << layer << " of " << layers;
    }
    EXPECT_EQ(bench.pipeline.mapsMade(), static_cast<int>(layers));
  }
}

TEST_F(PerceptualLodPicture, ShadowMaskMarksShadowsOfOtherLayersOnly) {
  // Light from the upper left before the picture; the small square near the camera shadows the large one.
  const auto make = [&](const char* borders) {
    scene::Scene scene = wall(0.5F);
    scene.lights = {scene::lightTowards({-20.0, 20.0, 40.0}, glm::dvec3(0.0), glm::dvec2(0.1))};
    addSquares(scene, squares({2.0}), glm::dvec3(0.0), 0.6F);
    addSquares(scene, squares({0.6}), {-0.5, 0.5, 1.0}, 0.6F);
    const Given given = {{"shading.shadow", true},
                         {"layers", std::string("explicit")},
                         {"layers.borders", std::string(borders)},
                         {"tests.threshold_maps", std::string("all")}};
    return std::pair(std::move(scene), settings(given));
  };
  {
    const auto [scene, chosen] = make("4.5");  // the small square in layer 1, the large one in layer 2
    Bench bench(scene, chosen, {80, 80});
    bench.run(1);
    const Image mask = bench.pipeline.debugViews().at("shadow_mask_2")->read();
    const Image lit = bench.pipeline.debugViews().at("layer_2")->read();
    // The large square alone, without shadows.
    frame::ShadedSetting unshadowed = chosen.shading;
    unshadowed.shadow = false;
    const Image bright = picture(bench, {{0, scene::LodSelection::kOmitted}, false}, unshadowed);
    int marked = 0;
    for (size_t i = 0; i < mask.pixels(); ++i) {
      EXPECT_EQ(mask.data[i] == 1.0F, lit.data[4 * i] < bright.data[4 * i]) << i;
      marked += mask.data[i] == 1.0F;
    }
    // The small square is 0.6 / 4 * 80 = 12 pixels wide on its own plane, its shadow about as wide on the
    // other.
    EXPECT_NEAR(marked, 144, 25);
    const Image none = bench.pipeline.debugViews().at("shadow_mask_1")->read();
    EXPECT_EQ(std::count(none.data.begin(), none.data.end(), 0.0F), static_cast<long>(none.pixels()));
    // C_2 shows the shadow as a pattern: darker by the factor where the mask is set and the layer seen.
    const Image context = bench.pipeline.surroundings(2).context->read();
    const scene::LodSelection all = bench.pipeline.shown();
    const perception::DisplayProfile display = chosen.model.seenOn().display;
    Image without = picture(bench, {{scene::LodSelection::kOmitted, 0}, true}, chosen.shading, 0.0, &all);
    const perception::Plane plain = perception::luminancePlane(without, display);
    for (float& value : without.data) value *= 0.2F;
    const perception::Plane dark = perception::luminancePlane(without, display);
    const std::vector<uint32_t> ids = idsOf(bench, all);
    const scene::TriangleRange large = scene.triangles(scene.lodObjects[0], 0);
    int darkened = 0;
    for (size_t i = 0; i < mask.pixels(); ++i) {
      const bool pattern = mask.data[i] == 1.0F && ids[i] - large.first < large.count;
      const double wanted = pattern ? dark.data[i] : plain.data[i];
      EXPECT_NEAR(context.data[i], wanted, 1e-6 * wanted);
      darkened += pattern;
    }
    EXPECT_GT(darkened, 50);
  }
  {
    const auto [scene, chosen] = make("100");  // both in layer 1
    Bench bench(scene, chosen, {80, 80});
    bench.run(1);
    const Image mask = bench.pipeline.debugViews().at("shadow_mask_1")->read();
    EXPECT_EQ(std::count(mask.data.begin(), mask.data.end(), 0.0F), static_cast<long>(mask.pixels()));
  }
}

TEST_F(PerceptualLodPicture, RectanglesHoldAllPixelsOfTheirObjects) {
  const scene::Scene scene = field();
  const frame::GpuScene gpuScene(scene);
  // Far off, near by, and from among the objects.
  scene::Scene among = scene;
  among.camera.keys = {{0.0, {{0.3, 0.6, -1.0}, {0.0, 0.4, -4.0}}}};
  for (const scene::Scene* each : std::vector<const scene::Scene*>{&scene, &among}) {
    frame::Frame frame(context(), *each, gpuScene, {83, 57}, each->camera.durationS());
    int covered = 0, rectangles = 0;
    for (size_t i = 0; i < each->lodObjects.size(); ++i) {
      frame.setLevels(onlyObject(*each, static_cast<int>(i), 0));
      frame.begin();
      const std::vector<uint32_t> ids = frame.get<frame::TriangleIds>().texture().readUint();
      const PixelRect rect = pixelsOf(each->lodObjects[i].bounds, frame);
      for (int y = 0; y < 57; ++y)
        for (int x = 0; x < 83; ++x) {
          if (ids[static_cast<size_t>(83 * y + x)] == frame::TriangleIds::kNone) continue;
          ++covered;
          EXPECT_TRUE(x >= rect.low.x && y >= rect.low.y && x < rect.high.x && y < rect.high.y);
        }
      rectangles += rect.empty() ? 0 : (rect.high.x - rect.low.x) * (rect.high.y - rect.low.y);
      frame.end();
    }
    EXPECT_GT(covered, 300);
    if (each == &scene) {
      EXPECT_LT(rectangles, 3 * covered);  // and not much more
    }
  }
}

TEST_F(PerceptualLodPicture, MapsAreThoseOfTheReferenceModelForTheContext) {
  const scene::Scene scene = field();
  for (const char* kind : {"bands", "single"}) {
    const PerceptualLodSettings chosen = settings({{"thresholds", std::string(kind)},
                                                   {"layers.count", int64_t{2}},
                                                   {"tests.threshold_maps", std::string("all")}});
    const SeenOn seenOn = chosen.model.seenOn();
    Bench bench(scene, chosen, {80, 60});
    bench.run(1);
    for (int layer = 1; layer <= 2; ++layer) {
      const Image map = bench.pipeline.debugViews().at("threshold_map_" + std::to_string(layer))->read();
      const perception::Plane wanted =
          perception::computeThresholds(
              perception::luminancePlane(bench.pipeline.surroundings(layer).context->read(), seenOn.display),
              seenOn.display, seenOn.thresholds)
              .thresholdCdM2;
      for (size_t i = 0; i < map.pixels(); ++i)
        ASSERT_NEAR(map.data[i], wanted.data[i], 0.005 * wanted.data[i]) << kind << i;  // as both promise
    }
  }
}

}  // namespace
}  // namespace limen::techniques
