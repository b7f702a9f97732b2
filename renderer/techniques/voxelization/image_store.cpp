// SPDX-License-Identifier: BSD-3-Clause
// All triangles into one volume by compute (VX-01, VX-03, VX-04, VX-09, VX-11 to VX-13). Source: Gaitatzes
// 2012, chapter 6; the single pass without geometry shader, temporary volumes and merge is the bench's own,
// as are means of attributes in fixed point in place of blending.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "experiments/base/error.h"
#include "renderer/ray_tracing/rebuilt_tree.h"
#include "renderer/techniques/voxelization/voxel_attribute_settings.h"
#include "renderer/techniques/voxelization/voxel_technique.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::techniques {
namespace {

constexpr const char* kImageStorePass = "voxelization/image_store";

/// Which voxels have sums, of which means are made.
struct SumsOfOccupied {
  static constexpr const char *kKind = "occupied",
                              *kSummary = "occupied ones, in a second run over the triangles";
  double spare = 1.5;
  static const SettingsTable<SumsOfOccupied>& table() {
    static const SettingsTable<SumsOfOccupied> kTable = {
        {&SumsOfOccupied::spare,
         "spare",
         {1.0, 16.0},
         "",
         "Room for sums where parts move, of what the first frame needs: later ones may need more"}};
    return kTable;
  }
};
struct SumsThatFit {
  static constexpr const char *kKind = "fitting",
                              *kSummary =
                                  "all of the grid; occupied ones where these exceed a buffer or the budget";
  double spare = 1.5;
  static const SettingsTable<SumsThatFit>& table() {
    static const SettingsTable<SumsThatFit> kTable = {
        {&SumsThatFit::spare, "spare", {1.0, 16.0}, "", "As that of occupied, for occupied ones"}};
    return kTable;
  }
};
struct SumsOfAll {
  static constexpr const char *kKind = "all", *kSummary = "all of the grid, in the run that fills them";
};
using SumsSetting = std::variant<SumsThatFit, SumsOfOccupied, SumsOfAll>;

struct MeanSurface {
  static constexpr const char *kKind = SurfaceVoxelAttributes::kKind,
                              *kSummary = SurfaceVoxelAttributes::kSummary;
  SurfaceVoxelAttributes surface;
  SumsSetting sums;
  static const SettingsTable<MeanSurface>& table() {
    static const SettingsTable<MeanSurface> kTable = {
        included(&MeanSurface::surface),
        {&MeanSurface::sums, "sums", "Voxels that have room for the sums of which means are made"}};
    return kTable;
  }
};
struct MeanLight {
  static constexpr const char *kKind = LitVoxelAttributes::kKind, *kSummary = LitVoxelAttributes::kSummary;
  LitVoxelAttributes lit;
  SumsSetting sums;
  static const SettingsTable<MeanLight>& table() {
    static const SettingsTable<MeanLight> kTable = {
        included(&MeanLight::lit),
        {&MeanLight::sums, "sums", "Voxels that have room for the sums of which means are made"}};
    return kTable;
  }
};
using MeanSetting = std::variant<NoVoxelAttributes, MeanSurface, MeanLight>;

struct ImageStoreSettings {
  VoxelGridSettings grid;
  voxels::Coverage coverage = voxels::Coverage::Thin;
  MeanSetting attributes;
  bool split = false;
  void check() const {
    const auto* light = std::get_if<MeanLight>(&attributes);
    if (split && light && light->lit.shadows)
      throw Error("a part that moves changes the light of those that rest", "split",
                  "choose attributes without light, or shadows: false, or split: false");
  }
  static const SettingsTable<ImageStoreSettings>& table() {
    using S = ImageStoreSettings;
    static const SettingsTable<S> kTable = {
        included(&S::grid),
        {&S::coverage, "coverage", "Which voxels a triangle fills"},
        {&S::attributes, "attributes", "What each voxel holds besides whether it is occupied"},
        {&S::split, "split", "Parts that rest in a volume of their own, filled once",
         "Gaitatzes 2012, section 6.4"}};
    return kTable;
  }
};

class ImageStore : public VoxelTechnique {
 public:
  using Settings = ImageStoreSettings;
  explicit ImageStore(const ImageStoreSettings& settings)
      : VoxelTechnique(settings.grid, kImageStorePass), settings_(settings) {}

