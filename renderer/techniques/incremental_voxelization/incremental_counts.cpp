// SPDX-License-Identifier: BSD-3-Clause
// What incremental techniques count: voxels of the last step, and the whole set against that of the mesh.
#include <cmath>

#include "renderer/scene/part_motion.h"
#include "renderer/techniques/incremental_voxelization/incremental_technique.h"
#include "renderer/voxels/exact_voxels.h"
#include "renderer/voxels/hausdorff.h"
#include "renderer/voxels/voxel_bindings.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::techniques {
namespace {

/// Samples lie off by the rounding of positions, and are moved by as much again.
const double kSampleSlack = 4.0 * voxels::kVoxelSlack;

scene::Mesh meshAt(const scene::Scene& scene, double timeS) {
  return scene.motions.empty() ? scene.mesh : scene::movedTo(scene, timeS).mesh;
}

/// Triangles of parts that move.
scene::Scene movingParts(const scene::Scene& scene) {
  scene::Scene out = scene;
  std::vector<glm::uvec3> triangles;
  for (const scene::PartMotion& motion : scene.motions) {
    const scene::Part& part = scene.parts[motion.part];
    for (uint32_t i = 0; i < part.triangleCount; ++i)
      triangles.push_back(scene.mesh.triangles[part.firstTriangle + i]);
  }
  out.mesh.triangles = triangles;
  return out;
}

/// Of the box of what of a mesh lies in a grid.
double diagonalWithin(const scene::Mesh& mesh, const voxels::VoxelGrid& grid) {
  scene::Bounds bounds;
  for (const glm::dvec3& position : mesh.positions)
    if (std::isfinite(position.x + position.y + position.z)) bounds.extend(position);
  if (bounds.empty()) return 0.0;
  bounds.low = glm::max(bounds.low, grid.origin), bounds.high = glm::min(bounds.high, grid.high());
  return glm::length(glm::max(bounds.high - bounds.low, glm::dvec3(0.0)));
}

/// A share of the diagonal in percent; as a whole diagonal where there is nothing to measure to.
double percent(double distance, double diagonal) {
  if (!(diagonal > 0.0)) return 0.0;
  return std::isfinite(distance) ? 100.0 * distance / diagonal : 100.0;
}

}  // namespace

std::vector<uint8_t> IncrementalTechnique::oncePresent(const frame::Frame& frame) const {
  std::vector<uint8_t> out(static_cast<size_t>(volume_->grid().count()));
  if (frame.scene().motions.empty()) return out;
  const scene::Scene moving = movingParts(frame.scene());
  for (int before = settings_.sequence.frames; before > 0; --before) {
    // Vertices of parts alone: their motions are those of the scene.
    scene::Mesh mesh = meshAt(frame.scene(), frame.timeS() - before * settings_.sequence.stepS);
    mesh.triangles = moving.mesh.triangles;
    const std::vector<uint8_t> then = voxels::exactVoxels(mesh, volume_->grid(), kSampleSlack);
    for (size_t i = 0; i < out.size(); ++i) out[i] |= then[i];
  }
  return out;
}

