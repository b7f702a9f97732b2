// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "experiments/base/image.h"
#include "experiments/viewer/setup.h"

namespace limen::viewer {

/// An image to write: its values, and a picture of them.
struct ProductImages {
  std::shared_ptr<const Image> values;   ///< EXR; null: none
  std::shared_ptr<const Image> picture;  ///< PNG, display-coded; null: none
};

/// Writes "NAME.exr" and "NAME.png" for each name, and the descriptor of `setup`, into a new folder
/// "pictures_NNN" of `folder`; returns its path. Throws Error if a file cannot be written.
std::string writePictures(const std::map<std::string, ProductImages>& images, const ViewSetup& setup,
                          const std::string& folder);

}  // namespace limen::viewer
