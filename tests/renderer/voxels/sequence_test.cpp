// SPDX-License-Identifier: BSD-3-Clause
// Sequences of frames: what stays, what goes, and what does not depend on how it is done.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "renderer/techniques/incremental_voxelization/incremental_technique.h"
#include "renderer/voxels/exact_voxels.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

struct Sequence {
  std::vector<uint8_t> voxels;
  voxels::VoxelGrid grid;
  std::vector<Image> normals, lights;  // a layer each; only with attributes
  std::map<std::string, double> counters;
  std::map<std::string, Image> atlas;  // of the point raster
};

double sumOf(const std::vector<Image>& images, int channel) {
  double sum = 0.0;
  for (const Image& image : images)
    for (size_t i = 0; i < image.pixels(); ++i) sum += image.data[4 * i + static_cast<size_t>(channel)];
  return sum;
}

// Whether the way from a point to another meets the box, made larger by `margin` on each side.
bool meetsBox(glm::dvec3 from, glm::dvec3 to, const scene::Bounds& box, double margin) {
  const glm::dvec3 a = (box.low - margin - from) / (to - from), b = (box.high + margin - from) / (to - from);
  const glm::dvec3 enter = glm::min(a, b), leave = glm::max(a, b);
  return std::max({enter.x, enter.y, enter.z, 0.0}) < std::min({leave.x, leave.y, leave.z, 1.0});
}

class IncrementalSequence : public TechniqueTest {
 protected:
  static Sequence run(const scene::Scene& scene, const std::string& technique, Given given,
                      glm::ivec2 sizePx = {96, 80}, bool attributes = false) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get("incremental_voxelization/" + technique);
    if (technique != "single_pass") given.emplace("points.side", int64_t{160});
    if (technique != "point_raster") given.emplace("attributes", attributes);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    frame.end();
    Sequence out;
    for (const Counter& counter : made->count(frame)) out.counters[counter.name] = counter.value;
    const auto& incremental = dynamic_cast<const IncrementalTechnique&>(*made);
    out.voxels = incremental.volume().readOccupied();
    out.grid = incremental.volume().grid();
    for (const auto& [name, texture] : made->debugViews()) out.atlas[name] = texture->read();
    if (attributes)
      for (int z = 0; z < out.grid.resolution.z; ++z) {
        out.normals.push_back(incremental.volume().normal().readLayer(z));
        out.lights.push_back(incremental.volume().light().readLayer(z));
      }
    return out;
  }
  static Given sequence(int frames, double stepS, Given more = {}) {
    more["sequence.frames"] = int64_t{frames};
    more["sequence.step_s"] = stepS;
    more.emplace("resolution", int64_t{48});
    more.emplace("light_map.use", std::string("shade"));
    return more;
  }
  /// A door that swings; the eye passes it by, 1.9 m in 2 s.
  static scene::Scene passing(double turnDegS) {
    scene::Scene scene = makeScene("moving/door", {{"figure", false}, {"turn_deg_s", turnDegS}});
    scene::CameraPath path;
    const scene::Camera first = scene.camera.at(0.0);
    scene::Camera last = first;
    last.eye.x += 1.9;
    path.keys = {{-2.0, first}, {0.0, last}};
    scene.camera = path;
    return scene;
  }
  static Given aroundTheEye(const std::string& move) {
    return sequence(20, 0.1,
                    {{"box", std::string("around_camera")},
                     {"box.move", move},
                     {"box.extent", 1.5},
                     {"box.step", int64_t{4}},
                     {"resolution", int64_t{64}}});
  }
  static int64_t countWithin(const Sequence& of, glm::dvec3 low, glm::dvec3 high) {
    int64_t count = 0;
    glm::ivec3 v;
    for (v.z = 0; v.z < of.grid.resolution.z; ++v.z)
      for (v.y = 0; v.y < of.grid.resolution.y; ++v.y)
        for (v.x = 0; v.x < of.grid.resolution.x; ++v.x) {
          const glm::dvec3 at = of.grid.centre(v);
          if (of.voxels[static_cast<size_t>(of.grid.indexOf(v))] && glm::all(glm::greaterThan(at, low)) &&
              glm::all(glm::lessThan(at, high)))
            ++count;
        }
    return count;
  }
};

