// SPDX-License-Identifier: BSD-3-Clause
// Triangles binned to bricks of voxels that are filled in shared memory (BL-09): a voxelizer in the role that
// VoxelPipe (Pantaleoni 2011) has in Gaitatzes 2012, Table 8. Departures from VoxelPipe: one level of bins,
// filled by a counting sort; occupancy alone, without holes (the three rasterisations of Coverage::Thin).
#include <epoxy/gl.h>

#include <algorithm>
#include <optional>

#include "renderer/compute/prefix_sum.h"
#include "renderer/techniques/voxelization/voxel_technique.h"
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/voxel_bindings.h"

namespace limen::techniques {
namespace {

constexpr GLuint kMostBrickGroupsInRow = 65535;

struct BinnedSettings {
  VoxelGridSettings grid;
  double spare = 1.5;
  static const SettingsTable<BinnedSettings>& table() {
    using S = BinnedSettings;
    static const SettingsTable<S> kTable = {
        included(&S::grid),
        {&S::spare,
         "spare",
         {1.0, 16.0},
         "",
         "Room for pairs of triangles and bricks, of what the first frame needs: what moves may need more"}};
    return kTable;
  }
};

class Binned : public VoxelTechnique {
 public:
  using Settings = BinnedSettings;
  explicit Binned(const BinnedSettings& settings)
      : VoxelTechnique(settings.grid, "voxelization/binned"), settings_(settings) {}

 protected:
  int64_t prepareForm(frame::Frame& frame, const voxels::Volume& volume) override {
    gl::ProgramCache& programs = frame.context().programs();
    count_ = &programs.compute("renderer/techniques/voxelization/brick_bins.comp.glsl");
    scatter_ = &programs.compute("renderer/techniques/voxelization/brick_bins.comp.glsl", {{"SCATTER", "1"}});
    fill_ = &programs.compute("renderer/techniques/voxelization/brick_fill.comp.glsl");
    const glm::ivec3 brick(kBrickX, kBrickY, kBrickZ), all = (volume.grid().resolution + brick - 1) / brick;
    bricks_ = static_cast<uint32_t>(all.x * all.y * all.z);
    const int64_t bytes = compute::PrefixSum::bytesFor(bricks_, 1);
    counts_.emplace(bytes, nullptr);
    counts_->clearUint(0);
    starts_.emplace(bytes, nullptr);
    scan_.emplace(frame.context(), bricks_);
    // How many pairs there are now.
    bin(*count_, frame, volume);
    scan_->run(*counts_, *starts_, bricks_);
    counts_->clearUint(0);
    capacity_ = static_cast<uint32_t>(std::min(settings_.spare * pairs() + 1024.0, 1e9));
    triangles_.emplace(int64_t{capacity_} * 4, nullptr);
    return 2 * bytes + scan_->bytes() + triangles_->bytes();
  }

  void fill(frame::Frame& frame, const voxels::Volume& volume) override {
    bin(*count_, frame, volume);
    scan_->run(*counts_, *starts_, bricks_);
    starts_->bindStorage(kBrickStartsBuffer);
    triangles_->bindStorage(kBrickTrianglesBuffer);
    scatter_->set("listCapacity", capacity_);
    bin(*scatter_, frame, volume);
    volume.bits().bindImage(voxels::kVoxelBitsImage, gl::Access::Write);
    volume.configure(*fill_);
    fill_->set("listCapacity", capacity_);
    fill_->use();
    dispatchGroups(bricks_);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  std::vector<Counter> countForm(const voxels::Volume&) const override {
    return {{"pairs", double(pairs())}, {"pairs_lost", std::max(0.0, double(pairs()) - capacity_)}};
  }

 private:
  static void dispatchGroups(uint32_t groups) {
    const GLuint rows = (groups + kMostBrickGroupsInRow - 1) / kMostBrickGroupsInRow;
    if (groups > 0) glDispatchCompute((groups + rows - 1) / rows, rows, 1);
  }
  void bin(const gl::Program& program, frame::Frame& frame, const voxels::Volume& volume) const {
    const uint32_t triangles = frame.gpuScene().triangleCount();
    frame.gpuScene().bindStorage(&frame.positions());
    counts_->bindStorage(kBrickCountsBuffer);
    volume.configure(program);
    program.set("triangleCount", triangles);
    program.use();
    dispatchGroups((triangles + kBrickGroup - 1) / kBrickGroup);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  uint32_t pairs() const { return starts_->read<uint32_t>(int64_t{bricks_} * 4, 1)[0]; }

  BinnedSettings settings_;
  const gl::Program *count_ = nullptr, *scatter_ = nullptr, *fill_ = nullptr;
  std::optional<compute::PrefixSum> scan_;
  std::optional<gl::Buffer> counts_, starts_, triangles_;
  uint32_t bricks_ = 0, capacity_ = 0;
};

std::vector<Quantity> binnedQuantities() {
  std::vector<Quantity> out = VoxelTechnique::quantities();
  out.push_back({"pairs", "Pairs of a triangle and a brick", "", Direction::LowerIsBetter});
  out.push_back({"pairs_lost", "Pairs for which there was no room", "", Direction::LowerIsBetter});
  return out;
}

const RegisteredTechnique<Binned> kBinned{
    {.name = "voxelization/binned",
     .version = 1,
     .summary = "Triangles binned to bricks of voxels, each filled by a group in shared memory",
     .source = "after Pantaleoni 2011 (VoxelPipe); Gaitatzes 2012, Table 8 (BL-09)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = binnedQuantities()}};

}  // namespace
}  // namespace limen::techniques
