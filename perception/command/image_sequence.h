// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace limen::perception {

/// One image of a call, or of each frame of it.
struct SequenceFrame {
  std::string path;
  std::optional<int64_t> number;      ///< from the name, of a video from 1; none for single files and globs
  std::optional<int64_t> videoFrame;  ///< of a video: the index in it, from 0
};

/// What one command-line argument refers to. In frame order: by number for numbered patterns, otherwise by
/// name with digits read as numbers (frame_2 before frame_10).
struct ImageSequence {
  std::string argument;
  bool single = true;  ///< the name of one image, not a pattern and no video
  bool video = false;
  std::vector<SequenceFrame> frames;
  std::vector<int64_t> missing;  ///< numbers between the first and the last that have no file
};

/// `argument` is the name of a file, or a pattern whose file name has one number: "%04d" or "####" (digits
/// padded with zeros to that width), "%d" (not padded), or a glob with *, ? or [...]. A file with literally
/// that name takes precedence; one that is named like a video is a sequence of its frames. Throws Error:
/// nothing matches, two numbers, a folder, a video that cannot be read.
ImageSequence expandImages(const std::string& argument);

/// Images that belong together: one of each argument.
struct FrameSet {
  size_t index = 0;                ///< from 0
  std::optional<int64_t> number;   ///< common to all
  std::vector<std::string> paths;  ///< in the order of the sequences; "" for an argument that was not given
  std::vector<std::optional<int64_t>> videoFrames;  ///< of those that are videos, in the same order
  /// "frame 12" or, without a number, the file name of the first.
  std::string label() const;
};

/// Frames of sequences side by side: by number if all are images with numbers, otherwise in order. A single
/// file is used for every frame; an empty argument (frames empty) for none. Throws Error if counts or numbers
/// differ.
std::vector<FrameSet> alignSequences(const std::vector<ImageSequence>& sequences);

/// True if a name has a placeholder for a frame's number.
bool hasNumberPlace(const std::string& path);
/// `pattern` with the frame's number (its position from 1 if it has none) filled in.
std::string fillNumber(const std::string& pattern, const FrameSet& frame);

}  // namespace limen::perception
