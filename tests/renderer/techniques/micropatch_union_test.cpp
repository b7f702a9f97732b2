// SPDX-License-Identifier: BSD-3-Clause
// Techniques that make occluders of a shadow map's texels against the exact union of its micropatches, at the
// finest level: what they add to the error of the map are the double counting of areas and the spacing of
// samples, and both have bounds. Grounds lean, and some cut the light.
#include <algorithm>
#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/references/micropatches_of_map.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using references::BlockingRule;
using references::HalfPlane;
using references::MicropatchesOfMap;
using references::PatchReceiver;
using references::PatchStretch;
using references::RectangleUnion;

constexpr int kUnionMap = 64;
/// Float rounding of positions on the light: k = z / (p_z - z) magnifies 2^-23 by up to some hundred near
/// contact; of areas a few times that.
constexpr double kUnionRounding = 1e-4;

/// A card over a ground that leans towards one side of the light; the ground may rise above the light's
/// plane, and its plane may cut the light. The light is turned by `turn` degrees in its plane.
scene::Scene leaningCase(double tilt, double lightSize, double turn = 0.0) {
  scene::Scene scene;
  const double radians = glm::radians(tilt);
  scene::addPart(
      scene, "ground",
      scene::card({0.0, 0.0, 0.0}, {0.0, 0.0, 3.0}, {3.0 * std::cos(radians), 3.0 * std::sin(radians), 0.0}),
      glm::vec3(0.7F), scene::Role::ReceiverOnly);
  scene::addPart(scene, "card", scene::card({-0.4, 0.9, 0.0}, {0.0, 0.0, 0.35}, {0.3, 0.0, 0.0}),
                 glm::vec3(0.5F));
  scene.lights = {scene::lightTowards({0.0, 2.0, 0.0}, glm::dvec3(0.0), glm::dvec2(lightSize))};
  scene::AreaLight& light = scene.lights[0];
  const glm::dvec3 x = light.axisX, y = light.axisY;
  const double angle = glm::radians(turn);
  if (turn != 0.0) {
    light.axisX = std::cos(angle) * x + std::sin(angle) * y;
    light.axisY = std::cos(angle) * y - std::sin(angle) * x;
  }
  scene::setStillCamera(scene, scene::orbitCamera({-0.3, 0.0, 0.0}, 4.0, -60.0, 40.0));
  return scene;
}

struct UnionCase {
  std::string name;
  scene::Scene scene;
  bool flatCard = false;     ///< one card parallel to the map, and no other caster
  bool levelGround = false;  ///< parallel to it as well
};

class MicropatchUnion : public TechniqueTest {
 protected:
  static std::vector<UnionCase> cases() {
    std::vector<UnionCase> out;
    for (const double tilt : {0.0, 25.0, 60.0})
      out.push_back({"card, tilt " + std::to_string(int(tilt)), leaningCase(tilt, 0.6), true, tilt == 0.0});
    out.push_back({"plane that cuts the light", leaningCase(60.0, 5.0), true});
    out.push_back({"plane that cuts the light obliquely", leaningCase(80.0, 5.0, 30.0)});
    out.push_back({"spheres", makeScene("sphere_grid", {{"tessellation", int64_t{6}}})});
    out.push_back({"leaning sphere", makeScene("resting_sphere", {{"tilt", 40.0}, {"light_size", 3.0}})});
    out.push_back({"boxes", makeScene("two_boxes")});
    return out;
  }

  /// A technique's product, with all that the union needs for the same pixels.
  struct Seen {
    Image product, map, receivers;
    std::vector<glm::dvec3> normals;  ///< light space
    frame::LightFrustum frustum;
    glm::dvec2 lightSize{1.0};

    bool isReceiver(size_t pixel) const { return receivers.data[4 * pixel + 3] >= 0.0F; }
    PatchReceiver receiver(size_t pixel) const {
      return {{receivers.data[4 * pixel], receivers.data[4 * pixel + 1], receivers.data[4 * pixel + 2]},
              normals[pixel]};
    }
  };

  static Given finestLevel(const std::string& bias) {
    return {{"resolution", int64_t{kUnionMap}},
            {"levels", std::string("fixed")},
            {"levels.level", int64_t{0}},
            {"bias", bias}};
  }
  /// As the declared defaults of that bias.
  static BlockingRule ruleOf(const std::string& bias) {
    if (bias == "receiver_plane") return {1e-4, 0.5, 10.0, true};
    if (bias == "receiver_slope") return {1e-4, 1.0, 10.0, false};
    return {1e-4, 0.0, 1e6, false};
  }