// The box was 1.2 m to the left a second ago, before the wall, which is seen there now.
TEST_F(IncrementalSequence, AMovingBoxIsClearedExactly) {
  const scene::Scene scene = makeScene("moving/box");
  for (const char* proof : {"centre", "footprint"}) {
    const Given given = sequence(1, 1.0, {{"clean_up.proof", std::string(proof)}});
    const Sequence before = run(scene, "two_stage", sequence(0, 1.0));
    const Sequence after = run(scene, "two_stage", given);
    const glm::dvec3 low(-1.5, 0.9, -0.3), high(-0.9, 1.5, 0.3);
    EXPECT_EQ(countWithin(after, low, high), 0) << proof;
    // Its front is 6 x 6 voxels at least.
    EXPECT_GE(after.counters.at("cleared_voxels"), 36.0) << proof;
    EXPECT_EQ(after.counters.at("stale_voxels"), 0.0) << proof;
    EXPECT_EQ(after.counters.at("extra_voxels"), 0.0) << proof;
    // Of the wall more is known than is seen now.
    EXPECT_LT(after.counters.at("missing_voxels"), before.counters.at("missing_voxels")) << proof;
  }
  // Where it was is not where nothing ever was.
  scene::Scene then = scene;
  for (scene::PartMotion& motion : then.motions) motion.startS = -1.0;
  EXPECT_GT(countWithin(run(then, "two_stage", sequence(0, 1.0)), {-1.5, 0.9, -0.3}, {-0.9, 1.5, 0.3}), 36);
}

// The door closes within the second before the picture; from then on the wall behind it is hidden.
TEST_F(IncrementalSequence, AHiddenWallPersists) {
  const scene::Scene scene =
      makeScene("moving/door", {{"start_deg", 0.0}, {"turn_deg_s", 90.0}, {"figure", false}});
  const glm::dvec3 low(-0.4, 0.3, -1.9), high(0.4, 1.7, -1.6);
  const Given given = sequence(20, 0.05);
  const Sequence kept = run(scene, "two_stage", given), forgotten = run(scene, "single_frame", given),
                 single = run(scene, "single_pass", sequence(20, 0.05));
  EXPECT_EQ(countWithin(forgotten, low, high), 0);
  // The open door, seen edge on, hides a part of the wall: half of these 0.8 x 1.4 m have been seen at least.
  const double half = 0.5 * 0.8 * 1.4 / (kept.grid.voxelSize * kept.grid.voxelSize);
  EXPECT_GT(countWithin(kept, low, high), half);
  EXPECT_GT(countWithin(single, low, high), half);
  EXPECT_LT(kept.counters.at("missing_voxels"), forgotten.counters.at("missing_voxels") - half);
  // Before the closed door nothing is left of how it swung; behind it nobody has seen that it is gone.
  EXPECT_EQ(countWithin(kept, {-0.5, 0.3, 0.15}, {0.5, 1.7, 0.8}), 0);
  EXPECT_GT(kept.counters.at("stale_voxels"), 0.0);
}

// A raster of points and compute shaders fill and clear the same voxels; so do layers and an atlas.
TEST_F(IncrementalSequence, PointRasterAndComputeFillTheSameVoxels) {
  const scene::Scene scene = makeScene("moving/door");
  for (const char* use : {"shade", "voxels"}) {
    Given given = sequence(6, 0.2,
                           {{"light_map.use", std::string(use)},
                            {"light_map.resolution", int64_t{128}},
                            {"clean_up.proof", std::string("centre")},
                            {"clean_up.bias", std::string("radius")},
                            {"points.shift", false}});
    const Sequence compute = run(scene, "two_stage", given);
    for (const int64_t targets : {1, 4})
      for (const char* layout : {"layers", "atlas"}) {
        given["layout"] = std::string(layout);
        given["targets"] = targets;
        EXPECT_EQ(run(scene, "point_raster", given).voxels, compute.voxels)
            << layout << " " << targets << " " << use;
      }
    EXPECT_GT(voxels::countOf(compute.voxels), 2000);
  }
}

