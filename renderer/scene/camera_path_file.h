// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace limen::scene {

/// Reads a camera path from YAML:
///
///     camera_path:
///       - {time_s: 0, eye: [0, 1, 5], target: [0, 0, 0], up: [0, 1, 0], fov_deg: 45}
///
/// World units. `up` may be left out (0 1 0), as may `fov_deg` (45). Times ascend; at most two keys may share
/// a time: a cut. Throws one Error with a line "FILE:LINE:COLUMN: ..." per problem: unknown keys, values that
/// are not numbers, descending times, cameras that checkCamera() refuses.
CameraPath parseCameraPath(const std::string& text, const std::string& file);
CameraPath readCameraPath(const std::string& path);

/// The text that parseCameraPath() reads back to the same doubles. Contains a path's keys but not `runIn`.
std::string toYaml(const CameraPath& path);

/// Writes a path; an existing file is replaced completely or not at all. Throws Error if the path could
/// not be read back.
void writeCameraPath(const std::string& file, const CameraPath& path);

}  // namespace limen::scene