  static Seen see(const scene::Scene& scene, const std::string& technique, const Given& given) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {32, 24});
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    const auto& map = frame.get<frame::ShadowMap>(frame::ShadowMapSettings{kUnionMap});
    Seen out{made->product().read(), map.texture().read(), frame.get<frame::Receivers>().texture().read(), {},
             map.frustum(),          scene.lights[0].size};
    const Image normals =
        frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Normal}).texture().read();
    frame.end();
    const glm::dmat3 toLight(scene.lights[0].toLightSpace());
    for (size_t i = 0; i < normals.pixels(); ++i)
      out.normals.push_back(
          toLight * glm::dvec3(normals.data[4 * i], normals.data[4 * i + 1], normals.data[4 * i + 2]));
    return out;
  }

  static MicropatchesOfMap patchesOf(const Seen& seen, const std::string& bias, PatchStretch stretch) {
    return {seen.map, seen.frustum, seen.lightSize, 0, ruleOf(bias), stretch};
  }

  /// The thesis takes a point whose whole search area blocks as dark, whatever gaps remain between patches:
  /// none remains if they are stretched to all sides.
  static bool isUmbra(const Seen& seen, const std::string& bias, size_t pixel) {
    RectangleUnion scratch;
    return patchesOf(seen, bias, PatchStretch::Diagonal).visibility(seen.receiver(pixel), scratch) < 1e-3;
  }
};

/// Share of the light in cells, of n x n, that are neither hidden nor seen as a whole. Each sample lies in a
/// cell of its own, and stands for it: a mask is wrong by these cells at most.
double undecidedShare(const MicropatchesOfMap& patches, const PatchReceiver& receiver, bool plane, int n) {
  RectangleUnion all;
  patches.gather(receiver, all);
  std::vector<RectangleUnion> cells(size_t(n) * size_t(n));
  for (const auto& [low, high] : all.rectangles()) {
    const glm::ivec2 first(glm::floor(low * double(n))), last(glm::ceil(high * double(n)));
    for (int y = first.y; y < last.y; ++y)
      for (int x = first.x; x < last.x; ++x)
        cells[size_t(y) * size_t(n) + size_t(x)].add(glm::max(low * double(n) - glm::dvec2(x, y), 0.0),
                                                     glm::min(high * double(n) - glm::dvec2(x, y), 1.0));
  }
  const HalfPlane lit = patches.litSide(receiver);
  const double reach = (std::abs(lit.n.x) + std::abs(lit.n.y)) * 0.5 / n;
  int undecided = 0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const double hidden = cells[size_t(y) * size_t(n) + size_t(x)].area();
      const double middle = lit.at((glm::dvec2(x, y) + 0.5) / double(n));
      const bool before = !plane || middle > reach + 1e-6, behind = plane && middle < -reach - 1e-6;
      // A texel's edge within rounding of a sample at the cell's border may fall on either side of it.
      if (hidden > 1.0 - 1e-6 || behind || (hidden < 1e-6 && before)) continue;
      ++undecided;
    }
  return double(undecided) / (double(n) * n);
}

