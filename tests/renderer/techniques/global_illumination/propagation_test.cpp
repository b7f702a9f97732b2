// SPDX-License-Identifier: BSD-3-Clause
// Propagation in a grid against the same rule in double precision, written apart from it and the other way
// round: voxels send to their neighbours, where the shader lets each take. And its balance of energy.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/techniques/global_illumination/voxel_grid/light_grid.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

/// Of all voxels, one channel: constant and x, y, z.
using Lobes = std::vector<std::array<double, 4>>;

/// Where light is at some step, read from the GPU.
struct GridState {
  glm::ivec3 size{0};
  std::vector<uint8_t> solid;
  std::vector<glm::dvec4> normal, albedo;  ///< opacity in normal.w
  std::array<Lobes, 3> field, gathered;
};

std::array<Lobes, 3> readLobes(const gl::Texture& texture, glm::ivec3 size) {
  std::array<Lobes, 3> out;
  for (int channel = 0; channel < 3; ++channel)
    for (int z = 0; z < size.z; ++z) {
      const Image layer = texture.readLayer(channel * size.z + z);
      for (size_t i = 0; i < layer.pixels(); ++i) {
        const float* at = &layer.data[4 * i];
        out[size_t(channel)].push_back({at[0], at[3], at[1], at[2]});
      }
    }
  return out;
}

std::vector<glm::dvec4> readAttribute(const gl::Texture& texture, int depth) {
  std::vector<glm::dvec4> out;
  for (int z = 0; z < depth; ++z) {
    const Image layer = texture.readLayer(z);
    for (size_t i = 0; i < layer.pixels(); ++i)
      out.emplace_back(layer.data[4 * i], layer.data[4 * i + 1], layer.data[4 * i + 2],
                       layer.data[4 * i + 3]);
  }
  return out;
}

class GridSender {
 public:
  GridSender(const LightGridSettings& settings, GridState& state) : settings_(settings), state_(state) {
    const double cosine = settings.cone == LightCone::Sixth ? 2.0 / 3.0 : std::cos(std::numbers::pi / 4.0);
    constant_ = std::sqrt(std::numbers::pi) * (1.0 - cosine);
    linear_ = 0.5 * std::sqrt(3.0 * std::numbers::pi) * (1.0 - cosine * cosine);
  }

  void step() {
    for (size_t channel = 0; channel < 3; ++channel) {
      const Lobes before = state_.field[channel];
      state_.field[channel].assign(before.size(), {});
      for (size_t from = 0; from < before.size(); ++from) send(channel, from, before[from]);
    }
  }

 private:
  static constexpr size_t kOutside = ~size_t{0};

  size_t beside(size_t voxel, int axis, int side) const {
    const auto x = static_cast<size_t>(state_.size.x), y = static_cast<size_t>(state_.size.y);
    glm::ivec3 at(int(voxel % x), int(voxel / x % y), int(voxel / (x * y)));
    at[axis] += side;
    if (at[axis] < 0 || at[axis] >= state_.size[axis]) return kOutside;
    return static_cast<size_t>(at.x) + x * (static_cast<size_t>(at.y) + y * static_cast<size_t>(at.z));
  }

  void send(size_t channel, size_t from, const std::array<double, 4>& light) {
    std::array<double, 6> cone{};
    std::array<size_t, 6> to{};
    double toEmpty = 0.0, within = 0.0, all = 0.0;
    for (size_t face = 0; face < 6; ++face) {
      const int axis = int(face / 2), side = face % 2 == 0 ? 1 : -1;
      cone[face] = std::max(0.0, constant_ * light[0] + side * linear_ * light[size_t(axis) + 1]);
      to[face] = beside(from, axis, side);
      all += cone[face];
      if (to[face] == kOutside) continue;
      within += cone[face];
      if (state_.solid[to[face]] == 0) toEmpty += cone[face];
    }
    const double holds = std::sqrt(4.0 * std::numbers::pi) * std::max(0.0, light[0]);
    const bool solid = state_.solid[from] != 0;
    for (size_t face = 0; face < 6; ++face) {
      if (to[face] == kOutside || cone[face] == 0.0) continue;
      double flux = cone[face], shared = all;
      if (settings_.exchange == SolidExchange::Open && solid) {
        // To empty voxels alone; to others if there are none.
        const bool hasEmpty = toEmpty > 1e-4 * all;
        if (hasEmpty && state_.solid[to[face]] != 0) continue;
        shared = hasEmpty ? toEmpty : within;
      }
      if (settings_.shares == FluxShares::Conserving) flux *= holds / shared;
      receive(channel, to[face], int(face / 2), face % 2 == 0 ? 1.0 : -1.0, flux);
    }
  }

