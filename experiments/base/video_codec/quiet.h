// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen::codec {

/// Turns off what OpenCV and FFmpeg print by themselves, and everything but files as FFmpeg's input: what
/// looks like a video may be a list of addresses.
void quietLibraries();

/// Four letters as OpenCV gives them, a property: "MJPG"; "" for 0.
std::string lettersOf(double code);

}  // namespace limen::codec