std::vector<Counter> IncrementalTechnique::count(frame::Frame& frame) {
  const voxels::VoxelGrid& grid = volume_->grid();
  const scene::Mesh mesh = meshAt(frame.scene(), frame.timeS());
  const std::vector<uint8_t> found = volume_->readOccupied();
  const std::vector<uint8_t> exact = voxels::exactVoxels(mesh, grid, kSampleSlack);
  const voxels::Volume full(frame.context(), grid, frame.gpuScene().anchor());
  voxels::Voxelizer(frame, voxels::Coverage::Thin, full).run(frame, full);
  const std::vector<uint8_t> thin = full.readOccupied(), once = oncePresent(frame);
  int64_t stale = 0;
  for (size_t i = 0; i < found.size(); ++i)
    if (found[i] && !exact[i] && once[i]) ++stale;
  const voxels::HausdorffDistances own = voxels::hausdorff(mesh, grid, found),
                                   whole = voxels::hausdorff(mesh, grid, thin);
  const double diagonal = diagonalWithin(mesh, grid);
  std::vector<Counter> out = {
      {"voxels", double(voxels::countOf(found))},
      {"full_voxels", double(voxels::countOf(thin))},
      {"missing_voxels", double(voxels::compare(found, thin).missing)},
      {"extra_voxels", double(voxels::compare(found, exact).extra)},
      {"stale_voxels", double(stale)},
      {"restarts", double(restarts_)},
      {"scrolls", double(scrolls_)},
      {"hausdorff_largest", percent(own.largest(), diagonal)},
      {"hausdorff_mean", percent(own.mean(), diagonal)},
      {"hausdorff_rms", percent(own.rms(), diagonal)},
      {"from_voxels_mean", percent(own.fromVoxels.mean, diagonal)},
      {"from_surface_mean", percent(own.fromSurface.mean, diagonal)},
      {"full_hausdorff_largest", percent(whole.largest(), diagonal)},
      {"full_hausdorff_mean", percent(whole.mean(), diagonal)},
      {"beyond_full_mean", percent(own.mean(), diagonal) - percent(whole.mean(), diagonal)},
      {"volume_mib", double(volume_->bytes()) / 1048576.0}};
  if (!countsSteps()) return out;
  const incremental_voxels::SampleCounts counts = volume_->counts();
  const std::vector<Counter> ofStep = {{"kept_voxels", double(counts.kept)},
                                       {"cleared_voxels", double(counts.cleared)},
                                       {"added_voxels", double(counts.added)},
                                       {"samples", double(counts.samples)},
                                       {"tested_bricks", double(counts.tested)}};
  out.insert(out.end(), ofStep.begin(), ofStep.end());
  if (counts.touched > 0) out.push_back({"samples_per_voxel", double(counts.samples) / counts.touched});
  return out;
}

std::vector<Quantity> IncrementalTechnique::quantities() {
  const std::string table = "Gaitatzes 2012, Table 9";
  const auto lower = Direction::LowerIsBetter, neither = Direction::Neither;
  return {{"voxels", "Occupied voxels", "", neither},
          {"full_voxels", "Voxels of the whole mesh, without holes", "", neither},
          {"missing_voxels", "Voxels of the whole mesh that are empty", "", lower},
          {"extra_voxels", "Occupied voxels that no surface meets", "", lower},
          {"stale_voxels", "Of these, voxels that a surface met in an earlier frame", "", lower},
          {"kept_voxels", "Voxels kept by the last frame's clean-up", "", neither},
          {"cleared_voxels", "Voxels cleared by it", "", neither},
          {"added_voxels", "Empty voxels filled by the last frame's samples", "", neither},
          {"samples", "Samples of the last frame within the grid", "", neither},
          {"samples_per_voxel", "Samples of a voxel that has any", "", lower, "Gaitatzes 2012, section 7.7"},
          {"tested_bricks", "Bricks with occupied voxels that were tested", "", lower},
          {"restarts", "Times that the grid moved and was emptied", "", lower, "Gaitatzes 2012, section 7.9"},
          {"scrolls", "Times that the grid moved and kept what was still in it", "", neither},
          {"hausdorff_largest", "Hausdorff distance", "% of diagonal", lower, table},
          {"hausdorff_mean", "Mean distance, the larger of both directions", "% of diagonal", lower, table},
          {"hausdorff_rms", "RMS distance, the larger of both directions", "% of diagonal", lower, table},
          {"from_voxels_mean", "Mean distance from voxels to the surface", "% of diagonal", lower},
          {"from_surface_mean", "Mean distance from the surface to voxels", "% of diagonal", lower},
          {"full_hausdorff_largest", "Hausdorff distance of the whole mesh's voxels", "% of diagonal",
           neither, table},
          {"full_hausdorff_mean", "Mean distance of the whole mesh's voxels, the larger of both directions",
           "% of diagonal", neither, table},
          {"beyond_full_mean", "Mean distance beyond that of the whole mesh's voxels", "% of diagonal", lower,
           table},
          {"volume_mib", "Memory of the volume", "MiB", lower}};
}

}  // namespace limen::techniques
