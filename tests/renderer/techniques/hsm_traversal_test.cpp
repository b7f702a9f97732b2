// SPDX-License-Identifier: BSD-3-Clause
// The walk down the min/max pyramid against two twins in double precision: a recursion over the same tiles,
// and, without blocks, all texels of the map with no tree at all.
#include <algorithm>
#include <bitset>
#include <cmath>

#include "tests/renderer/techniques/plane_share_twin.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using Samples = std::bitset<256>;

struct TreeTwin {
  std::vector<Image> minima, maxima;  // maxima[0] is of level 1
  frame::LightFrustum frustum;
  glm::dvec2 lightSize;
  bool blocks = true;
  int finest = 0;
  bool plane = false;  // texels against the receiver's plane, by half a texel more than on it

  struct Walk {
    glm::dvec3 p;
    double limit = 0.0, area = 0.0, front = 1.0, margin = 1.0;
    glm::dvec2 gradient{0.0};
    int64_t nodes = 0;
    Samples hidden;
  };

  Walk begin(const Image& receivers, const Image& planes, int x, int y) const {
    Walk walk;
    walk.p = {receivers.at(x, y, 0), receivers.at(x, y, 1), receivers.at(x, y, 2)};
    const glm::dvec2 texel = (frustum.high - frustum.low) / double(minima[0].width) * double(1 << finest);
    const double slope = std::min(double(receivers.at(x, y, 3)), 10.0 * walk.p.z);
    walk.limit = walk.p.z * (1.0 - 1e-4) - 2.0 * slope * std::max(texel.x, texel.y);
    if (!plane) return walk;
    walk.limit = walk.p.z * (1.0 - 1e-4);
    walk.gradient = {planes.at(x, y, 0), planes.at(x, y, 1)};
    walk.margin = std::min(std::abs(walk.gradient.x) * texel.x + std::abs(walk.gradient.y) * texel.y,
                           10.0 * std::max(texel.x, texel.y));
    hideLight(walk);
    return walk;
  }

  // Light behind the plane: points at which the plane, continued to the light, has already been passed.
  void hideLight(Walk& walk) const {
    walk.front = shareBeforePlane(walk.gradient, lightSize, walk.p.z);
    for (size_t s = 0; s < 256; ++s) {
      const glm::dvec2 at = ((glm::dvec2(double(s % 16), double(s / 16)) + 0.5) / 16.0 - 0.5) * lightSize;
      if (glm::dot(walk.gradient, at) >= walk.p.z) walk.hidden.set(s);
    }
  }

  /// Whether depth z at a texel of a level lies before the receiver's plane by `texels` of its change and
  /// more.
  bool blocksAt(const Walk& walk, double z, int level, int x, int y, double texels) const {
    if (!(z < walk.limit)) return false;
    if (!plane) return true;
    const double n = minima[static_cast<size_t>(level)].width;
    const glm::dvec2 at = frustum.low + (glm::dvec2(x, y) + 0.5) / n * (frustum.high - frustum.low) -
                          glm::dvec2(walk.p) / walk.p.z;
    const double planeDepth = walk.p.z / (1.0 + glm::dot(walk.gradient, at));
    return z < planeDepth * (1.0 - 1e-4 - texels * walk.margin);
  }

  /// Whether all texels below a tile block at the depth `z`; the plane is monotonic over a tile.
  bool allBlock(const Walk& walk, double z, int level, int x, int y) const {
    const int last = (1 << level) - 1;
    for (const int corner : {0, 1, 2, 3})
      if (!blocksAt(walk, z, 0, (x << level) + (corner & 1) * last, (y << level) + (corner >> 1) * last, 0.5))
        return false;
    return true;
  }

  void tile(Walk& walk, int level, int x, int y, double z) const {
    const double n = minima[static_cast<size_t>(level)].width;
    glm::dvec2 low, high;
    for (int axis = 0; axis < 2; ++axis) {
      const auto toLight = [&](double u) {
        const double t = frustum.low[axis] + u / n * (frustum.high[axis] - frustum.low[axis]);
        const double s = (t * z * walk.p.z - walk.p[axis] * z) / (walk.p.z - z);
        return std::clamp(s / lightSize[axis] + 0.5, 0.0, 1.0);
      };
      low[axis] = toLight(axis == 0 ? x : y), high[axis] = toLight(axis == 0 ? x + 1 : y + 1);
    }
    if (!(high.x > low.x && high.y > low.y)) return;
    walk.area += std::max(high.x - low.x, 0.0) * std::max(high.y - low.y, 0.0);
    for (size_t s = 0; s < 256; ++s) {
      const double sx = (double(s % 16) + 0.5) / 16.0, sy = (double(s / 16) + 0.5) / 16.0;
      if (low.x < sx && sx <= high.x && low.y < sy && sy <= high.y) walk.hidden.set(s);
    }
  }

