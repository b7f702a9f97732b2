// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "experiments/base/parameter.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// Smooths the steps that few light samples leave in a visibility image: the mean over a row and then a
/// column of neighbours on the same surface. Neighbours are walked to on both sides up to the radius, the end
/// of the surface, or a step that is larger than samples explain, and as many are taken on one side as on the
/// other, so that a visibility that changes evenly stays as it is. All visibilities are multiples of one
/// sample, so where there is no step of them nothing changes. Source: Schwarz 2009, section 4.2.3, which
/// leaves open how to filter.
class VisibilityFilter {
 public:
  static std::vector<Parameter> parameters();
  /// Throws Error where values of these parameters do not go together.
  static void check(const ParameterValues& values);

  explicit VisibilityFilter(const ParameterValues& values);
  bool isOn() const { return radius_ > 0; }
  void prepare(frame::Frame& frame);
  void run(frame::Frame& frame, const gl::Texture& visibility) const;
  const gl::Texture& filtered() const { return *filtered_; }

 private:
  int radius_;
  float step_, planeShare_, normalCosine_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> rows_, filtered_;
};

}  // namespace limen::techniques