// Only what moves can become stale.
TEST_F(IncrementalSequence, CleaningWherePartsMoveGivesTheSameForLess) {
  for (const char* name : {"moving/box", "moving/door"}) {
    const scene::Scene scene = makeScene(name);
    const Sequence all = run(scene, "two_stage", sequence(8, 0.11));
    const Sequence some = run(scene, "two_stage", sequence(8, 0.11, {{"region", std::string("moving")}}));
    // Elsewhere, what is filled again at once may have been emptied.
    EXPECT_EQ(voxels::compare(all.voxels, some.voxels).extra, 0) << name;
    EXPECT_LE(voxels::compare(all.voxels, some.voxels).missing, 0.001 * double(voxels::countOf(all.voxels)))
        << name;
    EXPECT_EQ(some.counters.at("stale_voxels"), all.counters.at("stale_voxels")) << name;
    EXPECT_LT(some.counters.at("tested_bricks"), 0.7 * all.counters.at("tested_bricks")) << name;
  }
}

// Light that comes from elsewhere in each frame does not add up: a surface shows no more than the light's
// strength times its reflectance, and where the camera sees it, what it shows now.
TEST_F(IncrementalSequence, LightDoesNotBuildUp) {
  const scene::Scene scene = makeScene("moving/box", {{"reach", 0.0}});
  const auto lit = [&](int frames) {
    return run(scene, "two_stage",
               sequence(frames, 0.01,
                        {{"sequence.light_turn", 9.0},
                         {"points.shift", false},
                         {"light_map.use", std::string("voxels")}}),
               {96, 80}, true);
  };
  const Sequence once = lit(0), often = lit(12);
  double brightest = 0.0, onceSum = 0.0, oftenSum = 0.0;
  for (size_t z = 0; z < once.lights.size(); ++z)
    for (int y = 0; y < once.lights[z].height; ++y)
      for (int x = 0; x < once.lights[z].width; ++x) {
        brightest = std::max(brightest, double(often.lights[z].at(x, y, 0)));
        if (once.lights[z].at(x, y, 3) > 0.0F) {
          onceSum += once.lights[z].at(x, y, 0);
          oftenSum += often.lights[z].at(x, y, 0);
        }
      }
  EXPECT_LE(brightest, 0.8 * 0.65 + 1e-3);  // half floats
  EXPECT_GT(onceSum, 100.0);
  EXPECT_NEAR(oftenSum, onceSum, 0.001 * onceSum);
}

// A cosine lobe has 0.886 times its radiance in band 0. Samples of the camera replace each other in one form
// and are averaged in the other; what the light's image alone shows are sums of areas there, means here.
// Neither grows while the light turns about the scene.
TEST_F(IncrementalSequence, HarmonicsOfThePointRasterHoldTheSameLight) {
  const scene::Scene scene = makeScene("moving/box", {{"reach", 0.0}});
  for (const char* use : {"shade", "voxels"}) {
    const auto given = [&](int frames) {
      return sequence(frames, 0.01,
                      {{"sequence.light_turn", 9.0},
                       {"points.shift", false},
                       {"light_map.use", std::string(use)},
                       {"clean_up.proof", std::string("centre")},
                       {"light_map.resolution", int64_t{512}}});
    };
    const Sequence compute = run(scene, "two_stage", given(0), {160, 160}, true);
    const Sequence raster = run(scene, "point_raster", given(0), {160, 160});
    const Sequence later = run(scene, "point_raster", given(8), {160, 160});
    for (int channel = 0; channel < 3; ++channel) {
      const Image& atlas = raster.atlas.at(channel == 0   ? "harmonics_red"
                                           : channel == 1 ? "harmonics_green"
                                                          : "harmonics_blue");
      const double expected = 0.886226925 * sumOf(compute.lights, channel);
      EXPECT_GT(expected, 100.0);
      // At the borders of surfaces voxels hold parts of them.
      EXPECT_NEAR(sumOf({atlas}, 0), expected, 0.03 * expected) << use;
    }
    EXPECT_NEAR(sumOf({later.atlas.at("harmonics_red")}, 0), sumOf({raster.atlas.at("harmonics_red")}, 0),
                0.05 * sumOf({raster.atlas.at("harmonics_red")}, 0))
        << use;
  }
}

