// SPDX-License-Identifier: BSD-3-Clause
// Voxelizers by the rasteriser that work slice by slice (VX-05 to VX-08, VX-10, BL-05): triangles cut into
// slices, or sent whole to each slice and clipped there, by a geometry shader; or all drawn again for each
// slice. Sources: Gaitatzes 2012, sections 6.2.1 and 6.2.2; Fang and Chen 2000, without the parity of layers,
// as Gaitatzes 2012, sections 5.3 and 6.3, has it. Departures: slices hold their near plane, so that a
// surface between two of them is in one; triangles beyond the grid's first and last slice are cut off there;
// attachments may be blended each in its own way.
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/base/error.h"
#include "renderer/techniques/voxelization/axis_volumes.h"
#include "renderer/techniques/voxelization/voxel_attribute_settings.h"
#include "renderer/techniques/voxelization/voxel_technique.h"

namespace limen::techniques {
namespace {

const std::string kSliceFolder = "renderer/techniques/voxelization/";

/// Which voxels a triangle fills that is sent to slices.
enum class SliceCoverage {
  Dominant,     ///< whose column's middle it covers
  Conservative  ///< all that it meets
};
constexpr EnumNames<SliceCoverage, 2> enumNames(SliceCoverage) {
  return {{{{SliceCoverage::Dominant, "dominant"}, {SliceCoverage::Conservative, "conservative"}}}};
}

struct Slicing {
  static constexpr const char* kName = "voxelization/slicing";
  static constexpr const char* kSummary =
      "Triangles cut into the slices of a grid by a geometry shader, along one of three axes each";
  static constexpr const char* kSource = "Gaitatzes 2012, section 6.2.1 (VX-05)";
  static constexpr int kVertices = 15;
  static constexpr bool kPassPerSlice = false, kCutsSlices = true;
  static std::vector<std::string> stages() {
    return {kSliceFolder + "slice.vert.glsl", kSliceFolder + "slicing.geom.glsl",
            kSliceFolder + "slice.frag.glsl"};
  }
};

struct PixelClip {
  static constexpr const char* kName = "voxelization/pixel_clip";
  static constexpr const char* kSummary =
      "Triangles sent whole to each slice of a grid that they reach, and clipped pixel by pixel";
  static constexpr const char* kSource = "Gaitatzes 2012, section 6.2.2 (VX-06)";
  static constexpr int kVertices = 9;
  static constexpr bool kPassPerSlice = false, kCutsSlices = false;
  static std::vector<std::string> stages() {
    return {kSliceFolder + "slice.vert.glsl", kSliceFolder + "pixel_clip.geom.glsl",
            kSliceFolder + "pixel_clip.frag.glsl"};
  }
};

struct SlicePasses {
  static constexpr const char* kName = "voxelization/slice_passes";
  static constexpr const char* kSummary =
      "All triangles drawn for each slice along each of three axes, clipped to it";
  static constexpr const char* kSource = "Fang and Chen 2000; Gaitatzes 2012, section 5.3 (BL-05)";
  static constexpr int kVertices = 0;
  static constexpr bool kPassPerSlice = true, kCutsSlices = false;
  static std::vector<std::string> stages() {
    return {kSliceFolder + "slice_pass.vert.glsl", kSliceFolder + "slice_pass.frag.glsl"};
  }
};

/// Attributes of rasterised forms, with what becomes of fragments that meet.
struct BlendedSurface {
  static constexpr const char *kKind = SurfaceVoxelAttributes::kKind,
                              *kSummary = SurfaceVoxelAttributes::kSummary;
  SurfaceVoxelAttributes surface;
  FragmentBlend blend = FragmentBlend::Separate;
  static const SettingsTable<BlendedSurface>& table() {
    using S = BlendedSurface;
    static const SettingsTable<S> kTable = {
        included(&S::surface),
        {&S::blend, "blend", "What becomes of fragments that meet in a voxel",
         "Gaitatzes 2012, section 6.4"}};
    return kTable;
  }
};
struct BlendedLight {
  static constexpr const char *kKind = LitVoxelAttributes::kKind, *kSummary = LitVoxelAttributes::kSummary;
  LitVoxelAttributes lit;
  FragmentBlend blend = FragmentBlend::Separate;
  static const SettingsTable<BlendedLight>& table() {
    using S = BlendedLight;
    static const SettingsTable<S> kTable = {
        included(&S::lit),
        {&S::blend, "blend", "What becomes of fragments that meet in a voxel",
         "Gaitatzes 2012, section 6.4"}};
    return kTable;
  }
};
using BlendedSetting = std::variant<NoVoxelAttributes, BlendedSurface, BlendedLight>;

voxels::VolumeAttributes blendedAttributes(const BlendedSetting& setting) {
  voxels::VolumeAttributes out;
  if (const auto* surface = std::get_if<BlendedSurface>(&setting))
    out = volumeAttributes(VoxelAttributeSetting(surface->surface));
  if (const auto* light = std::get_if<BlendedLight>(&setting))
    out = volumeAttributes(VoxelAttributeSetting(light->lit));
  out.summed = false;
  return out;
}

template <class Form>
struct SliceSettings {
  VoxelGridSettings grid;
  int vertices = Form::kVertices;
  SliceCoverage coverage = SliceCoverage::Dominant;
  BlendedSetting attributes;
  AxisRefresh refresh = AxisRefresh::All;
  /// Of the 1,024 components that a geometry shader may emit a vertex with attributes takes 12.
  void check() const {
    if (vertices > 84 && !std::holds_alternative<NoVoxelAttributes>(attributes))
      throw Error("a geometry shader emits at most 84 vertices with attributes", "vertices",
                  "choose 84 or fewer, or attributes: none");
  }
  static const SettingsTable<SliceSettings>& table() {
    using S = SliceSettings;
    static const Binding<S> kAttributes(&S::attributes, "attributes",
                                        "What each voxel holds besides whether it is occupied");
    static const Binding<S> kRefresh(
        &S::refresh, "refresh",
        "Axes that a frame draws anew: all, or one after another, so that what moves is up "
        "to two frames late",
        "Gaitatzes 2012, sections 5.6 and 6.4");
    if constexpr (Form::kVertices == 0) {
      static const SettingsTable<S> kTable = {included(&S::grid), kAttributes, kRefresh};
      return kTable;
    } else {
      static const SettingsTable<S> kTable = {
          included(&S::grid),
          {&S::vertices,
           "vertices",
           {3, 128},
           "",
           "Cap on the vertices that the geometry shader emits for a triangle; slices beyond it are lost",
           "Gaitatzes 2012, Table 3"},
          {&S::coverage, "coverage",
           "Which voxels a triangle fills: by conservative coverage a slice takes up to 7 vertices, 9 of a "
           "triangle "
           "that is cut",
           "Gaitatzes 2012, section 6.4"},
          kAttributes,
          kRefresh};
      return kTable;
    }
  }
};

template <class Form>
class SliceVoxelizer : public VoxelTechnique {
 public:
  using Settings = SliceSettings<Form>;
  explicit SliceVoxelizer(const Settings& settings)
      : VoxelTechnique(settings.grid, Form::kName), settings_(settings) {}

