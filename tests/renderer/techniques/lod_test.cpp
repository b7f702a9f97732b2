// SPDX-License-Identifier: BSD-3-Clause
// Techniques of levels of detail, and the scenes made for them, as pictures.
#include <cmath>

#include "renderer/frame/motion.h"
#include "renderer/frame/shaded.h"
#include "renderer/scene/lod/aperture.h"
#include "renderer/scene/lod_control.h"
#include "renderer/scene/shapes.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr glm::ivec2 kSize{64, 48};

class LodTest : public TechniqueTest {
 protected:
  /// A registered technique's product at a time, with its counters.
  static Rendered renderAt(const scene::Scene& scene, const std::string& technique, const Given& given,
                           double timeS = 0.0, glm::ivec2 sizePx = kSize) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx, timeS);
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    frame.end();
    Rendered out{made->product().read(), {}, made->count(frame), {}};
    frame.begin();
    made->render(frame);
    frame.end();
    EXPECT_EQ(made->product().read().data, out.product.data) << technique << " does not give the same twice";
    return out;
  }

  static scene::Scene terrain(Given given = {}) {
    given.merge(Given{{"tiles.per_side", int64_t{4}},
                      {"tiles.cells", int64_t{8}},
                      {"tiles.levels", int64_t{3}},
                      {"mountains.azimuths", int64_t{8}}});
    return makeScene("lod/terrain", given);
  }

  static void expectFinite(const Image& image) {
    for (const float value : image.data) ASSERT_TRUE(std::isfinite(value));
  }

  static double largest(const Image& a, const Image& b) {
    double out = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) out = std::max(out, std::abs(double(a.data[i]) - b.data[i]));
    return out;
  }

  static double mean(const Image& a, const Image& b) {
    double out = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) out += std::abs(double(a.data[i]) - b.data[i]);
    return out / static_cast<double>(a.data.size());
  }
};

const std::string kFixed = "fixed";

TEST_F(LodTest, FinestIsTheMeanOfItsSamples) {
  const scene::Scene scene = makeScene("lod/patch");
  const Image one = renderAt(scene, "lod/finest", {{"samples", int64_t{1}}}, 0.0, kSize * 4).product,
              sixteen = renderAt(scene, "lod/finest", {{"samples", int64_t{4}}}).product;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x)
      for (int c = 0; c < 4; ++c) {
        double sum = 0.0;
        for (int k = 0; k < 16; ++k) sum += one.at(4 * x + k % 4, 4 * y + k / 4, c);
        EXPECT_NEAR(sixteen.at(x, y, c), sum / 16.0, 1e-5);
      }
}

TEST_F(LodTest, DiscreteShowsTheFinestAsTheReferenceDoesAndErrsMoreTheCoarser) {
  const scene::Scene scene = makeScene("lod/patch", {{"distance", 2.0}});
  const Image reference = renderAt(scene, "lod/finest", {{"samples", int64_t{1}}}).product;
  double before = 0.0;
  double triangles = 1e9;
  for (int64_t level = 0; level < 3; ++level) {
    const Rendered made = renderAt(scene, "lod/discrete", {{"control", kFixed}, {"control.level", level}});
    const double error = mean(made.product, reference);
    if (level == 0) {
      EXPECT_EQ(made.product.data, reference.data);
    } else {
      EXPECT_GT(error, before);
    }
    EXPECT_LT(made.counter("triangles_drawn"), triangles);
    EXPECT_EQ(made.counter("level_mean"), level);
    triangles = made.counter("triangles_drawn");
    before = error;
  }
  EXPECT_EQ(triangles, 8.0);
}

