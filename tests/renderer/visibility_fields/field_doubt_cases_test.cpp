// SPDX-License-Identifier: BSD-3-Clause
// What doubtful rays must hold whatever the scene, the storage and the pattern: each ray is looked up or
// traced, the list's length is exact, and nothing is left over from one frame to the next.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "renderer/scene/part_motion.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"
#include "tests/renderer/visibility_fields/two_balls.h"

namespace limen::techniques {
namespace {

// Neither side a multiple of a work group's 8.
constexpr glm::ivec2 kCasesPx{37, 29};
constexpr const char *kCasesOcclusion = "visibility_fields/ambient_occlusion",
                     *kCasesShadows = "visibility_fields/soft_shadows";

class FieldDoubtCasesTest : public TechniqueTest {
 protected:
  static Given join(Given given, const Given& more) {
    for (const auto& [path, value] : more) given[path] = value;
    return given;
  }
  /// `given` with a choice of 'near', whose parameters are `more`.
  static Given near(const std::string& technique, Given given, const std::string& kind,
                    const Given& more = {}) {
    const std::string path = technique == kCasesOcclusion ? "combine.near" : "near";
    given[path] = kind;
    for (const auto& [name, value] : more) given[path + "." + name] = value;
    return given;
  }
  /// Two balls and a box, all within each other's reach, over a ground.
  static scene::Scene ballsAndBox(glm::dvec3 at = glm::dvec3(0.0)) {
    scene::Scene scene = twoBallsOverGround();
    scene::addPart(scene, "box", scene::box({-0.9, 0.02, -0.3}, {-0.1, 0.3, 0.3}), glm::vec3(0.5F));
    scene::setStillCamera(scene, {{0.4, 1.6, 1.2}, {-0.1, 0.3, 0.0}, {0.0, 1.0, 0.0}, 50.0});
    for (glm::dvec3& p : scene.mesh.positions) p += at;
    for (scene::AreaLight& light : scene.lights) light.centre += at;
    for (scene::CameraPath::Key& key : scene.camera.keys) key.camera.eye += at, key.camera.target += at;
    return scene;
  }
  /// The same, the balls turning and the box shifting.
  static scene::Scene movingBallsAndBox() {
    scene::Scene scene = ballsAndBox();
    scene::PartMotion balls, box;
    balls.part = 1, balls.pivot = {0.0, 1.1, 0.0}, balls.turnDegS = 50.0;
    box.part = 2, box.travel = {0.2, 0.0, 0.1}, box.periodS = 3.0;
    scene.motions = {balls, box};
    return scene;
  }
  struct Frames {
    std::vector<Image> images;
    std::vector<std::string> remarks;
  };
  /// One technique at several times in turn.
  static Frames framesOf(const scene::Scene& scene, const std::string& technique, const Given& given,
                         const std::vector<double>& times) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, kCasesPx);
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    Frames out;
    for (const double time : times) {
      frame.setTime(time);
      frame.begin();
      made->render(frame);
      frame.end();
      out.images.push_back(made->product().read());
    }
    out.remarks = made->remarks();
    return out;
  }
  static double pixels() { return double(kCasesPx.x) * kCasesPx.y; }
};

