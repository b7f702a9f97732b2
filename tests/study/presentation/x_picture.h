// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace limen::test {

/// What an X server has on its screen, row 0 at the top.
struct XPicture {
  int width = 0, height = 0;
  std::vector<glm::ivec3> codes;
  glm::ivec3 at(int x, int y) const { return codes.at(static_cast<size_t>(y * width + x)); }
};
XPicture pictureOfScreen(const std::string& display);

/// Owns a selection while it lives, as a window manager does that wants to be known.
class SelectionOwner {
 public:
  SelectionOwner(const std::string& display, const std::string& selection);
  ~SelectionOwner();
  SelectionOwner(const SelectionOwner&) = delete;
  SelectionOwner& operator=(const SelectionOwner&) = delete;

 private:
  void* display_;
};

}  // namespace limen::test
