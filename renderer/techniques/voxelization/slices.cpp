// SPDX-License-Identifier: BSD-3-Clause
// The two single-pass voxelizers by a geometry shader (VX-05 to VX-07): triangles cut into slices, or sent
// whole to each slice and clipped there. Source: Gaitatzes 2012, sections 6.2.1 and 6.2.2. Departures: slices
// hold their near plane, so that a surface between two of them is in one; occupancy alone is kept; triangles
// beyond the grid's first and last slice are cut off there.
#include "renderer/techniques/voxelization/axis_volumes.h"
#include "renderer/techniques/voxelization/voxel_technique.h"

namespace limen::techniques {
namespace {

struct Slicing {
  static constexpr const char* kName = "voxelization/slicing";
  static constexpr const char* kSummary =
      "Triangles cut into the slices of a grid by a geometry shader, along one of three axes each";
  static constexpr const char* kSource = "Gaitatzes 2012, section 6.2.1 (VX-05)";
  static constexpr int kVertices = 15;
  static std::vector<std::string> stages() {
    return {"renderer/techniques/voxelization/slicing.geom.glsl",
            "renderer/techniques/voxelization/slice.frag.glsl"};
  }
};

struct PixelClip {
  static constexpr const char* kName = "voxelization/pixel_clip";
  static constexpr const char* kSummary =
      "Triangles sent whole to each slice of a grid that they reach, and clipped pixel by pixel";
  static constexpr const char* kSource = "Gaitatzes 2012, section 6.2.2 (VX-06)";
  static constexpr int kVertices = 9;
  static std::vector<std::string> stages() {
    return {"renderer/techniques/voxelization/pixel_clip.geom.glsl",
            "renderer/techniques/voxelization/pixel_clip.frag.glsl"};
  }
};

template <class Form>
struct SliceSettings {
  VoxelGridSettings grid;
  int vertices = Form::kVertices;
  static const SettingsTable<SliceSettings>& table() {
    using S = SliceSettings;
    static const SettingsTable<S> kTable = {
        included(&S::grid),
        {&S::vertices,
         "vertices",
         {3, 128},
         "",
         "Cap on the vertices that the geometry shader emits for a triangle; slices "
         "beyond it are lost",
         "Gaitatzes 2012, Table 3"}};
    return kTable;
  }
};

template <class Form>
class SliceVoxelizer : public VoxelTechnique {
 public:
  using Settings = SliceSettings<Form>;
  explicit SliceVoxelizer(const Settings& settings)
      : VoxelTechnique(settings.grid, Form::kName), settings_(settings) {}

 protected:
  int64_t prepareForm(frame::Frame& frame, const voxels::Volume& volume) override {
    volumes_.emplace(frame, volume, Form::stages(),
                     gl::ShaderDefines{{"CAP", std::to_string(settings_.vertices)}});
    return volumes_->bytes();
  }
  void fill(frame::Frame& frame, const voxels::Volume& volume) override { volumes_->fill(frame, volume); }

 private:
  Settings settings_;
  std::optional<AxisVolumes> volumes_;
};

template <class Form>
TechniqueInfo sliceInfo() {
  return {.name = Form::kName,
          .version = 1,
          .summary = Form::kSummary,
          .source = Form::kSource,
          .product = ProductKind::Colour,
          .followsMotion = true,
          .counters = VoxelTechnique::quantities()};
}

const RegisteredTechnique<SliceVoxelizer<Slicing>> kSlicing(sliceInfo<Slicing>());
const RegisteredTechnique<SliceVoxelizer<PixelClip>> kPixelClip(sliceInfo<PixelClip>());

}  // namespace
}  // namespace limen::techniques
