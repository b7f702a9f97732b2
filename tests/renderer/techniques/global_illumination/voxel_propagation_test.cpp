// SPDX-License-Identifier: BSD-3-Clause
// Light in a grid of voxels: its energy, what walls let through, and its error beside that of its rivals.
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/references/counter_random.h"
#include "renderer/references/triangle_tree.h"
#include "renderer/techniques/global_illumination/voxel_propagation/light_grid.h"
#include "tests/renderer/techniques/global_illumination/indirect_light_fixture.h"

namespace limen::techniques {
namespace {

class VoxelPropagationLight : public IndirectLightTest {};

/// The flux of a surface of radiance e and area A is pi e A. Areas of samples sum to the surface's, which
/// leaves the rounding of fixed-point sums, half a unit of 2^-16 of more than one unit for each sample, and
/// of half floats, 2^-11.
TEST_F(VoxelPropagationLight, EmittersPutInTheirFlux) {
  const scene::Scene scene = makeScene("global_illumination/closed_box", {{"emission", 0.5}});
  const Rendered rendered = indirect(scene, {{"iterations", int64_t{0}}}, true);
  const double expected = std::numbers::pi * 0.5 * 24.0;
  EXPECT_NEAR(rendered.counter("injected_flux"), expected, 1e-3 * expected);
  EXPECT_EQ(rendered.counter("homeless_samples"), 0.0);
}

/// GI-03. The lamp's light that the room reflects, integrated on the CPU in double precision with a ray each
/// from random points of every triangle: 400 a square unit, whose relative error is below 1 %. The
/// specification allows 2 % in all.
TEST_F(VoxelPropagationLight, InjectedFluxIsWhatTheSurfacesReflect) {
  const scene::Scene scene = makeScene("global_illumination/room");
  const double strength = 0.8;
  const references::Triangles triangles(scene, glm::dvec3(0.0));
  const references::TriangleTree tree(triangles);
  const glm::dvec3 lamp = scene.lights[0].centre;
  double flux = 0.0;
  for (const scene::Part& part : scene.parts) {
    const glm::vec3 colour = scene.materials[part.material].albedo;
    const double albedo = (double(colour.r) + colour.g + colour.b) / 3.0;
    for (uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t) {
      const glm::dvec3 a = triangles.corner(t, 0), b = triangles.corner(t, 1), c = triangles.corner(t, 2);
      const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
      const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
      const int count = 16 + static_cast<int>(400.0 * area);
      for (int i = 0; i < count; ++i) {
        glm::dvec2 u = references::uniform2(7, t, static_cast<uint64_t>(i));
        if (u.x + u.y > 1.0) u = 1.0 - u;
        const glm::dvec3 point = a + u.x * (b - a) + u.y * (c - a);
        const double cosine = std::abs(glm::dot(glm::normalize(lamp - point), normal));
        if (tree.any({point, lamp - point, t, 1.0})) continue;
        flux += std::numbers::pi * albedo * strength * cosine * area / count;
      }
    }
  }
  for (const int64_t resolution : {16, 32}) {
    const Rendered rendered = indirect(
        scene, {{"iterations", int64_t{0}}, {"strength", strength}, {"resolution", resolution}}, true);
    EXPECT_NEAR(rendered.counter("injected_flux"), flux, 0.02 * flux) << resolution;
  }
}

/// GI-06, MT-02. What leaves a voxel is what it holds, so that no step adds to it but by rounding of half
/// floats, 2^-11, and in a closed box of albedo a no step leaves less than the share a.
TEST_F(VoxelPropagationLight, StepsCreateNoEnergy) {
  for (const char* transport : {"moments", "faces"})
    for (const char* reflection : {"axis", "normal", "diffuse"}) {
      const Rendered rendered = indirect(makeScene("global_illumination/closed_box", {{"albedo", 0.9}}),
                                         {{"resolution", int64_t{12}},
                                          {"iterations", int64_t{128}},
                                          {"transport", std::string(transport)},
                                          {"reflection", std::string(reflection)}},
                                         true);
      EXPECT_LT(rendered.counter("largest_gain"), 1.0 + 1.0 / 2048.0) << transport << ", " << reflection;
      EXPECT_LT(rendered.counter("remaining_flux"), 0.5) << transport << ", " << reflection;
      EXPECT_GT(rendered.counter("last_gain"), 0.9 - 1.0 / 1024.0) << transport << ", " << reflection;
      ASSERT_EQ(rendered.series.size(), 1U);
      const std::vector<double>& flux = rendered.series[0].values;
      ASSERT_EQ(flux.size(), 129U);
      EXPECT_EQ(flux[0], rendered.counter("injected_flux"));
      for (size_t step = 1; step < flux.size(); ++step) {
        EXPECT_LT(flux[step], flux[step - 1] * (1.0 + 1.0 / 2048.0))
            << transport << ", " << reflection << step;
        EXPECT_GT(flux[step], flux[step - 1] * (0.9 - 1.0 / 1024.0))
            << transport << ", " << reflection << step;
      }
    }
}

/// The rule as printed, R1: a field that is equal everywhere keeps 0.8787 of itself at a step with cones of
/// 45 degrees and their solid angle, as these have so much of the sphere, and 2 pi (1 - cos 45) = 1.8403
/// times as much without. No lasting field is equal, but the gain of the first step, whose light is all in
/// cosine lobes beside walls, is bounded by both sides: the specification's gains, and those of clamping.
TEST_F(VoxelPropagationLight, ThePrintedRuleLosesOrCreatesEnergy) {
  const scene::Scene box = makeScene("global_illumination/closed_box", {{"albedo", 0.9}});
  const auto gain = [&](bool normalised) {
    return indirect(box,
                    {{"transport", std::string("cones")},
                     {"transport.normalised", normalised},
                     {"iterations", int64_t{24}},
                     {"format", std::string("32f")}},
                    true)
        .counter("last_gain");
  };
  const double with = gain(true), without = gain(false);
  EXPECT_LT(with, 0.9);
  EXPECT_GT(without, 1.3);
  // Each step is 1.8403 times as much, whatever the field.
  EXPECT_NEAR(without / with, 1.8403, 0.001);
}

/// In a closed box nothing is lost but what surfaces absorb: of what was put in, all arrives once, a share
/// albedo again, and so on. 1 / (1 - 1/2) = 2 in all.
TEST_F(VoxelPropagationLight, AClosedBoxGathersTheGeometricSum) {
  const scene::Scene box = makeScene("global_illumination/closed_box", {{"albedo", 0.5}});
  for (const GridReflection reflection :
       {GridReflection::Axis, GridReflection::Normal, GridReflection::Diffuse})
    for (const LightTransport& transport :
         {LightTransport(MomentTransport{}), LightTransport(FaceTransport{})}) {
      LightGridSettings settings;
      settings.resolution = 12, settings.reflection = reflection, settings.transport = transport;
      settings.steps.sources = LightSources::Once, settings.format = FieldFormat::Single;
      const frame::GpuScene gpuScene(box);
      frame::Frame frame(context(), box, gpuScene, {8, 8});
      LightGrid grid(frame, settings, {});
      frame.begin();
      grid.start(frame);
      const double before = grid.flux().g;
      for (int step = 0; step < 256; ++step) grid.arrive(step == 0), grid.propagate();
      EXPECT_LT(grid.flux().g, 1e-3 * before);
      const voxels::VoxelGrid& voxels = grid.volume().grid();
      double arrived = 0.0;
      for (int layer = 0; layer < 6 * voxels.resolution.z; ++layer) {
        const Image one = grid.arrived().readLayer(layer);
        for (size_t i = 0; i < one.pixels(); ++i) arrived += one.data[4 * i + 1];
      }
      // What is left on its way, and the albedo's rounding to half floats: none.
      EXPECT_NEAR(arrived * voxels.voxelSize * voxels.voxelSize, 2.0 * before, 4e-3 * before);
      frame.end();
    }
}

/// GI-09. With a limit of n the sum ends after n terms, 1 + a + ... + a^(n - 1), whether light is put in once
/// and gathered over all steps, or lasts until what arrives at each step is all that is put in at one.
TEST_F(VoxelPropagationLight, ALimitOnBouncesEndsTheSum) {
  const double albedo = 0.5;
  const scene::Scene box = makeScene("global_illumination/closed_box", {{"albedo", albedo}});
  for (const LightSources sources : {LightSources::Once, LightSources::Steady})
    for (const int most : {1, 2, 4}) {
      LightGridSettings settings;
      settings.resolution = 12, settings.iterations = 128, settings.steps.bounces = LimitedBounces{most};
      settings.steps.sources = sources, settings.format = FieldFormat::Single;
      const frame::GpuScene gpuScene(box);
      frame::Frame frame(context(), box, gpuScene, {8, 8});
      LightGrid grid(frame, settings, {});
      frame.begin();
      grid.start(frame);
      const double before = grid.flux().g;
      grid.update(frame);
      const voxels::VoxelGrid& voxels = grid.volume().grid();
      double arrived = 0.0, expected = 0.0;
      for (int layer = 0; layer < 6 * voxels.resolution.z; ++layer) {
        const Image one = grid.arrived().readLayer(layer);
        for (size_t i = 0; i < one.pixels(); ++i) arrived += one.data[4 * i + 1];
      }
      for (int bounce = 0; bounce < most; ++bounce) expected += std::pow(albedo, bounce);
      // What is still on its way after as many steps as ten crossings: none.
      EXPECT_NEAR(arrived * voxels.voxelSize * voxels.voxelSize, expected * before, 4e-3 * before)
          << most << ", " << limen::toText(sources);
      frame.end();
    }
}

/// GI-09. What each bounce adds, the difference of two limits, is what it adds to paths, with less than
/// three fifths of the error of adding nothing; light of all bounces is farther from paths of one and two.
TEST_F(VoxelPropagationLight, EachBounceAddsWhatItAddsToPaths) {
  for (const char* name : {"global_illumination/two_rooms", "global_illumination/room"}) {
    const scene::Scene scene = makeScene(name);
    const Image all = indirect(scene, {}).product, nothing(32, 24, 4);
    Image limitedBefore = nothing, pathsBefore = nothing;
    const auto difference = [](Image a, const Image& b) {
      for (size_t i = 0; i < a.data.size(); ++i) a.data[i] -= b.data[i];
      return a;
    };
    for (int64_t most = 1; most <= 3; ++most) {
      const Image limited =
          indirect(scene, {{"steps.bounces", std::string("limited")}, {"steps.bounces.most", most}}).product;
      const Image paths =
          render(scene, "global_illumination/path_reference",
                 {{"paths", int64_t{64}}, {"bounces", most}, {"light", std::string("indirect")}}, {32, 24})
              .product;
      const Image added = difference(paths, pathsBefore);
      EXPECT_LT(error(difference(limited, limitedBefore), added), 0.6 * error(nothing, added))
          << name << ", " << most;
      if (most < 3) {
        EXPECT_LT(error(limited, paths), error(all, paths)) << name << ", " << most;
      }
      limitedBefore = limited, pathsBefore = paths;
    }
  }
}

/// Where light goes on from frame to frame, each bounce goes on in fields of its own, and ends as all made
/// at once.
TEST_F(VoxelPropagationLight, BouncesGoOnFromFrameToFrame) {
  const scene::Scene scene = makeScene("global_illumination/room");
  const Given base = {{"resolution", int64_t{12}},
                      {"format", std::string("32f")},
                      {"steps.bounces", std::string("limited")},
                      {"steps.bounces.most", int64_t{3}}};
  const auto with = [&](const char* update, int64_t iterations) {
    Given given = base;
    given["update"] = std::string(update), given["iterations"] = iterations;
    return given;
  };
  const Image whole = pictures(scene, with("all", 128), 1)[0], nothing(32, 24, 4);
  const Image last = pictures(scene, with("continued", 16), 24).back();
  EXPECT_LT(error(last, whole), 1e-3 * error(whole, nothing));
}

/// GI-05. Nothing is lit behind a closed wall, and half the light of a transparent wall passes a
/// half-transparent one: what crosses it three times is reflected twice between, which leaves a share of
/// albedo^2 = 1 % at most. Whether one layer of voxels holds the wall or two.
TEST_F(VoxelPropagationLight, WallsPassTheirShare) {
  for (const char* coverage : {"thin", "conservative"}) {
    const auto behind = [&](double transmittance) {
      const scene::Scene scene =
          makeScene("global_illumination/divided_room", {{"transmittance", transmittance}, {"albedo", 0.1}});
      const Rendered rendered =
          indirect(scene, {{"format", std::string("32f")}, {"coverage", std::string(coverage)}});
      return meanOf(rendered.product, 18, 32);
    };
    EXPECT_EQ(behind(0.0), 0.0) << coverage;
    const double whole = behind(1.0);
    EXPECT_GT(whole, 1e-4) << coverage;
    EXPECT_NEAR(behind(0.5) / whole, 0.5, 0.01) << coverage;
  }
}

/// A closed wall between two rooms, as a sheet and as a box, by all transports; the lamp and a panel are on
/// its other side, 128 steps.
TEST_F(VoxelPropagationLight, AClosedWallKeepsAllLight) {
  for (const double thickness : {0.0, 0.1})
    for (const char* transport : {"moments", "faces", "cones"}) {
      const scene::Scene rooms = makeScene("global_illumination/two_rooms",
                                           {{"opening", 0.0}, {"thickness", thickness}, {"emitter", 5.0}});
      const Rendered rendered =
          indirect(rooms, {{"iterations", int64_t{128}}, {"transport", std::string(transport)}});
      EXPECT_EQ(meanOf(rendered.product, 0, 32), 0.0) << thickness << ", " << transport;
    }
}

/// GI-08. A wall at 45 degrees sends what comes along x to the ceiling; mirrored at the face between voxels
/// it would go back to where it came from. The reference says how much the ceiling gets.
TEST_F(VoxelPropagationLight, ReflectionByNormalIsNearerToASlantedWallsThanByAxis) {
  const scene::Scene scene = makeScene("global_illumination/slanted_wall");
  const Image reference = truth(scene);
  const auto of = [&](const char* reflection) {
    return error(
        indirect(scene, {{"reflection", std::string(reflection)}, {"transport", std::string("cones")}})
            .product,
        reference, 12);
  };
  EXPECT_LT(of("normal"), of("axis"));
  EXPECT_LT(of("diffuse"), of("axis"));
}

/// Nearer to the truth than no indirect light, and than light propagation volumes, in every room.
TEST_F(VoxelPropagationLight, IsNearerToPathsThanItsRivals) {
  struct Case {
    const char* scene;
    Given given;
  };
  const Case cases[] = {{"global_illumination/room", {}},
                        {"global_illumination/room", {{"lit_by", std::string("emitters")}}},
                        {"global_illumination/divided_room", {}},
                        {"global_illumination/slanted_wall", {}},
                        {"global_illumination/two_rooms", {}},
                        {"cornell_box", {}}};
  for (const Case& each : cases) {
    const scene::Scene scene = makeScene(each.scene, each.given);
    const Image reference = truth(scene), nothing(32, 24, 4);
    const double found = error(indirect(scene, {}).product, reference);
    const auto volumes = [&](const char* blockers) {
      return error(indirect(scene, {{"resolution", int64_t{16}}, {"blockers", std::string(blockers)}}, false,
                            kPropagationVolumes)
                       .product,
                   reference);
    };
    // At least two fifths of the error of no indirect light are gone.
    EXPECT_LT(found, 0.6 * error(nothing, reference)) << each.scene;
    EXPECT_LT(found, volumes("none")) << each.scene;
    EXPECT_LT(found, volumes("fronts")) << each.scene;
  }
}

/// Where a wall that is turned against the grid meets another, the voxel beyond a face may be on the other
/// wall's far side, where there is no light. A strip of one voxel, 2 of 64 columns, beside the left edge of
/// the back wall has the reference's colour as the rest of that wall has: within a quarter, twice the error
/// of either's mean over 64 paths in 14 pixels (.1 each) and the grid's own (.05).
TEST_F(VoxelPropagationLight, EdgesOfTurnedWallsAreNotLitFromTheirFarSides) {
  const scene::Scene scene = makeScene("global_illumination/stand_in", {{"turn_deg", 45.0}});
  const auto colours = [&](const char* technique, Given given) {
    given["light"] = std::string("indirect");
    const Image picture = render(scene, technique, given, {64, 48}).product;
    glm::dvec3 mean(0.0);
    for (int y = 14; y < 21; ++y)
      for (int x = 17; x < 19; ++x)
        for (int c = 0; c < 3; ++c) mean[c] += picture.at(x, y, c) / 14.0;
    return mean;
  };
  const glm::dvec3 reference =
      colours("global_illumination/path_traced", {{"paths", int64_t{256}}, {"bounces", int64_t{8}}});
  const glm::dvec3 found = colours(kPropagation, {{"resolution", int64_t{16}}});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], reference[c], 0.25 * reference[c]) << "channel " << c;
}

