// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen::viewer {

class Viewer;

/// What stands around the picture: choices on the left, figures on the right, messages below.
class Panes {
 public:
  explicit Panes(Viewer& viewer);
  void build();
  float leftPx() const { return leftPx_; }
  float rightPx() const { return rightPx_; }
  float bottomPx() const { return bottomPx_; }

 private:
  void choices();
  void scene();
  void technique(const std::string& title, const std::string& prefix, bool second);
  void reference();
  void camera();
  void output();
  void figures();
  void times();
  void errors();
  void costs();
  void pixel();
  void messages();

  Viewer& viewer_;
  float leftPx_ = 0, rightPx_ = 0, bottomPx_ = 0;
};

}  // namespace limen::viewer