// With one ray a pixel, another for each: what a pixel has is what the field alone says or what the tracer
// says, to the unit of the sums, 2^-20, and where they agree that. As many pixels as have the tracer's value
// are in doubt at least. Of the rays about which they do not agree some are in doubt, so that pixels of the
// whole picture are compared with both.
TEST_F(FieldDoubtCasesTest, EachRayIsLookedUpOrTraced) {
  const scene::Scene here = ballsAndBox(), there = ballsAndBox(glm::dvec3(1e6)), moving = movingBallsAndBox();
  const Given own = {{"rays", int64_t{1}}, {"positions", int64_t{290}}, {"directions", int64_t{16}}};
  struct Case {
    const char* what;
    const scene::Scene& scene;
    Given given;
    bool storage = false;
  };
  const std::vector<Case> cases = {
      {"parts", here, {{"objects", std::string("parts")}}},
      {"pieces", here, {{"objects", std::string("pieces")}}},
      {"others alone", here, {{"objects", std::string("parts")}, {"self_occlusion", false}}},
      {"1 bit", here, {{"bits", int64_t{1}}}, true},
      {"16 bits", here, {{"bits", int64_t{16}}}, true},
      {"32 bits", here, {{"bits", int64_t{32}}}, true},
      {"between positions", here, {{"fetch", std::string("positions")}}, true},
      {"between directions", here, {{"fetch", std::string("all")}}, true},
      {"a cover", here, {{"objects", std::string("parts")}, {"spheres", int64_t{4}}}},
      {"a grid", here, {{"position_map", std::string("grid")}}, true},
      {"by size", here, {{"storage.detail", std::string("by_size")}, {"storage.detail.error", 0.5}}},
      {"far from the origin", there, {}},
      {"moving", moving, {{"objects", std::string("parts")}}},
      {"a moving cover", moving, {{"objects", std::string("parts")}, {"spheres", int64_t{4}}}}};
  for (const char* technique : {kCasesOcclusion, kCasesShadows}) {
    const bool occlusion = technique == kCasesOcclusion;
    for (const Case& one : cases) {
      if (!occlusion && one.storage) continue;  // the same look-ups
      Given rays = {{"rays", int64_t{1}}, {"pattern", std::string(occlusion ? "interleaved" : "turned")}};
      if (occlusion)
        rays.insert({{"pattern.side", int64_t{8}}, {"radius", 0.05}, {"falloff", std::string("linear")}});
      Given traced = rays;
      for (const char* shared : {"objects", "self_occlusion"})
        if (const auto found = one.given.find(shared); found != one.given.end()) traced.insert(*found);
      const Given field = join(join(own, rays), one.given);
      const std::string tracer =
          occlusion ? "visibility_fields/traced_occlusion" : "visibility_fields/traced_shadows";
      const Image exact = render(one.scene, tracer, traced, kCasesPx).product;
      const Image looked = render(one.scene, technique, near(technique, field, "field"), kCasesPx).product;
      const Rendered found =
          render(one.scene, technique,
                 near(technique, field, "doubtful", {{"reach", 1.0}, {"capacity", 1.0}}), kCasesPx, true);
      int neither = 0, onlyTraced = 0, onlyLookedUp = 0;
      for (int y = 0; y < kCasesPx.y; ++y)
        for (int x = 0; x < kCasesPx.x; ++x) {
          const double value = found.product.at(x, y);
          const bool asField = std::abs(value - looked.at(x, y)) < 2e-6,
                     asTracer = std::abs(value - exact.at(x, y)) < 1e-4;
          neither += !asField && !asTracer, onlyTraced += asTracer && !asField,
              onlyLookedUp += asField && !asTracer;
        }
      EXPECT_EQ(neither, 0) << technique << ", " << one.what;
      EXPECT_GE(found.counter("doubtful_ray_share") * pixels(), onlyTraced - 0.5)
          << technique << ", " << one.what;
      EXPECT_GT(onlyTraced, 0) << technique << ", " << one.what;
      EXPECT_EQ(found.counter("doubtful_overflow"), 0.0);
    }
  }
}

// A list with room for exactly those that are found takes them all; one for one less takes none.
TEST_F(FieldDoubtCasesTest, TheListHoldsAsManyRaysAsItsShareSays) {
  const scene::Scene scene = ballsAndBox();
  for (const char* technique : {kCasesOcclusion, kCasesShadows}) {
    const Given given = {{"rays", int64_t{16}}, {"positions", int64_t{290}}, {"directions", int64_t{16}}};
    const double rays = 16.0 * pixels();
    const auto with = [&](double capacity) {
      return render(scene, technique, near(technique, given, "doubtful", {{"capacity", capacity}}), kCasesPx,
                    true);
    };
    const Rendered all = with(1.0);
    const double found = std::round(all.counter("doubtful_ray_share") * rays);
    ASSERT_GT(found, 100.0);
    const Rendered enough = with((found - 0.5) / rays), few = with((found - 1.5) / rays);
    EXPECT_EQ(enough.counter("doubtful_overflow"), 0.0) << technique;
    EXPECT_EQ(enough.product.data, all.product.data) << technique;
    EXPECT_EQ(few.counter("doubtful_overflow"), 1.0) << technique;
    EXPECT_EQ(few.counter("doubtful_ray_share"), all.counter("doubtful_ray_share")) << technique;
    EXPECT_NE(few.product.data, all.product.data) << technique;
  }
}