/// GI-12. Where nothing moves, what is spread over frames ends as what is made at once. The field tends to
/// its limit from below by the factor of a bounce, .7, in each crossing of the room, some 16 steps: after 512
/// steps all have less than .7^32 = 1e-5 of it to go; half floats, each step's rounding of 2^-12, stop there
/// within 2^-11 / (1 - .98) = 2 %.
TEST_F(VoxelPropagationLight, SpreadUpdatesEndAsWholeOnes) {
  const scene::Scene scene = makeScene("global_illumination/room");
  const Given base = {{"resolution", int64_t{12}}, {"format", std::string("32f")}};
  const auto with = [&](const char* update, int64_t iterations) {
    Given given = base;
    given["update"] = std::string(update), given["iterations"] = iterations;
    return given;
  };
  const Image whole = pictures(scene, with("all", 256), 1)[0];
  double largest = 0.0;
  for (const float value : whole.data) largest = std::max(largest, double(value));
  const Image nothing(32, 24, 4);
  for (const char* update : {"continued", "axis"}) {
    const Image last = pictures(scene, with(update, 16), 16).back();
    EXPECT_LT(error(last, whole), 1e-3 * error(whole, nothing)) << update;
  }
  // Frames between updates show the last.
  const std::vector<Image> every = pictures(scene, with("every", 16), 4);
  EXPECT_EQ(every[0].data, every[2].data);
  EXPECT_EQ(every[3].data, every[0].data);
}