TEST_F(LodTest, DistanceSwitchesWhereTheSceneSaysAndCountsItsSwitches) {
  // From 5 to 2 in 3 s at 1 unit a second; switches at 4.25 and 2.125 * 1.25...: 3 and 4.25.
  const scene::Scene scene = makeScene("lod/patch", {{"distance", 5.0},
                                                     {"motion.speed", 1.0},
                                                     {"motion.duration_s", 3.0},
                                                     {"switching.distance", 3.0},
                                                     {"switching.growth", 1.5}});
  const auto level = [&](double timeS) {
    return renderAt(scene, "lod/discrete", {}, timeS).counter("level_mean");
  };
  EXPECT_EQ(level(0.49), 2.0);  // 4.51
  EXPECT_EQ(level(0.51), 1.0);  // 4.49
  EXPECT_EQ(level(1.99), 1.0);
  EXPECT_EQ(level(2.01), 0.0);
  EXPECT_EQ(renderAt(scene, "lod/discrete", {}).counter("level_switches"), 2.0);
  EXPECT_EQ(renderAt(scene, "lod/discrete", {{"control", kFixed}}).counter("level_switches"), 0.0);
  EXPECT_EQ(renderAt(scene, "lod/discrete", {{"control.factor", 100.0}}).counter("level_mean"), 0.0);
}

TEST_F(LodTest, ScreenErrorControlKeepsItsTolerance) {
  const scene::Scene scene = terrain();
  for (const double tolerance : {0.0, 0.5, 4.0}) {
    const Rendered made = renderAt(scene, "lod/discrete",
                                   {{"control", std::string("error")}, {"control.tolerance_px", tolerance}});
    EXPECT_LE(made.counter("screen_error_px"), tolerance);
    if (tolerance == 0.0) {
      EXPECT_EQ(made.counter("level_mean"), 0.0);
    } else {
      expectFinite(made.product);
    }
  }
}

TEST_F(LodTest, ImageSpaceBlendIsTheMixOfBothLevels) {
  const scene::Scene scene = makeScene("lod/patch", {{"distance", 2.0}});
  const Image a = renderAt(scene, "lod/discrete", {{"control", kFixed}, {"control.level", int64_t{0}}}).product,
              b = renderAt(scene, "lod/discrete", {{"control", kFixed}, {"control.level", int64_t{2}}}).product;
  for (const int64_t number : {0, 3, 8, 16, 20}) {
    const Rendered made = renderAt(scene, "lod/blend", {{"to_level", int64_t{2}}, {"frame", number}});
    const double weight = std::min(static_cast<double>(number) / 16.0, 1.0);
    EXPECT_EQ(made.counter("new_level_weight"), weight);
    EXPECT_EQ(made.counter("triangles_drawn"), 162.0 + 8.0);
    for (size_t i = 0; i < a.data.size(); ++i)
      EXPECT_NEAR(made.product.data[i], (1.0 - weight) * a.data[i] + weight * b.data[i], 1e-6);
  }
}

TEST_F(LodTest, AlternatingBlendCopiesTheRightShareFromTheRightFrame) {
  const scene::Scene scene =
      makeScene("lod/patch", {{"distance", 2.0}, {"motion.speed", 5.0}, {"motion", std::string("horizontal")}});
  const double time = 0.2, before = time - 1.0 / 60.0;
  for (const int64_t number : {0, 5, 8, 13, 16}) {
    const bool newIsNow = number % 2 == 1;
    const Image old = renderAt(scene, "lod/discrete", {{"control", kFixed}, {"control.level", int64_t{0}}},
                               newIsNow ? before : time)
                          .product;
    const Image fresh = renderAt(scene, "lod/discrete", {{"control", kFixed}, {"control.level", int64_t{2}}},
                                 newIsNow ? time : before)
                            .product;
    const Rendered made =
        renderAt(scene, "lod/blend",
                 {{"mode", std::string("alternating")}, {"to_level", int64_t{2}}, {"frame", number}}, time);
    EXPECT_EQ(made.counter("triangles_drawn"), newIsNow ? 8.0 : 162.0);
    // Every 8 x 8 tile takes exactly 4 of its 64 pixels from the new level for each 16th of the blend; which
    // ones shows where the two differ.
    for (int ty = 0; ty < kSize.y / 8; ++ty)
      for (int tx = 0; tx < kSize.x / 8; ++tx) {
        int surelyNew = 0, surelyOld = 0;
        for (int k = 0; k < 64; ++k) {
          const int x = 8 * tx + k % 8, y = 8 * ty + k / 8;
          const float p = made.product.at(x, y), o = old.at(x, y), n = fresh.at(x, y);
          EXPECT_TRUE(p == o || p == n);
          surelyNew += p == n && p != o;
          surelyOld += p == o && p != n;
        }
        EXPECT_LE(surelyNew, 4 * number);
        EXPECT_LE(surelyOld, 64 - 4 * number);
      }
  }
}

