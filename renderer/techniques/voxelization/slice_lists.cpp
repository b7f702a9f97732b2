// SPDX-License-Identifier: BSD-3-Clause
// Slices of triangles as items of a list, an invocation each (VX-14): what the geometry shaders of slices.cpp
// emit, without a cap on vertices, so that slanted floors have no holes; or with one, to show what it loses.
// Source: Gaitatzes 2012, sections 6.2.1 and 6.2.2; the list is the bench's own.
#include <epoxy/gl.h>

#include <optional>

#include "renderer/compute/prefix_sum.h"
#include "renderer/techniques/voxelization/voxel_technique.h"
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/voxel_bindings.h"

namespace limen::techniques {
namespace {

constexpr int kMostSlices = 512;
constexpr GLuint kSliceGroups = 2112, kSoftwareSliceGroups = 32;

struct SliceListSettings {
  VoxelGridSettings grid;
  int slices = kMostSlices;
  static const SettingsTable<SliceListSettings>& table() {
    using S = SliceListSettings;
    static const SettingsTable<S> kTable = {included(&S::grid),
                                            {&S::slices,
                                             "slices",
                                             {1, kMostSlices},
                                             "",
                                             "Slices of a triangle at most, as a cap on vertices leaves "
                                             "them: a third of the vertices of pixel_clip",
                                             "Gaitatzes 2012, Fig. 66"}};
    return kTable;
  }
};

class SliceLists : public VoxelTechnique {
 public:
  using Settings = SliceListSettings;
  explicit SliceLists(const SliceListSettings& settings)
      : VoxelTechnique(settings.grid, "voxelization/slice_lists"), settings_(settings) {}

 protected:
  int64_t prepareForm(frame::Frame& frame, const voxels::Volume&) override {
    gl::ProgramCache& programs = frame.context().programs();
    count_ = &programs.compute("renderer/techniques/voxelization/slice_count.comp.glsl");
    fill_ = &programs.compute("renderer/techniques/voxelization/slice_fill.comp.glsl");
    const uint32_t triangles = frame.gpuScene().triangleCount();
    scan_.emplace(frame.context(), triangles);
    counts_.emplace(compute::PrefixSum::bytesFor(triangles, 1), nullptr);
    sums_.emplace(compute::PrefixSum::bytesFor(triangles, 1), nullptr);
    return counts_->bytes() + sums_->bytes() + scan_->bytes();
  }

  void fill(frame::Frame& frame, const voxels::Volume& volume) override {
    volume.clear();
    const uint32_t triangles = frame.gpuScene().triangleCount();
    if (triangles == 0) return;
    frame.gpuScene().bindStorage(&frame.positions());
    counts_->bindStorage(kSliceCountsBuffer);
    configure(*count_, volume, triangles);
    const GLuint groups = (triangles + kSliceGroup - 1) / kSliceGroup, rows = (groups + 65534) / 65535;
    glDispatchCompute((groups + rows - 1) / rows, rows, 1);
    scan_->run(*counts_, *sums_, triangles);
    frame.gpuScene().bindStorage(&frame.positions());
    sums_->bindStorage(kSliceSumsBuffer);
    volume.bits().bindImage(voxels::kVoxelBitsImage, gl::Access::ReadWrite);
    configure(*fill_, volume, triangles);
    glDispatchCompute(frame.context().device().software ? kSoftwareSliceGroups : kSliceGroups, 1, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  std::vector<Counter> countForm(const voxels::Volume&) const override {
    return {{"slices", double(sums_->read<uint32_t>(4 * triangles_, 1)[0])}};
  }

 private:
  void configure(const gl::Program& program, const voxels::Volume& volume, uint32_t triangles) {
    triangles_ = triangles;
    volume.configure(program);
    program.set("triangleCount", triangles);
    program.set("mostSlices", settings_.slices);
    program.use();
  }

  SliceListSettings settings_;
  const gl::Program *count_ = nullptr, *fill_ = nullptr;
  std::optional<compute::PrefixSum> scan_;
  std::optional<gl::Buffer> counts_, sums_;
  int64_t triangles_ = 0;
};

std::vector<Quantity> sliceListQuantities() {
  std::vector<Quantity> out = VoxelTechnique::quantities();
  out.push_back({"slices", "Slices of all triangles", "", Direction::LowerIsBetter});
  return out;
}

const RegisteredTechnique<SliceLists> kSliceLists{
    {.name = "voxelization/slice_lists",
     .version = 3,
     .summary =
         "Slices of triangles listed and filled by compute: those of the geometry shaders, without their cap",
     .source = "Gaitatzes 2012, section 6.2 (VX-14)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = sliceListQuantities()}};

}  // namespace
}  // namespace limen::techniques