/// Steps that change no voxel by more than the bound are left out; the picture stays within what they would
/// have added.
TEST_F(VoxelPropagationLight, StoppingEarlyLeavesThePicture) {
  const scene::Scene scene = makeScene("global_illumination/divided_room", {{"albedo", 0.3}});
  const Given steps = {
      {"resolution", int64_t{12}}, {"iterations", int64_t{256}}, {"format", std::string("32f")}};
  Given stopped = steps;
  stopped["steps.stop_below"] = 1e-4;
  const Image a = indirect(scene, steps).product, b = indirect(scene, stopped).product;
  EXPECT_LT(error(a, b), 1e-4);
  stopped["steps.stop_below"] = 1.0;
  EXPECT_GT(error(a, indirect(scene, stopped).product), 1e-3);
}

/// GI-13. A box around the camera that holds the room, of voxels of the same size, gives what the box of the
/// scene does, but for walls that lie up to a voxel, 1/14 of the room, farther in. In a closed box that emits
/// e everywhere, that is e a / (1 - a) = 0.5.
TEST_F(VoxelPropagationLight, ABoxAroundTheCameraShowsTheSameRoom) {
  const scene::Scene scene = makeScene("global_illumination/closed_box", {{"emission", 0.5}});
  const double size = 2.0 / (16.0 - 1.9);
  const double whole = meanOf(indirect(scene, {}).product, 0, 32);
  const double box = meanOf(indirect(scene, {{"box", std::string("camera")},
                                             {"box.side", 32.0 * size},
                                             {"resolution", int64_t{32}},
                                             {"iterations", int64_t{48}}})
                                .product,
                            0, 32);
  EXPECT_NEAR(whole, 0.5, 0.5 / 14.0);
  EXPECT_NEAR(box, whole, 2.0 * whole / 14.0);
}

}  // namespace
}  // namespace limen::techniques