  static void add(std::array<double, 4>& to, double flux, glm::dvec3 axis, double slope) {
    const double constant = flux / std::sqrt(4.0 * std::numbers::pi);
    to[0] += constant;
    for (int i = 0; i < 3; ++i) to[size_t(i) + 1] += constant * slope * axis[i];
  }

  void receive(size_t channel, size_t voxel, int axis, double side, double flux) {
    glm::dvec3 direction(0.0);
    direction[axis] = side;
    const double coneSlope = linear_ / constant_;
    std::array<double, 4>& field = state_.field[channel][voxel];
    if (state_.solid[voxel] == 0) return add(field, flux, direction, coneSlope);
    add(state_.gathered[channel][voxel], flux, direction, coneSlope);
    const double opacity = state_.normal[voxel].w;
    add(field, (1.0 - opacity) * flux, direction, coneSlope);
    if (!(opacity > 0.0)) return;
    const double kept =
        flux * (settings_.albedo == GridAlbedo::Half ? 0.5 : state_.albedo[voxel][int(channel)]);
    const glm::dvec3 mean(state_.normal[voxel]);
    if (settings_.reflection == GridReflection::Axis || !(glm::dot(mean, mean) > 0.01))
      return add(field, kept, -direction, coneSlope);
    const glm::dvec3 n = glm::normalize(mean);
    if (settings_.reflection == GridReflection::Normal)
      return add(field, kept, glm::reflect(direction, n), coneSlope);
    // The linear coefficients of a clamped cosine are 2 / sqrt(3) of its constant one.
    add(field, kept, glm::dot(direction, n) > 0.0 ? -n : n, 2.0 / std::sqrt(3.0));
  }

  const LightGridSettings& settings_;
  GridState& state_;
  double constant_ = 0.0, linear_ = 0.0;
};

double fluxOf(const std::array<Lobes, 3>& lobes) {
  double sum = 0.0;
  for (const Lobes& channel : lobes)
    for (const std::array<double, 4>& lobe : channel) sum += lobe[0] / 3.0;
  return std::sqrt(4.0 * std::numbers::pi) * sum;
}

class LightPropagation : public TechniqueTest {
 protected:
  /// Runs `use(grid, state)` with a grid that light has been put into, and what it holds then.
  template <class Use>
  static void withGrid(const scene::Scene& scene, const LightGridSettings& settings, const Use& use) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {8, 8});
    LightGrid grid(frame, settings, {});
    frame.begin();
    grid.start(frame);
    const voxels::Volume& volume = grid.volume();
    GridState state;
    state.size = volume.grid().resolution;
    state.solid = volume.readOccupied();
    state.normal = readAttribute(volume.normal(), state.size.z);
    state.albedo = readAttribute(volume.albedo(), state.size.z);
    state.field = readLobes(grid.field(), state.size);
    state.gathered = readLobes(grid.gathered(), state.size);
    use(grid, state);
    frame.end();
  }

  static LightGridSettings settings(FluxShares shares, SolidExchange exchange, GridReflection reflection,
                                    LightCone cone = LightCone::Sixth) {
    LightGridSettings out;
    out.resolution = 14;
    out.shares = shares, out.exchange = exchange, out.reflection = reflection, out.cone = cone;
    out.format = FieldFormat::Single;
    return out;
  }
};

