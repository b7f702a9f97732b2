// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/soft_shadows/gathering.h"

namespace limen::techniques {

/// Settings of a VisibilityFilter.
struct SurfaceMean {
  static constexpr const char *kKind = "surface_mean",
                              *kSummary = "the mean over neighbours on the same surface";
  int radius = 4;           ///< px on either side
  double step = 0.125;      ///< between neighbours: two rows of 16 by 16 samples
  double planeShare = 0.1;  ///< of the distance of a neighbour's point
  double angle = 15.0;      ///< degrees
  static const SettingsTable<SurfaceMean>& table();
};
struct NoFilter {
  static constexpr const char *kKind = "none", *kSummary = "visibility as it was gathered";
};
using FilterSettings = std::variant<NoFilter, SurfaceMean>;

/// Smooths the steps that few light samples leave in a visibility image: the mean over a row and then a
/// column of neighbours on the same surface. Neighbours are walked to on both sides up to the radius, the end
/// of the surface, or a step that is larger than samples explain, and as many are taken on one side as on the
/// other, so that a visibility that changes evenly stays as it is. All visibilities are multiples of one
/// sample, so where there is no step of them nothing changes. Source: Schwarz 2009, section 4.2.3, which
/// leaves open how to filter.
class VisibilityFilter : public ProductStage {
 public:
  explicit VisibilityFilter(const SurfaceMean& settings) : settings_(settings) {}
  void prepare(frame::Frame& frame) override;
  void run(frame::Frame& frame, const gl::Texture& visibility) override;
  const gl::Texture& product() const override { return *filtered_; }

 private:
  SurfaceMean settings_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> rows_, filtered_;
};

}  // namespace limen::techniques