// Lists and sums are empty again for the next frame: the same time gives the same bytes, whatever came
// between.
TEST_F(FieldDoubtCasesTest, NothingIsLeftOverFromOtherFrames) {
  const scene::Scene scene = movingBallsAndBox();
  for (const char* technique : {kCasesOcclusion, kCasesShadows}) {
    const Given given = {{"rays", int64_t{64}}, {"positions", int64_t{290}}, {"directions", int64_t{16}}};
    for (const Given& each :
         {near(technique, given, "traced"), near(technique, given, "doubtful", {{"capacity", 1.0}}),
          near(technique, given, "doubtful", {{"capacity", 0.001}})}) {
      const std::vector<Image> images = framesOf(scene, technique, each, {0.0, 0.7, 1.9, 0.0}).images;
      EXPECT_EQ(images[0].data, images[3].data) << technique;
      EXPECT_EQ(images[2].data, framesOf(scene, technique, each, {1.9}).images[0].data) << technique;
      EXPECT_NE(images[0].data, images[1].data) << technique;
    }
  }
}

// A reader of the record is told that the picture is not what was asked for, also if that was so in an
// earlier frame alone.
TEST_F(FieldDoubtCasesTest, AListThatWasTooShortInAnyFrameIsRemarkedOn) {
  const scene::Scene scene = movingBallsAndBox();
  const Given given = {{"rays", int64_t{16}}, {"positions", int64_t{290}}, {"directions", int64_t{16}}};
  double most = 0.0, least = 1.0;
  std::vector<double> shares;
  const std::vector<double> times = {0.0, 0.4, 0.9, 1.4};
  for (const double time : times) {
    const double share = render(scene::movedTo(scene, time), kCasesOcclusion,
                                near(kCasesOcclusion, given, "doubtful", {{"capacity", 1.0}}), kCasesPx, true)
                             .counter("doubtful_ray_share");
    most = std::max(most, share), least = std::min(least, share);
    shares.push_back(share);
  }
  ASSERT_GT(most, 1.02 * least);
  // The frame with the most before that with the least.
  const double first = times[size_t(std::max_element(shares.begin(), shares.end()) - shares.begin())],
               last = times[size_t(std::min_element(shares.begin(), shares.end()) - shares.begin())];
  const auto remarks = [&](double capacity) {
    return framesOf(scene, kCasesOcclusion,
                    near(kCasesOcclusion, given, "doubtful", {{"capacity", capacity}}), {first, last})
        .remarks;
  };
  EXPECT_TRUE(remarks(1.01 * most).empty());
  const std::vector<std::string> told = remarks(0.5 * (most + least));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("capacity"), std::string::npos) << told[0];
}

// Writes beyond what a device's shaders reach would be lost.
TEST_F(FieldDoubtCasesTest, AListLongerThanTheDeviceAllowsIsRefused) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  const scene::Scene scene = twoBallsOverGround();
  const int side = int(std::ceil(std::sqrt(double(most) / 4.0 / 1024.0))) + 1;
  if (side > 1024) GTEST_SKIP() << "the list would take " << most << " bytes";
  const Given given = {{"rays", int64_t{1024}}, {"positions", int64_t{82}}, {"directions", int64_t{8}}};
  EXPECT_THROW(
      {
        const TechniqueInfo& info = TechniqueRegistry::instance().get(kCasesOcclusion);
        const frame::GpuScene gpuScene(scene);
        frame::Frame frame(context(), scene, gpuScene, {side, side});
        const auto made = info.make(
            ParameterValues(info.parameters, near(kCasesOcclusion, given, "doubtful", {{"capacity", 1.0}})));
        made->prepare(frame);
      },
      Error);
}

