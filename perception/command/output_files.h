// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "perception/command/image_sequence.h"

namespace limen::perception {

/// Files that a call writes: checked before anything is computed, so that a long sequence does not end in an
/// error, and no input is ever lost.
class OutputFiles {
 public:
  /// `inputs`: every file that the call reads.
  OutputFiles(const std::vector<FrameSet>& frames, const std::vector<std::string>& inputs);

  /// A file (of each frame) named by an option; "" is ignored. Throws Error: an ending other than
  /// `endings` (".png"), a sequence without a place for the number, an output that is an input or another
  /// output.
  void addFile(const std::string& option, const std::string& pattern,
               const std::vector<std::string>& endings);
  /// A folder named by an option; frames of a sequence get their own folders in it. Throws Error if it is
  /// a file, or holds an input.
  void addFolder(const std::string& option, const std::string& folder);

  /// The pattern or folder resolved for a frame.
  std::string file(const std::string& pattern, const FrameSet& frame) const {
    return fillNumber(pattern, frame);
  }
  std::string folder(const std::string& folder, const FrameSet& frame) const;

 private:
  void refuseInputs(const std::string& option, const std::string& path) const;

  const std::vector<FrameSet>& frames_;
  std::set<std::string> inputs_;  ///< resolved
  std::set<std::string> taken_;   ///< resolved outputs
};

}  // namespace limen::perception