TEST_F(LodTest, ReprojectionMakesAStillWorldStill) {
  // Both levels the same: a blend must show the frame itself, moving or not, but for what was hidden or
  // outside.
  const scene::Scene scene = makeScene(
      "lod/patch",
      {{"contrast", 1.0}, {"distance", 3.0}, {"motion.speed", 6.0}, {"motion", std::string("horizontal")}});
  const Image now = renderAt(scene, "lod/discrete", {{"control", kFixed}}, 0.1).product;
  const auto error = [&](bool reproject) {
    return mean(
        renderAt(scene, "lod/blend",
                 {{"mode", std::string("alternating")}, {"to_level", int64_t{0}}, {"mode.reproject", reproject}},
                 0.1)
            .product,
        now);
  };
  EXPECT_LT(error(true), 0.5 * error(false));
}

TEST_F(LodTest, GeomorphBeginsAsItsLevelAndEndsAsTheNext) {
  for (const scene::Scene& scene :
       {terrain({{"contrast", 0.0}}), makeScene("lod/patch", {{"distance", 2.0}})}) {
    const Given flat{{"shading.smooth_normals", false}, {"control", kFixed}};
    const auto with = [&](Given given) {
      given.insert(flat.begin(), flat.end());
      return given;
    };
    const Image fine = renderAt(scene, "lod/discrete", with({{"control.level", int64_t{0}}})).product,
                coarse = renderAt(scene, "lod/discrete", with({{"control.level", int64_t{1}}})).product,
                start =
                    renderAt(scene, "lod/geomorph", with({{"control.level", int64_t{0}}, {"control.morph", 0.0}})).product,
                half = renderAt(scene, "lod/geomorph", with({{"control.level", int64_t{0}}, {"control.morph", 0.5}})).product,
                end = renderAt(scene, "lod/geomorph", with({{"control.level", int64_t{0}}, {"control.morph", 1.0}})).product;
    EXPECT_EQ(start.data, fine.data);
    EXPECT_GT(mean(fine, coarse), 1e-3);
    if (scene.name == "lod/patch") {
      // The same surface in other triangles, flatly shaded: rounding, and pixels on a silhouette or a crease.
      size_t different = 0;
      for (size_t i = 0; i < end.pixels(); ++i)
        different += std::abs(end.data[4 * i] - coarse.data[4 * i]) > 1e-3;
      EXPECT_LE(different, end.pixels() / 100);
    } else {
      // Apertures of terrain stay those of the finer level.
      EXPECT_LT(mean(end, coarse), 0.6 * mean(fine, coarse));
    }
    EXPECT_GT(mean(half, fine), 0.0);
    expectFinite(half);
  }
}

TEST_F(LodTest, GeomorphFollowsDistance) {
  const scene::Scene scene = makeScene("lod/patch", {{"distance", 5.0},
                                                     {"motion.speed", 1.0},
                                                     {"motion.duration_s", 4.0},
                                                     {"switching.distance", 4.0},
                                                     {"switching.growth", 10.0}});
  const auto morph = [&](double timeS) {
    return renderAt(scene, "lod/geomorph", {{"control.range", 0.25}}, timeS).counter("morph_mean");
  };
  EXPECT_EQ(morph(0.0), 0.0);            // 5: level 1, whose switch at 40 is far
  EXPECT_NEAR(morph(1.25), 0.75, 1e-9);  // 3.75, three quarters of the way from 3 to 4
  EXPECT_EQ(morph(2.5), 0.0);            // 2.5
}

