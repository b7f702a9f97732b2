// SPDX-License-Identifier: BSD-3-Clause
// Backprojection with each acceleration structure, against search areas that are narrowed on the CPU texel by
// texel.
#include <algorithm>
#include <cmath>

#include "renderer/techniques/soft_shadows/pixel_counts.h"
#include "renderer/techniques/soft_shadows/search_settings.h"
#include "tests/renderer/frame/depth_pyramid.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char* kStructures[] = {"hsm", "ysm", "n_buffer", "mssm"};

/// A rendered technique with all that its choices follow from.
struct Searched {
  Image visibility, receivers, map;
  frame::LightFrustum frustum;
  glm::dvec2 lightSize;
  PixelCounts counted;
  std::map<std::string, double> counters;

  PixelClass kind(size_t pixel) const { return static_cast<PixelClass>(counted.work[4 * pixel]); }
};

/// What is known of a point once its search area has been narrowed until it stays as it is.
/// Rounding: the area is so narrow that float may see another.
enum class Truth { Lit, Umbra, Penumbra, Rounding };

class AccelerationStructures : public TechniqueTest {
 protected:
  static Searched search(const scene::Scene& scene, const std::string& technique, const Given& given,
                         glm::ivec2 sizePx) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    const ParameterValues values(info.parameters, given);
    const auto made = info.make(values);
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    const auto& pyramid = frame.get<frame::MinMaxPyramid>(
        frame::ShadowMapSettings{SearchSettings::table().read(values).map.resolution});
    Searched out{made->product().read(),
                 frame.get<frame::Receivers>().texture().read(),
                 pyramid.minimum().read(),
                 pyramid.frustum(),
                 scene.lights[0].size,
                 {},
                 {}};
    frame.end();
    for (const Counter& counter : made->count(frame)) out.counters[counter.name] = counter.value;
    out.counted = dynamic_cast<const CountsPixels&>(*made).counted();
    return out;
  }

  /// A texel blocks a point if its depth is smaller, in float as in double: no biases. The hybrid's layers
  /// have a quarter of the map's resolution.
  static Given unbiased(const std::string& structure, const std::string& gapFill = "none") {
    Given given = {{"structure", structure}, {"resolution", int64_t{256}}, {"budget.limit", int64_t{0}},
                   {"bias.constant", 0.0},   {"bias.slope", 0.0},          {"occluders.gap_fill", gapFill}};
    if (structure == "ysm") given["structure.base"] = int64_t{64};
    return inThesisForm(given);
  }

  /// Narrows the cut of the pyramid from point to light until its nearest texel no longer lets it shrink.
  static Truth narrowed(const Searched& searched, glm::dvec3 p) {
    const int resolution = searched.map.width;
    const glm::dvec2 texel = (searched.frustum.high - searched.frustum.low) / double(resolution);
    double nearest = frame::rangeOf(searched.map, {0, 0}, {resolution, resolution}).x;
    for (;;) {
      if (nearest >= p.z) return Truth::Lit;
      const glm::dvec2 centre = glm::dvec2(p) / p.z;
      const glm::dvec2 half = 0.5 * searched.lightSize * (1.0 / nearest - 1.0 / p.z);
      if (glm::any(glm::lessThan(half / texel, glm::dvec2(2e-3)))) return Truth::Rounding;
      // Texels of which the cut holds more than float could lose.
      const glm::dvec2 low = glm::floor((centre - half - searched.frustum.low) / texel + 1e-3),
                       high = glm::ceil((centre + half - searched.frustum.low) / texel - 1e-3);
      const glm::ivec2 from = glm::clamp(low, 0.0, double(resolution)),
                       to = glm::clamp(high, 0.0, double(resolution));
      if (from.x >= to.x || from.y >= to.y) return Truth::Lit;
      const glm::vec2 range = frame::rangeOf(searched.map, from, to);
      if (range.x >= p.z) return Truth::Lit;
      const bool inside = glm::dvec2(from) == low && glm::dvec2(to) == high;
      if (range.y < p.z && inside) return Truth::Umbra;
      if (range.x <= nearest) return Truth::Penumbra;
      nearest = range.x;
    }
  }
};

