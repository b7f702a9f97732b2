// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace limen::scene {

/// Otherwise the function of the same name below would hide it in this namespace.
using limen::toText;

/// Throws Error, prefixed with `where`, unless a picture can be taken: all values finite, the target away
/// from the eye, `up` not parallel to the view, vertical field of view 0.01 to 179 degrees.
void checkCamera(const Camera& camera, const std::string& where);

/// A camera on one line: "eye X Y Z target X Y Z up X Y Z fov DEGREES", each word once and in any order;
/// without `up` it is 0 1 0, without `fov` 45. World units. Throws Error for other text, and for a camera
/// that checkCamera() refuses.
Camera parseCamera(const std::string& text, const std::string& where = {});

/// The line that parseCamera() reads back to the same doubles, each number as short as that allows.
std::string toText(const Camera& camera);

}  // namespace limen::scene