class TerrainTest : public LodTest {
 protected:
  static constexpr glm::ivec2 kView{128, 96};

  static std::vector<uint32_t> ids(const scene::Scene& scene, const frame::GpuScene& gpuScene,
                                   const scene::LodSelection& selection) {
    frame::Frame frame(context(), scene, gpuScene, kView);
    frame.setLevels(selection);
    frame.begin();
    std::vector<uint32_t> out = frame.get<frame::TriangleIds>().texture().readUint();
    frame.end();
    return out;
  }

  /// Background that terrain surrounds, over random views from above the ground and random levels. Looking
  /// down, the whole picture is terrain. Looking level, a picture's columns are upright planes, in which
  /// nothing may show below the silhouette of a surface without holes.
  static size_t cracks(bool skirts) {
    scene::Scene scene = terrain({{"tiles.skirts", skirts}});
    scene::Random random(7);
    size_t found = 0;
    for (int view = 0; view < 40; ++view) {
      const bool level = view % 2 == 0;
      scene::Camera camera;
      const double azimuth = random.uniform(0.0, 6.2832);
      camera.eye = {random.uniform(-2.0, 2.0), 3.0, random.uniform(-2.0, 2.0)};
      camera.target = camera.eye + glm::dvec3(std::cos(azimuth), level ? 0.0 : random.uniform(-2.0, -1.2),
                                              std::sin(azimuth));
      camera.verticalFovDeg = level ? 100.0 : 40.0;
      scene.camera.keys = {{0.0, camera}};
      const frame::GpuScene gpuScene(scene);
      scene::LodSelection selection;
      for (const scene::LodObject& object : scene.lodObjects)
        selection.levels.push_back(
            static_cast<int>(random.uniform(0.0, double(object.levels.size()) - 1e-9)));
      const std::vector<uint32_t> seen = ids(scene, gpuScene, selection);
      for (int x = 0; x < kView.x; ++x) {
        bool below = !level;
        for (int y = 0; y < kView.y; ++y) {
          const bool nothing = seen[static_cast<size_t>(y * kView.x + x)] == frame::TriangleIds::kNone;
          found += nothing && below;
          below = below || !nothing;
        }
      }
    }
    return found;
  }
};

TEST_F(TerrainTest, ShowsNoCrackWhateverTheLevels) { EXPECT_EQ(cracks(true), 0U); }

TEST_F(TerrainTest, WithoutSkirtsTheSameViewsShowCracks) { EXPECT_GT(cracks(false), 20U); }

