// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <string>

namespace limen::viewer {

class Viewer;
class UiTexture;

/// The picture or pictures, and the hand on them: camera, picked pixel, split.
class PicturePane {
 public:
  PicturePane(Viewer& viewer, glm::vec2 leastPx, glm::vec2 mostPx);
  void build(double secondsPassed);

 private:
  struct Placed {
    glm::vec2 leastPx, mostPx;
  };
  void arrangementBar();
  void show(double secondsPassed);
  Placed place(const UiTexture& texture, glm::vec2 leastPx, glm::vec2 mostPx) const;
  void draw(const UiTexture& texture, const Placed& where, float fromX, float toX, const std::string& name);
  void hand(const Placed& where, double secondsPassed);

  Viewer& viewer_;
  glm::vec2 leastPx_, mostPx_;
};

}  // namespace limen::viewer
