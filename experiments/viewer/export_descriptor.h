// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/viewer/setup.h"

namespace limen::viewer {

/// What is on screen as a descriptor: `limen sweep` makes the same picture of it. Parameters at their
/// defaults are left out.
std::string descriptorOf(const ViewSetup& setup);

/// Writes descriptorOf() to a new file "exported_NNN.yaml" in `folder` and returns its path. Throws Error if
/// a sweep would not accept the descriptor, or the file cannot be written; no file is overwritten.
std::string exportDescriptor(const ViewSetup& setup, const std::string& folder);

/// The setup of a descriptor's first run. Throws Error as a sweep would.
ViewSetup readSetup(const std::string& descriptorPath);

}  // namespace limen::viewer
