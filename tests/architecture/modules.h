// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace limen::architecture {

/// A folder whose insides are its own: others use the headers at its top.
struct Module {
  std::string folder;
  std::vector<std::string> mayUse;  ///< folders of other modules
  bool mayUseGl = false;            ///< may name OpenGL, EGL or window libraries itself
};

/// Every module of the tree and the directions of dependency between them.
const std::vector<Module>& modules();

/// Module that a path (relative to the root, with forward slashes) lies in: the one with the longest folder
/// that is a prefix of it. Null: in none.
const Module* moduleOf(const std::string& path);

bool mayUse(const Module& user, const Module& used);

/// True if `name`, a header, package, target or shared library, is of OpenGL, EGL or a window system.
bool namesGl(const std::string& name);

}  // namespace limen::architecture