 protected:
  voxels::VolumeAttributes attributes(frame::Frame& frame, const voxels::VoxelGrid& grid) const override {
    voxels::VolumeAttributes out;
    const SumsSetting* sums = nullptr;
    if (const auto* surface = std::get_if<MeanSurface>(&settings_.attributes)) {
      out = volumeAttributes(VoxelAttributeSetting(surface->surface));
      sums = &surface->sums;
    }
    if (const auto* light = std::get_if<MeanLight>(&settings_.attributes)) {
      out = volumeAttributes(VoxelAttributeSetting(light->lit));
      sums = &light->sums;
    }
    if (!sums) return out;
    double spare = 1.0;
    if (const auto* occupied = std::get_if<SumsOfOccupied>(sums)) {
      out.sums = voxels::VoxelSums::Occupied;
      spare = occupied->spare;
    }
    if (const auto* fitting = std::get_if<SumsThatFit>(sums)) {
      out.sums = voxels::fitSumsOfAll(grid, out) ? voxels::VoxelSums::All : voxels::VoxelSums::Occupied;
      spare = fitting->spare;
    }
    if (out.sums == voxels::VoxelSums::Occupied) {
      if (frame.scene().motions.empty()) spare = 1.0;
      const int64_t now = voxels::countOccupied(frame, grid, settings_.coverage);
      out.mostOccupied = std::max<int64_t>(1, std::llround(spare * static_cast<double>(now)));
    }
    return out;
  }
  int64_t prepareForm(frame::Frame& frame, const voxels::Volume& volume) override {
    voxels::VoxelLamps lamps;
    if (const auto* light = std::get_if<MeanLight>(&settings_.attributes)) lamps = light->lit.lamps();
    voxelizer_.emplace(frame, settings_.coverage, volume, lamps);
    // The scene's own tree is of its triangles at rest.
    const bool traced = volume.attributes().lit() && lamps.shadows && !frame.scene().lights.empty();
    if (traced && !frame.scene().motions.empty())
      tree_.emplace(frame.context(), frame.gpuScene().triangleCount());
    else if (traced)
      frame.gpuScene().rays(frame.context());
    if (settings_.split) prepareSplit(frame, volume);
    return voxelizer_->bytes() + (tree_ ? tree_->bytes() : 0) + (resting_ ? resting_->bytes() : 0);
  }
  void beforeFill(frame::Frame& frame) override {
    if (tree_) tree_->build(frame.passes(), frame.positions(), frame.gpuScene().indices());
  }
  void fill(frame::Frame& frame, const voxels::Volume& volume) override {
    const ray_tracing::RayTree* tree = tree_ ? &*tree_ : nullptr;
    if (!resting_) {
      voxelizer_->run(frame, volume, {.tree = tree});
      return;
    }
    if (restingFills_ == 0) {
      voxelizer_->gather(frame, *resting_, {.spans = restingSpans_, .tree = tree});
      ++restingFills_;
    }
    voxelizer_->run(frame, volume, {.spans = movingSpans_, .tree = tree, .base = &*resting_});
  }
  std::vector<Counter> countForm(const voxels::Volume& volume) const override {
    return {{"rays_cut_short", double(voxelizer_->cutShort())},
            {"voxels_without_sums", double(volume.withoutSums())},
            {"resting_fills", double(restingFills_)}};
  }

 private:
  void prepareSplit(frame::Frame& frame, const voxels::Volume& volume) {
    const scene::Scene& scene = frame.scene();
    voxels::VolumeAttributes attributes = volume.attributes();
    attributes.joined = attributes.any();
    resting_.emplace(frame.context(), volume.grid(), frame.gpuScene().anchor(), attributes);
    for (uint32_t part = 0; part < scene.parts.size(); ++part) {
      const scene::Part& of = scene.parts[part];
      const bool moves = std::any_of(scene.motions.begin(), scene.motions.end(),
                                     [&](const scene::PartMotion& motion) { return motion.part == part; });
      std::vector<voxels::TriangleSpan>& spans = moves ? movingSpans_ : restingSpans_;
      if (!spans.empty() && spans.back().end == of.firstTriangle)
        spans.back().end += of.triangleCount;
      else
        spans.push_back({of.firstTriangle, of.firstTriangle + of.triangleCount});
    }
  }

  ImageStoreSettings settings_;
  std::optional<voxels::Voxelizer> voxelizer_;
  std::optional<ray_tracing::RebuiltTree> tree_;
  std::optional<voxels::Volume> resting_;
  std::vector<voxels::TriangleSpan> restingSpans_, movingSpans_;
  int restingFills_ = 0;
};

std::vector<Quantity> imageStoreQuantities() {
  std::vector<Quantity> out = VoxelTechnique::quantities();
  out.push_back({"rays_cut_short", "Invocations whose rays a software renderer cut short", "",
                 Direction::LowerIsBetter});
  out.push_back({"voxels_without_sums", "Occupied voxels without attributes, as there was no room for sums",
                 "", Direction::LowerIsBetter});
  out.push_back(
      {"resting_fills", "Times that the volume of what rests has been filled", "", Direction::LowerIsBetter});
  return out;
}

const RegisteredTechnique<ImageStore> kImageStore{
    {.name = "voxelization/image_store",
     .version = 5,
     .summary = "Triangles into voxels by compute: no geometry shader, no cap, nothing to merge",
     .source = "Gaitatzes 2012, chapter 6 (VX-12, VX-13)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = imageStoreQuantities()}};

}  // namespace
}  // namespace limen::techniques
