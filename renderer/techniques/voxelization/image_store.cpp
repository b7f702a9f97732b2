// SPDX-License-Identifier: BSD-3-Clause
// All triangles into one volume by compute (VX-01, VX-03, VX-04, VX-09, VX-12, VX-13). Source: Gaitatzes
// 2012, chapter 6; the single pass without geometry shader, temporary volumes and merge is the bench's own,
// as are means of attributes in fixed point in place of blending.
#include <optional>

#include "renderer/ray_tracing/rebuilt_tree.h"
#include "renderer/techniques/voxelization/voxel_attribute_settings.h"
#include "renderer/techniques/voxelization/voxel_technique.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::techniques {
namespace {

constexpr const char* kImageStorePass = "voxelization/image_store";

struct ImageStoreSettings {
  VoxelGridSettings grid;
  voxels::Coverage coverage = voxels::Coverage::Thin;
  VoxelAttributeSetting attributes;
  static const SettingsTable<ImageStoreSettings>& table() {
    using S = ImageStoreSettings;
    static const SettingsTable<S> kTable = {included(&S::grid),
                                            {&S::coverage, "coverage", "Which voxels a triangle fills"},
                                            voxelAttributesBinding(&S::attributes)};
    return kTable;
  }
};

class ImageStore : public VoxelTechnique {
 public:
  using Settings = ImageStoreSettings;
  explicit ImageStore(const ImageStoreSettings& settings)
      : VoxelTechnique(settings.grid, kImageStorePass), settings_(settings) {}

 protected:
  voxels::VolumeAttributes attributes() const override { return volumeAttributes(settings_.attributes); }
  int64_t prepareForm(frame::Frame& frame, const voxels::Volume& volume) override {
    voxels::VoxelLamps lamps;
    if (const auto* lit = std::get_if<LitVoxelAttributes>(&settings_.attributes)) lamps = lit->lamps();
    voxelizer_.emplace(frame, settings_.coverage, volume, lamps);
    // The scene's own tree is of its triangles at rest.
    const bool traced = volume.attributes().lit() && lamps.shadows && !frame.scene().lights.empty();
    if (traced && !frame.scene().motions.empty())
      tree_.emplace(frame.context(), frame.gpuScene().triangleCount());
    else if (traced)
      frame.gpuScene().rays(frame.context());
    return voxelizer_->bytes() + (tree_ ? tree_->bytes() : 0);
  }
  void beforeFill(frame::Frame& frame) override {
    if (tree_) tree_->build(frame.passes(), frame.positions(), frame.gpuScene().indices());
  }
  void fill(frame::Frame& frame, const voxels::Volume& volume) override {
    voxelizer_->run(frame, volume, tree_ ? &*tree_ : nullptr);
  }
  std::vector<Counter> countForm() const override {
    return {{"rays_cut_short", double(voxelizer_->cutShort())}};
  }

 private:
  ImageStoreSettings settings_;
  std::optional<voxels::Voxelizer> voxelizer_;
  std::optional<ray_tracing::RebuiltTree> tree_;
};

std::vector<Quantity> imageStoreQuantities() {
  std::vector<Quantity> out = VoxelTechnique::quantities();
  out.push_back({"rays_cut_short", "Invocations whose rays a software renderer cut short", "",
                 Direction::LowerIsBetter});
  return out;
}

const RegisteredTechnique<ImageStore> kImageStore{
    {.name = "voxelization/image_store",
     .version = 2,
     .summary = "Triangles into voxels by compute: no geometry shader, no cap, nothing to merge",
     .source = "Gaitatzes 2012, chapter 6 (VX-12, VX-13)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = imageStoreQuantities()}};

}  // namespace
}  // namespace limen::techniques