TEST_F(MicropatchUnion, AreasAreExactWherePatchesDoNotOverlap) {
  // One card at one depth: its patches abut.
  for (const UnionCase& one : cases()) {
    if (!one.flatCard) continue;
    for (const std::string bias : {"receiver_slope", "receiver_plane"})
      for (const char* fill : {"none", "left_bottom"}) {
        // The map sees the ground beside the card, which shadows what lies lower where it leans.
        if (bias == "receiver_slope" && !one.levelGround) continue;
        Given given = finestLevel(bias);
        given["occluders.gap_fill"] = std::string(fill);
        const Seen seen = see(one.scene, "soft_shadows/backprojection", given);
        const MicropatchesOfMap patches = patchesOf(seen, bias, PatchStretch::None);
        RectangleUnion hidden;
        int partly = 0;
        for (size_t i = 0; i < seen.product.pixels(); ++i) {
          if (!seen.isReceiver(i)) continue;
          const PatchReceiver receiver = seen.receiver(i);
          const double exact = patches.visibility(receiver, hidden);
          partly += exact > 0.02 && exact < 0.98;
          // Areas take what patches hide and what is behind the plane for independent. Any two shares F and A
          // of the light have in common between max(0, F + A - 1) and min(F, A), as F A does.
          double bound = kUnionRounding;
          if (bias == "receiver_plane") {
            references::ConvexPolygon front, behind;
            split({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, patches.litSide(receiver), front, behind);
            const double f = front.area(), a = hidden.area();
            bound += std::max(std::min(f, 1.0 - a) - f * (1.0 - a), f * (1.0 - a) - std::max(0.0, f - a));
          }
          ASSERT_NEAR(seen.product.data[i], exact, bound) << one.name << ", " << bias << ", " << fill;
        }
        EXPECT_GT(partly, 40) << one.name;
      }
  }
}

TEST_F(MicropatchUnion, AreasHideAtLeastTheUnion) {
  for (const UnionCase& one : cases())
    for (const auto& [fill, stretch] : {std::pair("none", PatchStretch::None),
                                        {"left_bottom", PatchStretch::LeftBottom},
                                        {"diagonal", PatchStretch::Diagonal}}) {
      Given given = finestLevel("receiver_slope");
      given["occluders.gap_fill"] = std::string(fill);
      const Seen seen = see(one.scene, "soft_shadows/backprojection", given);
      const MicropatchesOfMap patches = patchesOf(seen, "receiver_slope", stretch);
      RectangleUnion hidden;
      int above = 0, receivers = 0;
      for (size_t i = 0; i < seen.product.pixels(); ++i) {
        if (!seen.isReceiver(i)) continue;
        ++receivers;
        const double exact = patches.visibility(seen.receiver(i), hidden);
        above += seen.product.data[i] > exact + kUnionRounding;
      }
      // A texel whose depth is within rounding of the receiver's bias counts for one and not for the other.
      EXPECT_LE(above, receivers / 100) << one.name << ", " << fill;
    }
}

TEST_F(MicropatchUnion, OfTwoCardsIsHiddenTwiceAtMostByAreas) {
  const scene::Scene scene =
      makeScene("card_stack", {{"fit", std::string("strips")}, {"cards", int64_t{2}}, {"spacing", 0.1}});
  Given given = finestLevel("constant");
  given["occluders.gap_fill"] = std::string("none");
  const Seen seen = see(scene, "soft_shadows/backprojection", given);
  const MicropatchesOfMap patches = patchesOf(seen, "constant", PatchStretch::None);
  RectangleUnion hidden;
  double doubled = 0.0;
  for (size_t i = 0; i < seen.product.pixels(); ++i) {
    if (!seen.isReceiver(i)) continue;
    const double exact = 1.0 - patches.visibility(seen.receiver(i), hidden),
                 summed = 1.0 - seen.product.data[i];
    ASSERT_GE(summed, exact - kUnionRounding);
    // The patches of either card abut, so that no point of the light is covered more than twice.
    ASSERT_LE(summed, 2.0 * exact + kUnionRounding);
    doubled = std::max(doubled, summed - exact);
  }
  EXPECT_GT(doubled, 0.01) << "the cards do not overlap on the light";
}

TEST_F(MicropatchUnion, MasksAreWrongByTheCellsThatItsEdgesCutAtMost) {
  struct Kind {
    const char *occluders, *fill;
    PatchStretch stretch;
  };
  for (const UnionCase& one : cases())
    for (const std::string bias : {"receiver_plane", "receiver_slope"})
      for (const Kind& kind : {Kind{"micropatches", "none", PatchStretch::None},
                               Kind{"micropatches", "left_bottom", PatchStretch::LeftBottom},
                               Kind{"microrects", "none", PatchStretch::None}})
        for (const auto& [pattern, n] : {std::pair("regular_8", 8), {"jittered_16", 16}}) {
          Given given = finestLevel(bias);
          given["occluders"] = std::string(kind.occluders);
          given["occluders.gap_fill"] = std::string(kind.fill);
          given["pattern"] = std::string(pattern);
          const std::string what =
              one.name + ", " + bias + ", " + kind.occluders + ", " + kind.fill + ", " + pattern;
          const Seen seen = see(one.scene, "soft_shadows/bitmask", given);
          const MicropatchesOfMap patches = patchesOf(seen, bias, kind.stretch);
          RectangleUnion hidden;
          int wrong = 0, receivers = 0, partly = 0;
          // A third of the pixels, of other columns in each row: the union is what takes time.
          for (size_t i = 0; i < seen.product.pixels(); i += 3) {
            if (!seen.isReceiver(i)) continue;
            ++receivers;
            const PatchReceiver receiver = seen.receiver(i);
            const double exact = patches.visibility(receiver, hidden), found = seen.product.data[i];
            partly += exact > 0.02 && exact < 0.98;
            if (std::abs(found - exact) <= 1e-6) continue;
            if (std::abs(found - exact) <=
                undecidedShare(patches, receiver, bias == "receiver_plane", n) + 1e-5)
              continue;
            if (found == 0.0 && isUmbra(seen, bias, i)) continue;
            ++wrong;
          }
          EXPECT_GT(partly, 6) << what;  // a third of 20
          // As above: texels within rounding of the bias.
          EXPECT_LE(wrong, receivers / 100) << what;
        }
}

// Sample by sample, where nothing but the plane hides any: whole rows of samples lie behind a plane that cuts
// off a corner of the light.
TEST_F(MicropatchUnion, MasksLeaveOutTheSamplesBehindAnObliquePlane) {
  for (const double tilt : {60.0, 80.0})
    for (const double turn : {0.0, 30.0, 60.0, 120.0, 210.0, 300.0}) {
      const scene::Scene scene = leaningCase(tilt, 5.0, turn);
      for (const LightPattern pattern :
           {LightPattern::Regular8, LightPattern::Regular16, LightPattern::Regular32,
            LightPattern::Jittered16, LightPattern::Halton256}) {
        Given given = finestLevel("receiver_plane");
        given["pattern"] = std::string(limen::toText(pattern));
        const Seen seen = see(scene, "soft_shadows/bitmask", given);
        const MicropatchesOfMap patches = patchesOf(seen, "receiver_plane", PatchStretch::Diagonal);
        const std::vector<glm::dvec2> samples = lightSamples(pattern);
        // Samples from tables are hidden in strips of the table's steps, of 1/64.
        const double margin = pattern == LightPattern::Halton256 ? 1.5 / 64.0 : 1e-4;
        int cut = 0;
        for (size_t i = 0; i < seen.product.pixels(); ++i) {
          if (!seen.isReceiver(i)) continue;
          const PatchReceiver receiver = seen.receiver(i);
          RectangleUnion hidden;
          patches.gather(receiver, hidden);
          if (!hidden.empty()) continue;
          const HalfPlane lit = patches.litSide(receiver);
          int least = 0, most = 0;
          for (const glm::dvec2 sample : samples) {
            least += lit.at(sample) > margin;
            most += lit.at(sample) > -margin;
          }
          cut += least < int(samples.size());
          ASSERT_GE(seen.product.data[i], (least - 0.5) / double(samples.size()))
              << tilt << ' ' << turn << ' ' << limen::toText(pattern);
          ASSERT_LE(seen.product.data[i], (most + 0.5) / double(samples.size()))
              << tilt << ' ' << turn << ' ' << limen::toText(pattern);
        }
        EXPECT_GT(cut, 20) << tilt << ' ' << turn;
      }
    }
}

// On a card at one depth a mesh between texel centres is the patches less half a texel along each side; a
// contour along borders is the patches less a triangle, of legs of half a texel, at each corner; one through
// centres is the mesh.
TEST_F(MicropatchUnion, OfACardHoldsItsMeshAndItsContours) {
  for (const UnionCase& one : cases()) {
    if (!one.flatCard) continue;
    for (const std::string bias : {"receiver_slope", "receiver_plane"})
      for (const auto& [occluders, inset] : {std::pair("microquads", 1.0),
                                             {"microquads_microtris", 1.0},
                                             {"contours", 0.0},
                                             {"contours", 1.0}}) {
        if (bias == "receiver_slope" && !one.levelGround) continue;
        Given given = finestLevel(bias);
        given["occluders"] = std::string(occluders);
        if (occluders == std::string("contours")) given["occluders.inset"] = inset;
        const Seen seen = see(one.scene, "soft_shadows/backprojection", given);
        const MicropatchesOfMap patches = patchesOf(seen, bias, PatchStretch::None);
        RectangleUnion hidden;
        for (size_t i = 0; i < seen.product.pixels(); ++i) {
          if (!seen.isReceiver(i)) continue;
          const PatchReceiver receiver = seen.receiver(i);
          patches.visibility(receiver, hidden);
          const double z = receiver.position.z, card = 2.0 - 0.9;
          if (z <= card) continue;
          double front = 1.0;
          if (bias == "receiver_plane") {
            references::ConvexPolygon before, behind;
            split({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, patches.litSide(receiver), before,
                  behind);
            front = before.area();
          }
          const glm::dvec2 texel = (seen.frustum.high - seen.frustum.low) / double(kUnionMap) * card *
                                   (z / (z - card)) / seen.lightSize;
          // Strips along the sides are no longer than the light is wide.
          const double missing = inset == 1.0 ? std::min(texel.x, 1.0) + std::min(texel.y, 1.0)
                                              : std::min(0.5 * texel.x * texel.y, 1.0);
          const double most = front * (1.0 - std::clamp(hidden.area() - missing, 0.0, 1.0)),
                       least = front * (1.0 - hidden.area());
          ASSERT_LE(seen.product.data[i], most + kUnionRounding)
              << one.name << ", " << bias << ", " << occluders;
          ASSERT_GE(seen.product.data[i], least - kUnionRounding)
              << one.name << ", " << bias << ", " << occluders;
        }
      }
  }
}

}  // namespace
}  // namespace limen::techniques