 protected:
  voxels::VolumeAttributes attributes(frame::Frame&, const voxels::VoxelGrid&) const override {
    return blendedAttributes(settings_.attributes);
  }
  int64_t prepareForm(frame::Frame& frame, const voxels::Volume& volume) override {
    AxisVolumes::Form form{.stages = Form::stages(),
                           .defines = {{"CAP", std::to_string(settings_.vertices)}},
                           .passPerSlice = Form::kPassPerSlice,
                           .blend = FragmentBlend::Separate,
                           .refresh = settings_.refresh,
                           .lamps = {}};
    if (settings_.coverage == SliceCoverage::Conservative) {
      form.stages = {kSliceFolder + "slice.vert.glsl", kSliceFolder + "conservative.geom.glsl",
                     kSliceFolder + "conservative.frag.glsl"};
      form.defines["CONSERVATIVE"] = "1";
      if (Form::kCutsSlices) form.defines["CUT"] = "1";
    }
    if (const auto* surface = std::get_if<BlendedSurface>(&settings_.attributes)) form.blend = surface->blend;
    if (const auto* light = std::get_if<BlendedLight>(&settings_.attributes)) {
      form.blend = light->blend;
      form.lamps = light->lit.lamps();
    }
    if (voxels::castsShadows(frame, volume.attributes(), form.lamps)) frame.gpuScene().rays(frame.context());
    volumes_.emplace(frame, volume, std::move(form));
    return volumes_->bytes();
  }
  void fill(frame::Frame& frame, const voxels::Volume& volume) override { volumes_->fill(frame, volume); }
  std::vector<Counter> countForm(const voxels::Volume&) const override {
    return {{"draws", double(volumes_->draws())},
            {"lag_frames", settings_.refresh == AxisRefresh::One ? 2.0 : 0.0}};
  }

 private:
  Settings settings_;
  std::optional<AxisVolumes> volumes_;
};

template <class Form>
TechniqueInfo sliceInfo() {
  TechniqueInfo info{.name = Form::kName,
                     .version = 4,
                     .summary = Form::kSummary,
                     .source = Form::kSource,
                     .product = ProductKind::Colour,
                     .followsMotion = true,
                     .counters = VoxelTechnique::quantities()};
  info.counters.push_back(
      {"draws", "Times that the scene is drawn in a frame", "", Direction::LowerIsBetter});
  info.counters.push_back({"lag_frames", "Age of the oldest axis that a frame shows", "frames",
                           Direction::LowerIsBetter, "Gaitatzes 2012, section 5.6"});
  return info;
}

const RegisteredTechnique<SliceVoxelizer<Slicing>> kSlicing(sliceInfo<Slicing>());
const RegisteredTechnique<SliceVoxelizer<PixelClip>> kPixelClip(sliceInfo<PixelClip>());
const RegisteredTechnique<SliceVoxelizer<SlicePasses>> kSlicePasses(sliceInfo<SlicePasses>());

}  // namespace
}  // namespace limen::techniques
