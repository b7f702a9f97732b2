// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/sweep.h"

namespace limen::analysis {

/// One image of a row, cut to the row's window.
struct Picture {
  std::string caption;  ///< "product", "reference", "absolute error"
  std::string dataUri;
  std::string id;     ///< equal pictures have the same
  std::string white;  ///< of an error map: what the brightest colour stands for; "": unknown
};

/// What one run looks like beside its reference.
struct PictureRow {
  size_t cell = 0;     ///< index into Sweep::cells
  std::string chosen;  ///< "lowest error of 9 settings"
  std::vector<Picture> pictures;
  int width = 0, height = 0;  ///< of the window
  std::string window;         ///< "192×144 pixels from (384, 128) of 1024×768"
  std::string note;           ///< what could not be shown, or the scale of the error map
};

struct Pictures {
  std::vector<std::vector<PictureRow>> panels;  ///< by panel
  std::string note;                             ///< which runs were left out
};

/// Chooses runs (per series and panel those with the lowest, middle and highest error; fewer if there are
/// many), cuts the window with the largest difference from the reference and writes the cuts into `folder`. A
/// picture that cannot be read is a note in its row, not an error.
Pictures choosePictures(const Sweep& sweep, const std::string& storePath, const std::string& folder);

}  // namespace limen::analysis
