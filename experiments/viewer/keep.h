// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/base/image.h"
#include "experiments/viewer/choices.h"

namespace limen::viewer {

/// What is on screen as a descriptor: `limen sweep` makes the same picture of it. Parameters at their default
/// are left out.
std::string descriptorOf(const Choices& choices);

/// Writes descriptorOf() to a new file "kept_NNN.yaml" in `folder` and returns its path. Throws Error if the
/// descriptor would not be accepted by a sweep, or the file cannot be written; what is there already stays.
std::string keep(const Choices& choices, const std::string& folder);

/// The first run of a descriptor. Throws Error as a sweep would.
Choices choicesOf(const std::string& descriptorPath);

/// Images to be written, by name: values as they are, and as a picture.
struct ProductImages {
  std::shared_ptr<const Image> values;   ///< EXR; null: none
  std::shared_ptr<const Image> picture;  ///< PNG, display-coded; null: none
};

/// Writes "NAME.exr" and "NAME.png" into a new folder "pictures_NNN" of `folder`; returns its path. Throws
/// Error where a file cannot be written.
std::string writeProducts(const std::map<std::string, ProductImages>& images, const Choices& choices,
                          const std::string& folder);

}  // namespace limen::viewer