TEST_F(LightPropagation, EachStepIsThatOfItsRuleInDoublePrecision) {
  constexpr auto kPrinted = FluxShares::Printed, kConserving = FluxShares::Conserving;
  constexpr auto kAll = SolidExchange::All, kOpen = SolidExchange::Open;
  const LightGridSettings cases[] = {settings(kConserving, kOpen, GridReflection::Diffuse),
                                     settings(kConserving, kOpen, GridReflection::Normal),
                                     settings(kConserving, kAll, GridReflection::Axis),
                                     settings(kPrinted, kOpen, GridReflection::Axis),
                                     settings(kPrinted, kAll, GridReflection::Axis, LightCone::Right)};
  constexpr int kSteps = 40;
  for (const scene::Scene& scene : {makeScene("global_illumination/divided_room", {{"transmittance", 0.5}}),
                                    makeScene("global_illumination/room")})
    for (const LightGridSettings& each : cases)
      withGrid(scene, each, [&](LightGrid& grid, GridState& state) {
        GridSender sender(each, state);
        for (int step = 0; step < kSteps; ++step) grid.propagate(), sender.step();
        for (const bool gathered : {false, true}) {
          const std::array<Lobes, 3> found = readLobes(gathered ? grid.gathered() : grid.field(), state.size);
          const std::array<Lobes, 3>& exact = gathered ? state.gathered : state.field;
          double largest = 0.0, worst = 0.0;
          for (size_t c = 0; c < 3; ++c)
            for (size_t i = 0; i < exact[c].size(); ++i)
              for (size_t k = 0; k < 4; ++k) {
                largest = std::max(largest, std::abs(exact[c][i][k]));
                worst = std::max(worst, std::abs(found[c][i][k] - exact[c][i][k]));
              }
          EXPECT_GT(largest, 0.0);
          // Some 32 roundings of 2^-24 a step, of light no brighter than the brightest.
          EXPECT_LT(worst, kSteps * 32.0 * 0x1p-24 * largest) << scene.parts.size() << " parts";
        }
      });
}

// In a closed box nothing is lost but what surfaces absorb: of what was put in, all arrives once, a share
// albedo again, and so on. 1 / (1 - 1/2) = 2 in all.
TEST_F(LightPropagation, AClosedBoxGathersTheGeometricSum) {
  const scene::Scene box = makeScene("global_illumination/closed_box", {{"albedo", 0.5}});
  for (const GridReflection reflection :
       {GridReflection::Axis, GridReflection::Normal, GridReflection::Diffuse})
    withGrid(box, settings(FluxShares::Conserving, SolidExchange::Open, reflection),
             [&](LightGrid& grid, const GridState& state) {
               const double before = fluxOf(state.field);
               for (int step = 0; step < 600; ++step) grid.propagate();
               EXPECT_LT(fluxOf(readLobes(grid.field(), state.size)), 1e-3 * before);
               // What is left on its way, and the albedo's rounding to half floats: none.
               EXPECT_NEAR(fluxOf(readLobes(grid.gathered(), state.size)), 2.0 * before, 4e-3 * before);
             });
}

// Behind a closed wall, two voxels and more from its middle, no light arrives in 128 steps. The lamp and a
// panel are in front of it, and two layers of voxels hold the wall.
TEST_F(LightPropagation, AClosedWallKeepsAllLight) {
  for (const double thickness : {0.0, 0.1})
    for (const GridReflection reflection : {GridReflection::Diffuse, GridReflection::Normal}) {
      const scene::Scene rooms = makeScene("global_illumination/two_rooms",
                                           {{"opening", 0.0}, {"thickness", thickness}, {"emitter", 5.0}});
      LightGridSettings each = settings(FluxShares::Conserving, SolidExchange::Open, reflection);
      each.resolution = 24;
      withGrid(rooms, each, [&](LightGrid& grid, const GridState& state) {
        for (int step = 0; step < 128; ++step) grid.propagate();
        const std::array<Lobes, 3> found = readLobes(grid.gathered(), state.size);
        const voxels::VoxelGrid& voxels = grid.volume().grid();
        double behind = 0.0, all = 0.0;
        for (size_t i = 0; i < found[0].size(); ++i) {
          const auto z = static_cast<int>(i / (size_t(state.size.x) * size_t(state.size.y)));
          all += found[1][i][0];
          if (voxels.centre({0, 0, z}).z > 2.0 * voxels.voxelSize) behind += std::abs(found[1][i][0]);
        }
        EXPECT_GT(all, 0.0);
        EXPECT_EQ(behind / all, 0.0) << thickness;
      });
    }
}

}  // namespace
}  // namespace limen::techniques
