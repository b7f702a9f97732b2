// SPDX-License-Identifier: BSD-3-Clause
// Depth ranges of areas as the structures give them, against a look at every texel.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/multi_scale_map.h"
#include "renderer/gl/buffer.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "tests/renderer/frame/depth_pyramid.h"
#include "tests/renderer/techniques/readback_bindings.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

struct Tested {
  const char* name;
  gl::ShaderDefines defines;
  bool hasLayers;
  bool isCorner = false;
  bool isHybrid = false;
};

const std::vector<Tested>& testedStructures() {
  static const std::vector<Tested> kAll = {
      {"hsm", {{"STRUCTURE_HSM", "1"}}, false},
      {"ysm", {{"STRUCTURE_YSM", "1"}}, true, false, true},
      {"n_buffer", {{"STRUCTURE_WINDOWS", "1"}, {"CORNER", "1"}}, true, true},
      {"mssm", {{"STRUCTURE_WINDOWS", "1"}}, true}};
  return kAll;
}

class DepthBounds : public TechniqueTest {
 protected:
  /// What `structure` says of each area (low.x, low.y, high.x, high.y; high exclusive).
  static std::vector<glm::vec2> ask(const Tested& structure, const Image& map,
                                    const std::vector<glm::ivec4>& areas, bool rough) {
    const frame::DepthPyramid pyramid(map);
    const gl::Buffer in(areas), out(static_cast<int64_t>(areas.size()) * 8, nullptr);
    const gl::Program& program = context().programs().compute(
        "tests/renderer/techniques/depth_bounds_readback.comp.glsl", structure.defines);
    // A hybrid whose layers have a quarter of the map's resolution.
    const int baseLevel = structure.isHybrid ? std::min(2, pyramid.levels() - 1) : 0;
    std::unique_ptr<frame::MultiScaleLayers> layers;
    if (structure.hasLayers) {
      layers = std::make_unique<frame::MultiScaleLayers>(
          context(), map.width >> baseLevel,
          structure.isCorner ? frame::WindowAnchor::Corner : frame::WindowAnchor::Centre);
      layers->build(pyramid.minimum(), pyramid.maximum(), baseLevel);
      layers->texture().bindTexture(kMultiScaleMapUnit);
    }
    pyramid.minimum().bindTexture(kMinimumMapUnit);
    pyramid.maximum().bindTexture(kMaximumMapUnit);
    in.bindStorage(kDepthBoundsReadbackAreasBuffer);
    out.bindStorage(kDepthBoundsReadbackRangesBuffer);
    program.set("count", static_cast<int>(areas.size()));
    program.set("rough", rough ? 1 : 0);
    program.set("baseLevel", baseLevel);
    program.dispatch({static_cast<int>(areas.size()), 1}, {64, 1});
    return out.read<glm::vec2>();
  }

  /// Texels that each area's range speaks for, found without knowing how: in a map that grows along one axis
  /// the range's ends name the first and the last column, in one that grows along the other the rows.
  static std::vector<double> texelsSpokenFor(const Tested& structure, int resolution,
                                             const std::vector<glm::ivec4>& areas, bool rough) {
    Image columns(resolution, resolution, 1), rows(resolution, resolution, 1);
    for (int y = 0; y < resolution; ++y)
      for (int x = 0; x < resolution; ++x)
        columns.at(x, y) = static_cast<float>(x), rows.at(x, y) = static_cast<float>(y);
    const std::vector<glm::vec2> u = ask(structure, columns, areas, rough),
                                 v = ask(structure, rows, areas, rough);
    std::vector<double> out;
    for (size_t i = 0; i < areas.size(); ++i)
      out.push_back(double(u[i].y - u[i].x + 1.0F) * double(v[i].y - v[i].x + 1.0F));
    return out;
  }

