// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/scene/shapes.h"
#include "renderer/visibility_fields/visibility_fields.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::visibility_fields {

inline RigidObject objectOf(const scene::Mesh& mesh) {
  return makeRigidObject("object", mesh.positions, mesh.triangles);
}

/// A cone beside a box: concave together, with edges and a round side.
inline scene::Mesh coneAndBox() {
  scene::Mesh mesh = scene::frustum({0.0, 0.0, 0.0}, {0.1, 1.4, 0.0}, 0.5, 0.0, 48);
  scene::append(mesh, scene::box({0.4, 0.0, -0.3}, {0.9, 0.7, 0.4}));
  return mesh;
}

class Field : public gl::GlTest {
 protected:
  static VisibilityFields make(const std::vector<RigidObject>& objects, const FieldForm& form) {
    return VisibilityFields(context(), objects, form);
  }
};

}  // namespace limen::visibility_fields