TEST_F(TerrainTest, IsLitAsApertureLightSaysInDoublePrecision) {
  for (const double elevation : {8.0, 30.0}) {
    const scene::Scene scene =
        terrain({{"contrast", 0.0}, {"sun.elevation_deg", elevation}, {"sun.radius_deg", 3.0}});
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, kView);
    frame.begin();
    const std::vector<uint32_t> seen = frame.get<frame::TriangleIds>().texture().readUint();
    const Image position = frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Position})
                               .texture()
                               .read(),
                colour = frame.get<frame::Shaded>(frame::ShadedSetting{}).texture().read();
    frame.end();
    const glm::dvec3 light = scene.lights[0].centre;
    const double radius = std::atan2(0.5 * scene.lights[0].size.x, glm::length(light - gpuScene.anchor()));
    size_t compared = 0, shaded = 0, lit = 0;
    for (int y = 0; y < kView.y; ++y)
      for (int x = 0; x < kView.x; ++x) {
        const uint32_t id = seen[static_cast<size_t>(y * kView.x + x)];
        if (id == frame::TriangleIds::kNone) continue;
        const glm::dvec3 p =
            glm::dvec3(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2)) + gpuScene.anchor();
        const glm::uvec3 t = scene.mesh.triangles[id];
        const glm::dvec3 a = scene.mesh.positions[t.x], e1 = scene.mesh.positions[t.y] - a,
                         e2 = scene.mesh.positions[t.z] - a, n = glm::cross(e1, e2);
        const double v = glm::dot(glm::cross(p - a, e2), n) / glm::dot(n, n),
                     w = glm::dot(glm::cross(e1, p - a), n) / glm::dot(n, n);
        const auto mix = [&](auto values) {
          return (1.0 - v - w) * values(t.x) + v * values(t.y) + w * values(t.z);
        };
        const glm::dvec3 normal =
            glm::normalize(mix([&](uint32_t i) { return glm::dvec3(scene.mesh.normals[i]); }));
        scene::Aperture aperture;
        aperture.axis = glm::normalize(mix([&](uint32_t i) { return glm::dvec3(scene.mesh.attributes[i]); }));
        aperture.angleRad = mix([&](uint32_t i) { return double(scene.mesh.attributes[i].w); });
        if (glm::dot(n, frame.camera().eye - p) <= 0.0) continue;  // a skirt or a fold seen from behind
        const glm::dvec3 toSun = glm::normalize(light - p);
        const scene::ApertureLight through = scene::apertureLight(aperture, normal, toSun, radius);
        const double expected = scene.materials[0].albedo.x * (0.2 * through.sky + 0.8 * through.sun);
        // Float places a point in its triangle to a few 2^-23 of distance over edge, more at grazing
        // incidence, and the cone turns by up to a quarter circle over a triangle; the sun's share changes by
        // at most 2 / (pi r) a radian. The plane approximation of a narrow segment is right to 1e-4 for 3
        // degrees.
        const glm::dvec3 view = frame.camera().eye - p;
        const double cosine = glm::dot(glm::normalize(n), glm::normalize(view));
        const double place = 4.0 * 0x1p-23 * glm::length(view) / glm::length(e1) / cosine;
        const double tolerance =
            0.8 * scene.materials[0].albedo.x * (2.0 / (M_PI * radius) * 1.57 * place + 1e-4);
        EXPECT_NEAR(colour.at(x, y), expected, tolerance) << x << ' ' << y;
        ++compared;
        shaded += through.sun < 0.01;
        lit += through.sun > 0.1;
      }
    EXPECT_GT(compared, 3000U);
    EXPECT_GT(lit, 100U);
    if (elevation < 10.0) {
      EXPECT_GT(shaded, 300U);
    }
  }
}

TEST_F(LodTest, SmallImagesFarPlacesAndScalesStayFiniteAndAlike) {
  const Image plain = renderAt(makeScene("lod/patch"), "lod/discrete", {}).product;
  for (const Given& where : {Given{{"offset", 1e5}}, Given{{"scale", 1e-4}}, Given{{"scale", 1e4}}}) {
    const Rendered made = renderAt(makeScene("lod/patch", where), "lod/discrete", {});
    expectFinite(made.product);
    // The same picture but for pixels on silhouettes.
    EXPECT_LT(mean(made.product, plain), 0.002);
    EXPECT_EQ(made.counter("level_mean"),
              renderAt(makeScene("lod/patch"), "lod/discrete", {}).counter("level_mean"));
  }
  for (const std::string technique : {"lod/finest", "lod/discrete", "lod/blend", "lod/geomorph"})
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(1, 13)})
      for (const scene::Scene& scene : {makeScene("lod/patch"), terrain()})
        expectFinite(renderAt(scene, technique, {}, 0.0, size).product);
}

TEST_F(LodTest, TooManySamplesForTheDriverAreRefused) {
  const scene::Scene scene = makeScene("lod/patch");
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {8000, 2});
  const TechniqueInfo& info = TechniqueRegistry::instance().get("lod/finest");
  const auto made = info.make(ParameterValues(info.parameters, {{"samples", int64_t{16}}}));
  EXPECT_THROW(made->prepare(frame), Error);
}

}  // namespace
}  // namespace limen::techniques
