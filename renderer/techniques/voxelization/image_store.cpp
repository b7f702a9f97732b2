// SPDX-License-Identifier: BSD-3-Clause
// All triangles into one volume in one dispatch (VX-04, VX-12 to VX-14). Source: Gaitatzes 2012, chapter 6;
// the single pass without geometry shader, temporary volumes and merge is the bench's own.
#include "renderer/techniques/voxelization/voxel_technique.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::techniques {
namespace {

/// Floats of a voxel's attributes.
enum class VoxelFormat { Half, Full };
constexpr EnumNames<VoxelFormat, 2> enumNames(VoxelFormat) {
  return {{{{VoxelFormat::Half, "16f"}, {VoxelFormat::Full, "32f"}}}};
}

struct ImageStoreSettings {
  VoxelGridSettings grid;
  voxels::Coverage coverage = voxels::Coverage::Thin;
  bool attributes = false;
  VoxelFormat format = VoxelFormat::Half;
  static const SettingsTable<ImageStoreSettings>& table() {
    using S = ImageStoreSettings;
    static const SettingsTable<S> kTable = {
        included(&S::grid),
        {&S::coverage, "coverage", "Which voxels a triangle fills"},
        {&S::attributes, "attributes", "Albedo, normal and opacity of each voxel besides occupancy"},
        {&S::format, "format", "Floats of the attributes", "Gaitatzes 2012, Table 7"}};
    return kTable;
  }
};

class ImageStore : public VoxelTechnique {
 public:
  using Settings = ImageStoreSettings;
  explicit ImageStore(const ImageStoreSettings& settings)
      : VoxelTechnique(settings.grid, "voxelization/image_store"), settings_(settings) {}

 protected:
  voxels::VolumeAttributes attributes() const override {
    return {.albedo = settings_.attributes,
            .normal = settings_.attributes,
            .format = settings_.format == VoxelFormat::Full ? gl::Format::RGBA32F : gl::Format::RGBA16F};
  }
  int64_t prepareForm(frame::Frame& frame, const voxels::Volume& volume) override {
    voxelizer_.emplace(frame.context(), settings_.coverage, volume);
    return 0;
  }
  void fill(frame::Frame& frame, const voxels::Volume& volume) override { voxelizer_->run(frame, volume); }

 private:
  ImageStoreSettings settings_;
  std::optional<voxels::Voxelizer> voxelizer_;
};

const RegisteredTechnique<ImageStore> kImageStore{
    {.name = "voxelization/image_store",
     .version = 1,
     .summary = "Triangles into voxels by one compute pass: no geometry shader, no cap, nothing to merge",
     .source = "Gaitatzes 2012, chapter 6 (VX-12, VX-13)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = VoxelTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