// With the rays of four texels around to compare as well, a farther square still finds more.
TEST_F(FieldDoubtCasesTest, ReachCountsBetweenDirectionsAsWell) {
  const scene::Scene scene = twoBallsOverGround();
  const Given given = {{"rays", int64_t{64}},
                       {"fetch", std::string("all")},
                       {"radius", 10.0},
                       {"objects", std::string("parts")}};
  double before = 0.0;
  for (const double reach : {0.0, 1.0, 2.0}) {
    const double share =
        render(scene, kCasesOcclusion,
               near(kCasesOcclusion, given, "doubtful", {{"reach", reach}, {"footprints", 0.0}}), kCasesPx,
               true)
            .counter("doubtful_ray_share");
    EXPECT_GT(share, before) << reach;
    before = share;
  }
}

// Objects that do not block their own rays do not do so either where rays are traced and objects move: beside
// its own wall a floor is hidden by the box above alone. Pixels of which a ray finds a surface within 32
// footprints, here nearly all, are the tracer's.
TEST_F(FieldDoubtCasesTest, OwnObjectsAreLeftOutWhereTheyMove) {
  scene::Scene scene;
  scene::Mesh corner = scene::box({0.0, -0.1, -1.0}, {1.0, 0.0, 1.0});
  scene::append(corner, scene::box({-0.1, -0.1, -1.0}, {0.0, 1.0, 1.0}));
  scene::addPart(scene, "corner", corner, glm::vec3(0.5F));
  scene::addPart(scene, "box", scene::box({0.2, 0.3, -0.3}, {0.8, 0.5, 0.3}), glm::vec3(0.5F));
  scene::setStillCamera(scene, {{0.5, 0.28, 0.0}, {0.5, 0.0, 0.0}, {0.0, 0.0, -1.0}, 90.0});
  scene::PartMotion motion;
  motion.part = 0, motion.travel = {0.01, 0.0, 0.0}, motion.startS = 0.2;
  scene.motions = {motion};
  Given given = {
      {"rays", int64_t{64}}, {"radius", 10.0}, {"objects", std::string("parts")}, {"self_occlusion", false}};
  const Image exact = render(scene, "visibility_fields/traced_occlusion", given, kCasesPx).product;
  given["self_occlusion"] = true;
  EXPECT_GT(
      meanDifference(render(scene, "visibility_fields/traced_occlusion", given, kCasesPx).product, exact),
      0.05);
  given["self_occlusion"] = false;
  const Image found =
      render(scene, kCasesOcclusion, near(kCasesOcclusion, given, "traced", {{"footprints", 32.0}}), kCasesPx)
          .product;
  int same = 0;
  for (int y = 0; y < kCasesPx.y; ++y)
    for (int x = 0; x < kCasesPx.x; ++x) same += std::abs(found.at(x, y) - exact.at(x, y)) < 1e-4;
  EXPECT_GT(same, 0.95 * pixels());
}

// Within the sphere of a long box: beside its wall, where the surface is nearer than the stored rays are
// fine, rays are in doubt without any that are compared; farther away they are as those around disagree.
// Either leaves less than half of the field's error.
TEST_F(FieldDoubtCasesTest, NearnessAndDisagreementCountFromWithin) {
  scene::Scene scene;
  scene::addGround(scene, 16.0);
  scene::addPart(scene, "box", scene::box({-0.5, 0.0, -2.0}, {0.0, 0.4, 2.0}), glm::vec3(0.5F));
  const Given given = {{"rays", int64_t{256}}, {"radius", 10.0}, {"self_occlusion", false}};
  for (const bool beside : {true, false}) {
    const double at = beside ? 0.021 : 0.15;
    scene::setStillCamera(scene, {{at, 2.0 * at, 0.0}, {at, 0.0, 0.0}, {0.0, 0.0, -1.0}, 30.0});
    const Image exact = render(scene, "visibility_fields/traced_occlusion", given, kCasesPx).product;
    const double alone = meanDifference(
        render(scene, kCasesOcclusion, near(kCasesOcclusion, given, "field"), kCasesPx).product, exact);
    const auto left = [&](double reach, double footprints) {
      const Given doubtful = near(kCasesOcclusion, given, "doubtful",
                                  {{"reach", reach}, {"footprints", footprints}, {"capacity", 1.0}});
      return meanDifference(render(scene, kCasesOcclusion, doubtful, kCasesPx).product, exact) / alone;
    };
    EXPECT_NEAR(left(0.0, 0.0), 1.0, 1e-3);
    if (beside)
      EXPECT_LT(left(0.0, 1.0), 0.5);
    else
      EXPECT_LT(left(1.0, 0.0), 0.5);
  }
}

