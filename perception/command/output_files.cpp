// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/text.h"

namespace limen::perception {
namespace {

namespace fs = std::filesystem;

/// The file's canonical name: absolute, links resolved.
std::string resolved(const std::string& path) {
  std::error_code code;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, code), code);
  return code ? path : whole.string();
}

std::string lowerExtension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

}  // namespace

OutputFiles::OutputFiles(const std::vector<FrameSet>& frames, const std::vector<std::string>& inputs)
    : frames_(frames) {
  for (const std::string& input : inputs)
    if (!input.empty()) {
      inputs_.insert(resolved(input));
      protectInput(input);
    }
}

void OutputFiles::refuseInputs(const std::string& option, const std::string& path) const {
  const std::string name = resolved(path);
  std::error_code code;
  bool isInput = inputs_.count(name) != 0;
  // The same file under another name (a hard link).
  if (!isInput && fs::exists(path, code) && fs::hard_link_count(path, code) > 1)
    isInput = std::any_of(inputs_.begin(), inputs_.end(),
                          [&](const std::string& input) { return fs::equivalent(path, input, code); });
  if (isInput)
    throw Error("'" + path + "' is an input", option, "inputs are never overwritten: give another name");
  if (taken_.count(name))
    throw Error("'" + path + "' is written twice", option, "give each output its own name");
  if (fs::is_directory(path, code)) throw Error("'" + path + "' is a folder", option, "name a file");
}

void OutputFiles::addFile(const std::string& option, const std::string& pattern,
                          const std::vector<std::string>& endings) {
  if (pattern.empty()) return;
  if (std::find(endings.begin(), endings.end(), lowerExtension(pattern)) == endings.end())
    throw Error("'" + pattern + "' does not end in " + join(endings, " or "), option,
                "the ending selects the format");
  if (frames_.size() > 1 && !hasNumberPlace(pattern))
    throw Error(fmt::format("'{}' has no place for the numbers of {} frames", pattern, frames_.size()),
                option, "put %04d in the name");
  for (const FrameSet& frame : frames_) {
    const std::string path = fillNumber(pattern, frame);
    refuseInputs(option, path);
    taken_.insert(resolved(path));
  }
}

void OutputFiles::addFolder(const std::string& option, const std::string& folder) {
  if (folder.empty()) return;
  std::error_code code;
  if (fs::exists(folder, code) && !fs::is_directory(folder, code))
    throw Error("'" + folder + "' is not a folder", option, "name a folder; it is created if it is missing");
  for (const FrameSet& frame : frames_) {
    const std::string inside = resolved(this->folder(folder, frame));
    for (const std::string& input : inputs_)
      if (fs::path(input).parent_path() == fs::path(inside))
        throw Error("'" + input + "' lies in '" + folder + "', which is written to", option,
                    "inputs are never overwritten: give another folder");
  }
}

std::string OutputFiles::folder(const std::string& folder, const FrameSet& frame) const {
  if (frames_.size() <= 1) return folder;
  return (fs::path(folder) / fillNumber("frame_%04d", frame)).string();
}

}  // namespace limen::perception