  void visit(Walk& walk, int level, int x, int y) const {
    ++walk.nodes;
    const Image& image = minima[static_cast<size_t>(level)];
    const double nearest = image.at(x, y);
    if (!(nearest < walk.limit)) return;
    const double n = image.width;
    const double farthest = level == 0 ? nearest : double(maxima[static_cast<size_t>(level) - 1].at(x, y));
    bool meets = true, within = allBlock(walk, farthest, level, x, y);
    for (int axis = 0; axis < 2; ++axis) {
      const double side = frustum.high[axis] - frustum.low[axis], at = axis == 0 ? x : y;
      const double low = frustum.low[axis] + at / n * side, high = frustum.low[axis] + (at + 1) / n * side;
      // In world units at either depth, on the receiver's shaft to the light.
      const auto shaft = [&](double z, double sign) {
        return walk.p[axis] * z / walk.p.z + sign * 0.5 * lightSize[axis] * (1.0 - z / walk.p.z);
      };
      meets = meets && low * nearest < shaft(nearest, 1.0) && high * nearest > shaft(nearest, -1.0);
      within = within && low * farthest >= shaft(farthest, -1.0) && high * farthest <= shaft(farthest, 1.0);
    }
    if (!meets) return;
    if (level <= finest) {
      if (blocksAt(walk, nearest, level, x, y, 0.5 + 0.5 * ((1 << level) - 1)))
        tile(walk, level, x, y, nearest);
    } else if (blocks && within) {
      tile(walk, level, x, y, 0.5 * (nearest + farthest));
    } else {
      for (int child = 0; child < 4; ++child) visit(walk, level - 1, 2 * x + child % 2, 2 * y + child / 2);
    }
  }

  /// No tree: every texel of the finest level.
  void all(Walk& walk) const {
    for (int y = 0; y < minima[0].height; ++y)
      for (int x = 0; x < minima[0].width; ++x)
        if (blocksAt(walk, minima[0].at(x, y), 0, x, y, 0.5)) tile(walk, 0, x, y, minima[0].at(x, y));
  }
};

class HsmWalk : public TechniqueTest {
 protected:
  struct Compared {
    int differing = 0, compared = 0, partly = 0;
    double nodes = 0.0, nodesOfTwin = 0.0;
  };

  Compared compare(const scene::Scene& scene, Given given, bool tree) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {36, 27});
    const TechniqueInfo& info = TechniqueRegistry::instance().get("soft_shadows/hsm_traversal");
    given["resolution"] = int64_t{64};
    const bool bitmask = given.contains("accumulation"), plane = given.contains("bias");
    if (!plane) {
      given["bias"] = std::string("receiver_slope");
      given["bias.slope"] = 2.0;
    }
    if (bitmask) given["accumulation.pattern"] = std::string("regular_16");
    const ParameterValues values(info.parameters, given);
    const auto made = info.make(values);
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    const auto& pyramid = frame.get<frame::MinMaxPyramid>(frame::ShadowMapSettings{64});
    TreeTwin twin{{},
                  {},
                  pyramid.frustum(),
                  scene.lights[0].size,
                  *values.find("blocks") != ParameterValue("none"),
                  static_cast<int>(std::get<int64_t>(*values.find("finest_level"))),
                  plane};
    for (int level = 0; level < pyramid.levels(); ++level) {
      twin.minima.push_back(pyramid.minimum().read(level));
      if (level > 0) twin.maxima.push_back(pyramid.maximum().read(level - 1));
    }
    const Image receivers = frame.get<frame::Receivers>().texture().read(),
                planes = frame.get<frame::Receivers>().planes().read();
    frame.end();
    const Image product = made->product().read();
    Compared out;
    double processed = 0.0;
    for (int y = 0; y < product.height; ++y)
      for (int x = 0; x < product.width; ++x) {
        if (receivers.at(x, y, 3) < 0.0F) continue;
        TreeTwin::Walk walk = twin.begin(receivers, planes, x, y);
        if (tree)
          twin.visit(walk, pyramid.levels() - 1, 0, 0);
        else
          twin.all(walk);
        const double expected = bitmask ? 1.0 - double(walk.hidden.count()) / 256.0
                                        : walk.front * (1.0 - std::min(walk.area, 1.0));
        ++out.compared;
        out.partly += expected > 0.0 && expected < 1.0;
        out.differing += !(std::abs(double(product.at(x, y)) - expected) <= (bitmask ? 1e-6 : 1e-3));
        // The walk on the GPU ends where nothing is left to hide.
        if (expected > 0.0 && walk.nodes > 1) out.nodesOfTwin += double(walk.nodes), processed += 1.0;
      }
    out.nodesOfTwin /= std::max(processed, 1.0);
    for (const Counter& counter : made->count(frame))
      if (counter.name == "nodes_per_px") out.nodes = counter.value;
    return out;
  }
};