// The box's shadow on the floor: dark where the way to the light's middle meets the box, elsewhere Lambert's
// law.
TEST_F(IncrementalSequence, VoxelsInAShadowAreDark) {
  const scene::Scene scene = makeScene("moving/box", {{"reach", 0.0}});
  const scene::Bounds box{glm::dvec3(0.013, 1.207, 0.011) - 0.25, glm::dvec3(0.013, 1.207, 0.011) + 0.25};
  const glm::dvec3 light = scene.lights.at(0).centre;
  const double strength = 0.7, albedo = 0.65;
  for (const char* use : {"shade", "voxels"}) {
    const Sequence lit = run(scene, "two_stage",
                             sequence(0, 0.01,
                                      {{"light_map.use", std::string(use)},
                                       {"light_map.resolution", int64_t{512}},
                                       {"light_map.strength", strength}}),
                             {160, 160}, true);
    const double side = lit.grid.voxelSize, reach = 0.5 * std::sqrt(3.0) * side;
    int dark = 0, bright = 0;
    glm::ivec3 v;
    for (v.z = 0; v.z < lit.grid.resolution.z; ++v.z)
      for (v.y = 0; v.y < lit.grid.resolution.y; ++v.y)
        for (v.x = 0; v.x < lit.grid.resolution.x; ++v.x) {
          const glm::dvec3 at = lit.grid.centre(v);
          if (!lit.voxels[static_cast<size_t>(lit.grid.indexOf(v))] || std::abs(at.y) > 0.5 * side + 1e-3 ||
              at.z < -2.0 + 2.0 * side)
            continue;
          const double value = lit.lights[static_cast<size_t>(v.z)].at(v.x, v.y, 0);
          const glm::dvec3 place(at.x, 0.0, at.z), away = light - place;
          if (meetsBox(place, light, box, -reach)) {
            ++dark;
            EXPECT_LT(value, 1e-3) << use << " " << at.x << " " << at.z;
          } else if (!meetsBox(place, light, box, reach)) {
            ++bright;
            EXPECT_NEAR(value, strength * albedo * away.y / glm::length(away), 0.02)
                << use << " " << at.x << " " << at.z;
          }
        }
    EXPECT_GT(dark, 20) << use;
    EXPECT_GT(bright, 500) << use;
  }
}

TEST_F(IncrementalSequence, TheSameFramesGiveTheSameBytes) {
  const scene::Scene scene = makeScene("moving/door");
  const Given given = sequence(4, 0.1, {{"light_map.use", std::string("voxels")}});
  const Sequence one = run(scene, "two_stage", given, {96, 80}, true),
                 two = run(scene, "two_stage", given, {96, 80}, true);
  EXPECT_EQ(one.voxels, two.voxels);
  for (size_t z = 0; z < one.normals.size(); ++z) {
    EXPECT_EQ(one.normals[z].data, two.normals[z].data);
    EXPECT_EQ(one.lights[z].data, two.lights[z].data);
  }
}

// A box around the eye moves by steps; each time it starts anew.
TEST_F(IncrementalSequence, AMovedBoxIsFoundAndStartsAnew) {
  const scene::Scene scene = passing(0.0);
  const Sequence run20 = run(scene, "two_stage", aroundTheEye("empty"));
  const double step = 4.0 * 1.5 * scene.bounds().diagonal() / 64.0;
  // In units of the step along x, 1.9 m hold floor or ceiling of their quotient borders.
  EXPECT_GE(run20.counters.at("restarts"), std::floor(1.9 / step));
  EXPECT_LE(run20.counters.at("restarts"), std::ceil(1.9 / step));
  EXPECT_GT(run20.counters.at("restarts"), 0.0);
  EXPECT_EQ(run20.counters.at("extra_voxels"), 0.0);
  EXPECT_GT(run20.counters.at("voxels"), 500.0);
}