  /// Areas of every size and place: all of them in small maps, a sample in larger ones, among it borders,
  /// single texels, long strips and the whole map.
  static std::vector<glm::ivec4> areasOf(int resolution) {
    std::vector<glm::ivec4> out;
    if (resolution <= 8) {
      for (int y0 = 0; y0 < resolution; ++y0)
        for (int y1 = y0 + 1; y1 <= resolution; ++y1)
          for (int x0 = 0; x0 < resolution; ++x0)
            for (int x1 = x0 + 1; x1 <= resolution; ++x1) out.emplace_back(x0, y0, x1, y1);
      return out;
    }
    std::mt19937 random(20260103);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int i = 0; i < 6000; ++i) {
      // Extents uniform in their logarithm, so that small ones occur as often as large ones.
      glm::ivec2 extent, low;
      for (int axis = 0; axis < 2; ++axis) {
        extent[axis] = std::min(resolution, 1 + below(1 << (1 + below(7))));
        low[axis] = below(resolution - extent[axis] + 1);
        if (below(8) == 0) low[axis] = 0;
        if (below(8) == 0) low[axis] = resolution - extent[axis];
      }
      out.emplace_back(low, low + extent);
    }
    out.emplace_back(0, 0, resolution, resolution);
    for (int at = 0; at < resolution; ++at) {
      out.emplace_back(0, at, resolution, at + 1);
      out.emplace_back(at, 0, at + 1, resolution);
      out.emplace_back(at, at, at + 1, at + 1);
    }
    return out;
  }

  static std::map<std::string, Image> mapsOf(int resolution) {
    std::mt19937 random(static_cast<unsigned>(resolution));
    std::uniform_real_distribution<float> depth(0.5F, 40.0F);
    std::map<std::string, Image> out;
    Image map(resolution, resolution, 1);
    for (float& z : map.data) z = depth(random);
    out["random"] = map;
    for (int y = 0; y < resolution; ++y)
      for (int x = 0; x < resolution; ++x) map.at(x, y) = x + 2 * y < resolution ? 1.0F : 7.0F;
    out["step"] = map;
    std::fill(map.data.begin(), map.data.end(), 5.0F);
    map.at(0, resolution - 1) = 1.0F;
    map.at(resolution / 2, resolution / 2) = 2.0F;
    map.at(resolution - 1, resolution / 3) = 9.0F;
    out["single_texels"] = map;
    std::fill(map.data.begin(), map.data.end(), frame::kEmptyDepth);
    out["empty"] = map;
    for (int i = 0; i < resolution; ++i)
      map.at(i, 0) = map.at(i, resolution - 1) = map.at(0, i) = map.at(resolution - 1, i) = 3.0F;
    out["border"] = map;
    return out;
  }
};

TEST_F(DepthBounds, HoldEveryTexelOfTheAreaAndNothingThatTheMapLacks) {
  for (const int resolution : {1, 2, 8, 64}) {
    const std::vector<glm::ivec4> areas = areasOf(resolution);
    for (const auto& [name, map] : mapsOf(resolution))
      for (const Tested& structure : testedStructures())
        for (const bool rough : {false, true}) {
          const std::vector<glm::vec2> ranges = ask(structure, map, areas, rough);
          const glm::vec2 whole = frame::rangeOf(map, {0, 0}, {resolution, resolution});
          int wrong = 0;
          for (size_t i = 0; i < areas.size(); ++i) {
            const glm::ivec4 a = areas[i];
            const glm::vec2 truth = frame::rangeOf(map, {a.x, a.y}, {a.z, a.w});
            const bool holds = ranges[i].x <= truth.x && ranges[i].y >= truth.y;
            const bool isOfTheMap = ranges[i].x >= whole.x && ranges[i].y <= whole.y;
            if ((!holds || !isOfTheMap) && ++wrong < 4)
              ADD_FAILURE() << structure.name << (rough ? " rough, " : ", ") << name << " of " << resolution
                            << ", area " << a.x << ' ' << a.y << ' ' << a.z << ' ' << a.w << ": "
                            << ranges[i].x << ".." << ranges[i].y << " for " << truth.x << ".." << truth.y;
          }
          EXPECT_EQ(wrong, 0);
        }
  }
}

