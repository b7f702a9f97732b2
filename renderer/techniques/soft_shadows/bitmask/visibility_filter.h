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
  double planeShare = 0.1;  ///< share of the distance to a neighbour's point
  double angle = 15.0;      ///< degrees
  static const SettingsTable<SurfaceMean>& table();
};
struct NoFilter {
  static constexpr const char *kKind = "none", *kSummary = "visibility as gathered";
};
using FilterSettings = std::variant<NoFilter, SurfaceMean>;

/// Smooths the steps that few light samples leave in a visibility image: the mean over a row and then a
/// column of neighbours on the same surface. The walk on either side ends at the radius, the end of the
/// surface, or a step larger than sampling explains, and both sides use the same number of neighbours, so
/// that linearly changing visibility stays unchanged. All visibilities are multiples of one sample, so
/// nothing changes where there are no steps. Source: Schwarz 2009, section 4.2.3, which leaves the filter
/// open.
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