// A jump beyond the box leaves nothing of it, whether it scrolls or not: it is told as a restart, and what is
// there is what a box that was made at that place has.
TEST_F(IncrementalSequence, AJumpBeyondTheBoxStartsAnew) {
  scene::Scene scene = makeScene("moving/box", {{"reach", 0.0}});
  scene::Camera last = scene.camera.at(0.0), first;
  last.eye = {1.6, 0.5, 0.2};
  last.target = last.eye + glm::dvec3(0.3, -1.0, -0.4);
  for (const glm::dvec3 away : {glm::dvec3(-3.2, 0.0, 0.0), glm::dvec3(-3.2, 0.3, -0.7)}) {
    first = last;
    first.eye += away, first.target += away;
    scene::CameraPath path;
    path.keys = {{-1.0, first}, {-0.5, first}, {-0.49, last}, {0.0, last}};
    scene.camera = path;
    const auto given = [](int frames, const char* move) {
      return sequence(frames, 0.5,
                      {{"box", std::string("around_camera")},
                       {"box.move", std::string(move)},
                       {"box.extent", 0.3},
                       {"box.step", int64_t{4}},
                       {"points.shift", false},
                       {"resolution", int64_t{40}}});
    };
    const Sequence alone = run(scene, "two_stage", given(0, "scroll"));
    EXPECT_EQ(alone.counters.at("restarts") + alone.counters.at("scrolls"), 0.0);
    EXPECT_GT(voxels::countOf(alone.voxels), 100);
    for (const char* move : {"empty", "scroll"}) {
      const Sequence jumped = run(scene, "two_stage", given(2, move));
      EXPECT_EQ(jumped.counters.at("restarts"), 1.0) << move;
      EXPECT_EQ(jumped.counters.at("scrolls"), 0.0) << move;
      EXPECT_EQ(jumped.voxels, alone.voxels) << move;
    }
  }
}

TEST_F(IncrementalSequence, PointRasterAndComputeHoldTheSameInABoxThatMoves) {
  const scene::Scene scene = passing(40.0);
  int64_t emptied = 0;
  for (const char* move : {"empty", "scroll"}) {
    Given given = aroundTheEye(move);
    given["resolution"] = int64_t{32};
    given["clean_up.proof"] = std::string("centre");
    given["points.shift"] = false;
    const Sequence compute = run(scene, "two_stage", given);
    EXPECT_GT(compute.counters.at("restarts") + compute.counters.at("scrolls"), 0.0);
    for (const char* layout : {"layers", "atlas"}) {
      given["layout"] = std::string(layout);
      EXPECT_EQ(run(scene, "point_raster", given).voxels, compute.voxels) << layout << " " << move;
    }
    // What scrolls holds more.
    EXPECT_GT(voxels::countOf(compute.voxels), emptied);
    emptied = voxels::countOf(compute.voxels);
  }
}

// Bricks of a box that scrolls are where voxels are stored, not where they are.
TEST_F(IncrementalSequence, CleaningWherePartsMoveGivesTheSameInABoxThatScrolls) {
  const scene::Scene scene = passing(40.0);
  const Given given = aroundTheEye("scroll");
  Given moving = given;
  moving["region"] = std::string("moving");
  const Sequence all = run(scene, "two_stage", given), some = run(scene, "two_stage", moving);
  EXPECT_GT(all.counters.at("scrolls"), 0.0);
  EXPECT_EQ(voxels::compare(all.voxels, some.voxels).extra, 0);
  EXPECT_LE(voxels::compare(all.voxels, some.voxels).missing, 0.001 * double(voxels::countOf(all.voxels)));
  EXPECT_EQ(some.counters.at("stale_voxels"), all.counters.at("stale_voxels"));
  EXPECT_LT(some.counters.at("tested_bricks"), all.counters.at("tested_bricks"));
}

}  // namespace
}  // namespace limen::techniques
