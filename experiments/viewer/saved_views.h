// SPDX-License-Identifier: BSD-3-Clause
// Named views in a file that people may read and edit:
//
//     views:
//       - {name: "feet of the columns", scene: "columns_hall", camera: "eye ... target ..."}
#pragma once

#include <string>
#include <vector>

namespace limen::viewer {

struct SavedView {
  std::string name;    ///< not empty; unique within a file
  std::string scene;   ///< registered name
  std::string camera;  ///< see scene::parseCamera()
  bool operator==(const SavedView&) const = default;
};

/// The views of a file in their order; none if there is no such file. Throws one Error with a line
/// "FILE:LINE:COLUMN: ..." for everything that is wrong.
std::vector<SavedView> readSavedViews(const std::string& file);

/// Adds a view, or replaces the one of its name. The file is read again, so that what another viewer saved
/// meanwhile is kept, and is replaced as a whole: if killed at any time, it holds either all old views or all
/// new ones. Throws Error, the file left as it is, if it cannot be read or the view would not read back. A
/// file that someone edited (comments, other order) is saved as FILE.by_hand first, replacing an older one.
void saveView(const std::string& file, const SavedView& view);

/// Removes the view of this name, with saveView()'s guarantees; false if there is none.
bool removeView(const std::string& file, const std::string& name);

}  // namespace limen::viewer