// Between two plates of one object: back from the sphere a ray is known to be blocked by the upper one's top,
// beyond the falloff's radius, and ahead it meets the lower one, behind its origin. That it meets the upper
// one's bottom, 0.3 above, only tracing tells: within 0.5 that hides rays at sines up to 0.8. Those of 256
// rays lie on squares' outlines in the unit disc at 1 / 16, 3 / 16 and so on: up to 11 / 16 there are 12
// x 12.
TEST_F(FieldDoubtCasesTest, WhatBlocksAtAnUnknownPlaceIsTraced) {
  scene::Scene scene;
  scene::addPart(scene, "receiver", scene::card({0.0, 0.0, 0.0}, {0.0, 0.0, 0.3}, {0.3, 0.0, 0.0}),
                 glm::vec3(0.5F), scene::Role::ReceiverOnly);
  scene::Mesh plates = scene::box({-1.0, -0.5, -1.0}, {1.0, -0.3, 1.0});
  scene::append(plates, scene::box({-1.0, 0.3, -1.0}, {1.0, 0.9, 1.0}));
  scene::addPart(scene, "plates", plates, glm::vec3(0.5F));
  scene::setStillCamera(scene, {{0.0, 0.2, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 40.0});
  const double diagonal = frame::GpuScene(scene).diagonal();
  const Given given = {{"rays", int64_t{256}},
                       {"radius", 0.5 / diagonal},
                       {"objects", std::string("parts")},
                       {"positions", int64_t{1090}},
                       {"directions", int64_t{32}}};
  const auto mean = [&](const Given& with) {
    const Image image = render(scene, kCasesOcclusion, with, kCasesPx).product;
    double sum = 0.0;
    for (int y = 0; y < kCasesPx.y; ++y)
      for (int x = 0; x < kCasesPx.x; ++x) sum += image.at(x, y);
    return sum / pixels();
  };
  EXPECT_NEAR(mean(near(kCasesOcclusion, given, "doubtful",
                        {{"reach", 0.0}, {"footprints", 0.0}, {"capacity", 1.0}})),
              1.0 - 144.0 / 256.0, 1e-5);
  EXPECT_NEAR(mean(near(kCasesOcclusion, given, "traced", {{"footprints", 0.0}})), 1.0 - 144.0 / 256.0, 1e-5);
  EXPECT_GT(mean(near(kCasesOcclusion, given, "field")), 0.9);
}

// Nothing is there to occlude: a caster without extent has no field.
TEST_F(FieldDoubtCasesTest, WithoutObjectsNothingIsDark) {
  scene::Scene scene;
  scene::addGround(scene, 8.0);
  scene::Mesh point;
  point.positions = std::vector<glm::dvec3>(3, {0.1, 0.5, 0.0});
  point.triangles = {{0, 1, 2}};
  scene::addPart(scene, "point", point, glm::vec3(0.5F));
  scene.lights = {scene::lightTowards({0.0, 4.0, 0.0}, {0.0, 0.0, 0.0}, glm::dvec2(0.8))};
  scene::setStillCamera(scene, {{0.0, 0.4, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 60.0});
  scene::PartMotion motion;
  motion.part = 1, motion.travel = {0.1, 0.0, 0.0};
  for (const bool moves : {false, true}) {
    if (moves) scene.motions = {motion};
    for (const char* technique : {kCasesOcclusion, kCasesShadows})
      for (const char* kind : {"field", "traced", "doubtful"}) {
        const Rendered found =
            render(scene, technique, near(technique, {{"rays", int64_t{4}}}, kind), kCasesPx, true);
        for (const float value : found.product.data) ASSERT_EQ(value, 1.0F) << technique << ' ' << kind;
        EXPECT_EQ(found.counter("field_objects"), 0.0);
      }
  }
}

}  // namespace
}  // namespace limen::techniques
