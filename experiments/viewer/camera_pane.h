// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "experiments/viewer/pane.h"

namespace limen::viewer {

/// Camera, its path and saved views.
class CameraPane {
 public:
  void build(const PaneContext& pane);

 private:
  void views(const PaneContext& pane);

  std::array<char, 128> viewName_{};  // as typed so far
};

}  // namespace limen::viewer