TEST_F(AccelerationStructures, CallOnlyThoseLitOrInUmbraThatAre) {
  for (const char* name : {"sphere_grid", "comb", "box_under_light", "two_boxes"}) {
    const scene::Scene scene = makeScene(name);
    std::map<std::string, double> found, processed;
    std::vector<Truth> truth;
    for (const char* structure : kStructures) {
      const Searched searched = search(scene, "soft_shadows/backprojection", unbiased(structure), {64, 48});
      if (truth.empty())
        for (size_t i = 0; i < searched.visibility.pixels(); ++i)
          truth.push_back(
              narrowed(searched, {searched.receivers.data[4 * i], searched.receivers.data[4 * i + 1],
                                  searched.receivers.data[4 * i + 2]}));
      int clear = 0, clearFound = 0;
      for (size_t i = 0; i < truth.size(); ++i) {
        const PixelClass kind = searched.kind(i);
        if (kind == NotReceiver || truth[i] == Truth::Rounding) continue;
        if (kind == Lit || kind == Outside) {
          ASSERT_EQ(truth[i], Truth::Lit) << name << ' ' << structure << " pixel " << i;
        }
        if (kind == Umbra) {
          ASSERT_EQ(truth[i], Truth::Umbra) << name << ' ' << structure << " pixel " << i;
        }
        clear += truth[i] != Truth::Penumbra;
        clearFound += truth[i] != Truth::Penumbra && kind != Processed;
      }
      ASSERT_GT(clear, 1000) << name;
      found[structure] = double(clearFound) / clear;
      processed[structure] = searched.counters.at("processed_share");
      RecordProperty(std::string(name) + "_" + structure + "_found", std::to_string(found[structure]));
      RecordProperty(std::string(name) + "_" + structure + "_processed",
                     std::to_string(processed[structure]));
    }
    // The tighter the depth ranges, the more of what needs no work is found.
    EXPECT_LE(found["hsm"], found["ysm"]) << name;
    EXPECT_LE(found["ysm"], found["mssm"]) << name;
    EXPECT_GE(processed["hsm"], processed["ysm"]) << name;
    EXPECT_GE(processed["ysm"], processed["mssm"]) << name;
  }
}

// What a structure may change of a picture without a budget. Outside of the umbra nothing: texels beyond the
// narrowed area miss the light, with or without stretching to the left and the bottom. (Stretched to the
// diagonal, a texel outside of the area can reach into it.) In umbra all texels of the area block, and
// visibility is taken as 0: true where their patches leave no gap, that is when they are stretched in all
// three directions.
TEST_F(AccelerationStructures, LeaveVisibilityAsItIsWithoutThem) {
  struct Tried {
    const char* technique;
    double step;  // the least amount by which rounding can change visibility
  };
  for (const Tried& tried :
       {Tried{"soft_shadows/backprojection", 1e-5}, Tried{"soft_shadows/bitmask", 1.0 / 256.0}})
    for (const char* name : {"sphere_grid", "comb", "two_boxes"}) {
      const scene::Scene scene = makeScene(name);
      for (const char* fill : {"none", "left_bottom", "diagonal"}) {
        const Searched without = search(scene, tried.technique, unbiased("none", fill), {64, 48});
        const bool hasGaps = std::string(fill) != "diagonal";
        for (const char* structure : kStructures) {
          const Searched searched = search(scene, tried.technique, unbiased(structure, fill), {64, 48});
          int umbra = 0, processed = 0;
          for (size_t i = 0; i < searched.visibility.pixels(); ++i) {
            // With gaps the umbra is left out, without them it alone is compared.
            if (hasGaps == (searched.kind(i) == Umbra)) continue;
            ASSERT_NEAR(searched.visibility.data[i], without.visibility.data[i], tried.step + 1e-6)
                << tried.technique << ' ' << name << ' ' << fill << ' ' << structure << " pixel " << i;
          }
          for (size_t i = 0; i < searched.visibility.pixels(); ++i) {
            umbra += searched.kind(i) == Umbra;
            processed += searched.kind(i) == Processed;
          }
          EXPECT_GT(umbra, 100);
          EXPECT_GT(processed, 100);
        }
      }
    }
}

