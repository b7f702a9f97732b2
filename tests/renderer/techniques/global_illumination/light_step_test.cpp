// SPDX-License-Identifier: BSD-3-Clause
// Steps of light in voxels beside a second implementation on the CPU in double precision: lobes are
// integrated over directions for each voxel and step, without a table, and what a neighbour is follows from
// the sets of voxels alone.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/techniques/global_illumination/voxel_propagation/light_grid.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

struct VoxelLight {
  double flux = 0.0;
  glm::dvec3 vector{0.0};
};

constexpr std::array<glm::ivec3, 6> kSteps = {glm::ivec3(1, 0, 0), glm::ivec3(-1, 0, 0),
                                              glm::ivec3(0, 1, 0), glm::ivec3(0, -1, 0),
                                              glm::ivec3(0, 0, 1), glm::ivec3(0, 0, -1)};

/// What leaves a voxel through each face: directions of a lobe that is linear in the cosine to its mean
/// direction and nowhere negative go through a face by the share of their component along it.
std::array<VoxelLight, 6> leavingVoxel(const VoxelLight& light) {
  std::array<VoxelLight, 6> out;
  const double reach = glm::length(light.vector);
  if (!(light.flux > 0.0)) return out;
  const double mean = std::min(reach / light.flux, 0.9999);
  const glm::dvec3 axis = reach > 0.0 ? light.vector / reach : glm::dvec3(1, 0, 0);
  const glm::dvec3 other = std::abs(axis.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(u, axis);
  // (1 + 3 mean mu) / 2 has that mean; from 1/3 on, mu - t above t = 3 mean - 2.
  const double t = mean > 1.0 / 3.0 ? 3.0 * mean - 2.0 : -1.0;
  constexpr int kCosines = 48, kAngles = 64;
  double all = 0.0;
  for (int i = 0; i < kCosines; ++i) {
    const double mu = t + (i + 0.5) * (1.0 - t) / kCosines;
    const double density = mean > 1.0 / 3.0 ? mu - t : 1.0 + 3.0 * mean * mu;
    for (int j = 0; j < kAngles; ++j) {
      const double angle = 2.0 * std::numbers::pi * (j + 0.37) / kAngles, radius = std::sqrt(1.0 - mu * mu);
      const glm::dvec3 w = mu * axis + radius * (std::cos(angle) * u + std::sin(angle) * v);
      const double sum = std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
      all += density;
      for (int a = 0; a < 3; ++a) {
        VoxelLight& face = out[size_t(2 * a + (w[a] < 0.0 ? 1 : 0))];
        const double share = density * std::abs(w[a]) / sum;
        face.flux += share, face.vector += share * w;
      }
    }
  }
  for (VoxelLight& face : out) face.flux *= light.flux / all, face.vector *= light.flux / all;
  return out;
}

class LightStep : public TechniqueTest {
 protected:
  /// Of a grid's green light after `steps` steps of a lasting source: root mean square difference between it
  /// and the reference, over the reference's own.
  static double difference(const scene::Scene& scene, FieldFormat format, int resolution, int margin,
                           int steps) {
    LightGridSettings settings;
    settings.resolution = resolution, settings.iterations = steps, settings.format = format;
    settings.box = BoxOfScene{margin};
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {8, 8});
    LightGrid grid(frame, settings, {});
    frame.begin();
    grid.start(frame);
    const voxels::VoxelGrid& voxels = grid.volume().grid();
    const glm::ivec3 size = voxels.resolution;
    const auto at = [&](glm::ivec3 p) { return size_t(voxels.indexOf(p)); };
    const auto green = [&] {
      std::vector<VoxelLight> out(size_t(voxels.count()));
      for (int z = 0; z < size.z; ++z) {
        const Image layer = grid.fieldLayer(1, z);
        for (int y = 0; y < size.y; ++y)
          for (int x = 0; x < size.x; ++x) {
            const float* texel = &layer.data[4 * (size_t(y) * size_t(size.x) + size_t(x))];
            out[at({x, y, z})] = {texel[0], {texel[1], texel[2], texel[3]}};
          }
      }
      return out;
    };
    const std::vector<VoxelLight> source = green();
    const std::vector<uint8_t> occupied = grid.volume().readOccupied();
    std::vector<glm::dvec4> normal(source.size());
    std::vector<double> albedo(source.size());
    for (int z = 0; z < size.z; ++z) {
      const Image normals = grid.volume().normal().readLayer(z),
                  albedos = grid.volume().albedo().readLayer(z);
      for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
          const size_t texel = 4 * (size_t(y) * size_t(size.x) + size_t(x));
          for (int c = 0; c < 4; ++c) normal[at({x, y, z})][c] = normals.data[texel + size_t(c)];
          albedo[at({x, y, z})] = albedos.data[texel + 1];
        }
    }
    const scene::Bounds bounds = scene.bounds();
    const auto inGrid = [&](glm::ivec3 p) {
      return glm::all(glm::greaterThanEqual(p, glm::ivec3(0))) && glm::all(glm::lessThan(p, size));
    };
    const auto isWithin = [&](glm::ivec3 p, double beyond) {
      const glm::dvec3 middle = voxels.origin + (glm::dvec3(p) + 0.5) * voxels.voxelSize;
      return glm::all(glm::greaterThanEqual(middle, bounds.low - beyond)) &&
             glm::all(glm::lessThanEqual(middle, bounds.high + beyond));
    };
    const auto open = [&](glm::ivec3 p) {
      return inGrid(p) && !occupied[at(p)] && isWithin(p, margin * voxels.voxelSize);
    };
    // Opaque surfaces: light goes from open voxels to open ones, but not back into the scene's box, or comes
    // back from a surface.
    std::vector<VoxelLight> field = source;
    for (int step = 0; step < steps; ++step) {
      std::vector<VoxelLight> next = source;
      for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
          for (int x = 0; x < size.x; ++x) {
            const glm::ivec3 p(x, y, z);
            if (!open(p)) continue;
            const std::array<VoxelLight, 6> out = leavingVoxel(field[at(p)]);
            for (size_t face = 0; face < 6; ++face) {
              const glm::ivec3 to = p + kSteps[face];
              if (open(to) && isWithin(to, 0.0) && !isWithin(p, 0.0)) continue;
              if (open(to)) {
                next[at(to)].flux += out[face].flux, next[at(to)].vector += out[face].vector;
              } else if (inGrid(to) && occupied[at(to)]) {
                const glm::dvec3 n(normal[at(to)]), direction(kSteps[face]);
                const double along = glm::dot(n, direction), reach = glm::length(n);
                const glm::dvec3 front = reach > 0.3 && std::abs(along) > 0.2 * reach
                                             ? (along > 0.0 ? -n : n) / reach
                                             : -direction;
                const double back = albedo[at(to)] * out[face].flux;
                next[at(p)].flux += back, next[at(p)].vector += 2.0 / 3.0 * back * front;
              }
            }
          }
      field = next;
    }
    grid.update(frame);
    const std::vector<VoxelLight> found = green();
    frame.end();
    double apart = 0.0, own = 0.0;
    for (size_t i = 0; i < field.size(); ++i) {
      const glm::dvec3 away = found[i].vector - field[i].vector;
      apart += std::pow(found[i].flux - field[i].flux, 2.0) + glm::dot(away, away);
      own += std::pow(field[i].flux, 2.0) + glm::dot(field[i].vector, field[i].vector);
    }
    EXPECT_GT(own, 0.0);
    return std::sqrt(apart / own);
  }
};

/// The table of shares has 16 x 16 directions and 16 focuses with linear interpolation between: its middles
/// are off by an eighth of a second difference, about 1/8 * (1/15)^2 * 10 = .005 of what leaves a face, of
/// either sign. Half floats add a rounding of 2^-12 a step, a twentieth of that.
TEST_F(LightStep, IsThatOfDirectionsInDoublePrecision) {
  const scene::Scene rooms[] = {makeScene("global_illumination/room"),
                                makeScene("global_illumination/stand_in", {{"turn_deg", 30.0}})};
  for (const scene::Scene& scene : rooms) {
    for (const int margin : {0, 1, 3})
      for (const int steps : {1, 12}) {
        const double single = difference(scene, FieldFormat::Single, 10, margin, steps),
                     half = difference(scene, FieldFormat::Half, 10, margin, steps);
        EXPECT_LT(single, 0.005) << margin;
        EXPECT_LT(half, 0.005 + steps / 4096.0) << margin;
      }
  }
}

}  // namespace
}  // namespace limen::techniques