TEST_F(DepthBounds, FourSquaresAreExactForAreasThatTheyTile) {
  // Areas whose axes are within a factor of two of each other: four squares of the power of two below the
  // longer axis cover such an area and nothing else, wherever it lies. The structures with all layers give
  // its very range.
  const int resolution = 64;
  const std::vector<glm::ivec4> areas = areasOf(resolution);
  const Image map = mapsOf(resolution).at("random");
  for (const Tested& structure : testedStructures()) {
    if (!structure.hasLayers || structure.isHybrid) continue;
    const std::vector<glm::vec2> ranges = ask(structure, map, areas, false);
    int tiled = 0;
    for (size_t i = 0; i < areas.size(); ++i) {
      const glm::ivec4 a = areas[i];
      const int longer = std::max(a.z - a.x, a.w - a.y), shorter = std::min(a.z - a.x, a.w - a.y);
      int size = 1;
      while (2 * size < longer) size *= 2;
      if (shorter < size) continue;
      ++tiled;
      ASSERT_EQ(ranges[i], frame::rangeOf(map, {a.x, a.y}, {a.z, a.w}))
          << structure.name << " area " << a.x << ' ' << a.y << ' ' << a.z << ' ' << a.w;
    }
    EXPECT_GT(tiled, 1000);
  }
}

// Figure 4.7 of the thesis: past the lower borders an N-buffer has no window, and takes one that begins at
// the border.
TEST_F(DepthBounds, TheMultiScaleMapIsNoLooserThanTheNBufferAndTighterAtTheLowerBorders) {
  const int resolution = 64;
  const std::vector<glm::ivec4> areas = areasOf(resolution);
  const std::vector<double> corner = texelsSpokenFor(testedStructures()[2], resolution, areas, true),
                            centre = texelsSpokenFor(testedStructures()[3], resolution, areas, true);
  int tighter = 0;
  for (size_t i = 0; i < areas.size(); ++i) {
    ASSERT_LE(centre[i], corner[i]);
    // Half a window of twice the longer extent reaches no further than that extent.
    const int longer = std::max(areas[i].z - areas[i].x, areas[i].w - areas[i].y);
    if (std::min(areas[i].x, areas[i].y) >= longer) {
      ASSERT_EQ(centre[i], corner[i]);
    }
    if (std::min(areas[i].x, areas[i].y) == 0) tighter += centre[i] < corner[i];
  }
  EXPECT_GT(tighter, 500);
}

TEST_F(DepthBounds, LoosenessFallsFromPyramidOverHybridToMultiScaleMap) {
  const int resolution = 64;
  const std::vector<glm::ivec4> areas = areasOf(resolution);
  std::map<std::string, double> loose;
  for (const Tested& structure : testedStructures())
    for (const bool rough : {false, true}) {
      const std::vector<double> spokenFor = texelsSpokenFor(structure, resolution, areas, rough);
      double sum = 0.0;
      int count = 0;
      for (size_t i = 0; i < areas.size(); ++i) {
        const glm::ivec2 extent = glm::ivec2(areas[i].z, areas[i].w) - glm::ivec2(areas[i].x, areas[i].y);
        // Lights are near to square, and so are their areas.
        if (std::max(extent.x, extent.y) > 2 * std::min(extent.x, extent.y)) continue;
        sum += spokenFor[i] / (double(extent.x) * extent.y);
        ++count;
      }
      loose[structure.name + std::string(rough ? "_rough" : "")] = sum / count;
    }
  for (const auto& [name, ratio] : loose) {
    RecordProperty("looseness_" + name, std::to_string(ratio));
    EXPECT_GE(ratio, 1.0) << name;
  }
  EXPECT_GT(loose["hsm"], loose["ysm"]);
  EXPECT_GT(loose["ysm"], loose["mssm"]);
  EXPECT_GT(loose["hsm"], loose["mssm_rough"]);
  EXPECT_GT(loose["mssm_rough"], loose["mssm"]);
}

}  // namespace
}  // namespace limen::techniques