/// A rectangle far from the border of its shadow map, which four specks at the same height widen. Its
/// penumbra is linear in x and in z: 1/2 -+ distance to the edge times (H - h) / (h w).
scene::Scene rectangleAmidItsMap() {
  const scene::SceneInfo& info = scene::SceneRegistry::instance().get("parallel_rectangle");
  scene::Scene scene = scene::buildScene("parallel_rectangle", ParameterValues(info.allParameters(), {}));
  const double height = std::get<double>(ParameterValues(info.allParameters(), {}).all().at("height"));
  scene::Part part = scene.parts.back();
  part.name = "specks";
  part.firstTriangle = static_cast<uint32_t>(scene.mesh.triangles.size());
  part.triangleCount = 4;
  for (const glm::dvec2 at :
       {glm::dvec2(-1.8), glm::dvec2(1.8, -1.8), glm::dvec2(-1.8, 1.8), glm::dvec2(1.8)}) {
    const auto first = static_cast<uint32_t>(scene.mesh.positions.size());
    for (const glm::dvec2 corner : {glm::dvec2(0.0), glm::dvec2(0.0, 0.01), glm::dvec2(0.01, 0.0)})
      scene.mesh.positions.emplace_back(at.x + corner.x, height, at.y + corner.y);
    scene.mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  scene.parts.push_back(part);
  return scene;
}

// Figures 4.8 and 4.9 of the thesis. A processed pixel next to a lit one can be darker than it by the
// penumbra's slope over the distance between the two, and by no more, whatever the level: coarse
// micro-occluders are larger rectangles at the same depth. The discontinuity is what it is darker beyond
// that.
TEST_F(AccelerationStructures, GrowthOfTheSearchAreaClosesTheSeamBesideLitPixels) {
  const scene::Scene scene = rectangleAmidItsMap();
  const double H = scene.lights[0].centre.y, h = 0.7;
  const glm::dvec2 slope = (H - h) / (h * scene.lights[0].size);
  const glm::dmat4 fromLight = glm::inverse(scene.lights[0].toLightSpace());
  for (const char* structure : {"mssm", "n_buffer", "ysm"})
    for (const bool growth : {true, false}) {
      // 21 texels at most are searched along x, which is 4 micro-occluders of level 3, and more than 4 of
      // level 2.
      const Searched searched = search(scene, "soft_shadows/backprojection",
                                       {{"structure", std::string(structure)},
                                        {"resolution", int64_t{512}},
                                        {"budget.limit", int64_t{16}},
                                        {"occluders.division", std::string("levels")},
                                        {"structure.growth", growth}},
                                       {192, 144});
      const auto worldOf = [&](size_t i) {
        const float* p = &searched.receivers.data[4 * i];
        return glm::dvec3(fromLight * glm::dvec4(p[0], p[1], p[2], 1.0));
      };
      double discontinuity = -1.0;
      int pairs = 0;
      const Image& v = searched.visibility;
      for (int y = 1; y + 1 < v.height; ++y)
        for (int x = 1; x + 1 < v.width; ++x)
          for (const glm::ivec2 step :
               {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
            const auto lit = static_cast<size_t>(y * v.width + x),
                       dark = static_cast<size_t>((y + step.y) * v.width + x + step.x);
            if (searched.kind(lit) != Lit || searched.kind(dark) != Processed) continue;
            const glm::dvec3 from = worldOf(lit), to = worldOf(dark);
            if (std::max(from.y, to.y) > 1e-3 || std::max(std::abs(to.x), std::abs(to.z)) > 1.2) continue;
            EXPECT_EQ(searched.counted.work[4 * dark + 3], 3U);
            const double allowed = std::abs(to.x - from.x) * slope.x + std::abs(to.z - from.z) * slope.y;
            discontinuity = std::max(discontinuity, 1.0 - v.data[dark] - allowed);
            ++pairs;
          }
      RecordProperty(std::string(structure) + (growth ? "_grown" : "_not_grown"),
                     std::to_string(discontinuity));
      EXPECT_GT(pairs, 50) << structure;
      if (growth) {
        EXPECT_LT(discontinuity, 1e-3) << structure;
      } else {
        EXPECT_GT(discontinuity, 0.1) << structure;
      }
    }
}

}  // namespace
}  // namespace limen::techniques