TEST_F(HsmWalk, TakesTheTilesOfTheRecursion) {
  const scene::Scene boxes = makeScene("two_boxes"),
                     spheres = makeScene("sphere_grid", {{"tessellation", int64_t{5}}});
  for (const scene::Scene* scene : {&boxes, &spheres})
    for (const Given& given :
         {Given{}, Given{{"finest_level", int64_t{2}}}, Given{{"blocks", std::string("none")}}}) {
      const Compared area = compare(*scene, given, true);
      EXPECT_GT(area.partly, 50) << scene->name;
      // A tile within float rounding of the shaft's side may be one block or four tiles.
      EXPECT_LE(area.differing, area.compared / 50) << scene->name << ": " << area.differing;
    }
  const Compared mask = compare(boxes, {{"accumulation", std::string("bitmask")}}, true);
  // As in the tests of the plain bitmask: a sample within rounding of an edge may fall on either side.
  EXPECT_LE(mask.differing, mask.compared / 50) << mask.differing;
}

TEST_F(HsmWalk, WithoutBlocksIsTheSumOverAllTexels) {
  const scene::Scene boxes = makeScene("two_boxes"), big = makeScene("box_under_light");
  for (const scene::Scene* scene : {&boxes, &big})
    for (const char* accumulation : {"area", "bitmask"}) {
      Given given = {{"blocks", std::string("none")}};
      if (accumulation == std::string("bitmask")) given["accumulation"] = std::string("bitmask");
      const Compared result = compare(*scene, given, false);
      EXPECT_GT(result.partly, 50) << scene->name;
      EXPECT_LE(result.differing, result.compared / 50)
          << scene->name << " " << accumulation << ": " << result.differing << " of " << result.compared;
    }
}

TEST_F(HsmWalk, TakesWhatLiesBeforeTheReceiversPlane) {
  // The last one's light is cut by the planes of the tilted ground and of the sphere.
  const scene::Scene boxes = makeScene("two_boxes"),
                     tilted = makeScene("resting_sphere", {{"tilt", 70.0}, {"light_size", 12.0}});
  const Given plane = {{"bias", std::string("receiver_plane")}};
  for (const scene::Scene* scene : {&boxes, &tilted})
    for (const char* accumulation : {"area", "bitmask"})
      for (const char* blocks : {"none", "mean"}) {
        Given given = plane;
        given["blocks"] = std::string(blocks);
        if (accumulation == std::string("bitmask")) given["accumulation"] = std::string("bitmask");
        const Compared result = compare(*scene, given, blocks == std::string("mean"));
        EXPECT_GT(result.partly, 50) << scene->name;
        EXPECT_LE(result.differing, result.compared / 50)
            << scene->name << " " << accumulation << ' ' << blocks << ": " << result.differing << " of "
            << result.compared;
      }
  const Compared coarse =
      compare(boxes, {{"bias", std::string("receiver_plane")}, {"finest_level", int64_t{2}}}, true);
  EXPECT_LE(coarse.differing, coarse.compared / 50) << coarse.differing;
}

TEST_F(HsmWalk, BlocksSaveNodesAndCostNothingOnAFlatCaster) {
  // All texels of the rectangle are at one depth, so a block is what its texels are, up to the rounding of
  // the sum of 62 x 62 areas.
  const scene::Scene scene = makeScene("parallel_rectangle");
  Given given = {{"resolution", int64_t{64}}};
  const Rendered blocks = render(scene, "soft_shadows/hsm_traversal", given, {40, 30}, true);
  given["blocks"] = std::string("none");
  const Rendered texels = render(scene, "soft_shadows/hsm_traversal", given, {40, 30}, true);
  for (size_t i = 0; i < blocks.product.pixels(); ++i)
    ASSERT_NEAR(blocks.product.data[i], texels.product.data[i], 62.0 * 62.0 * 0x1p-24) << i;
  // A block of level l saves the (4^(l + 1) - 4) / 3 nodes below it.
  EXPECT_LT(blocks.counter("nodes_per_px"), texels.counter("nodes_per_px"));
  EXPECT_GT(blocks.counter("level_mean"), 0.5);
}

}  // namespace
}  // namespace limen::techniques
