// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limen::test {

/// Standard output and error of a shell command, and its exit status.
struct Said {
  int status = -1;
  std::string text;
};
Said run(const std::string& command);

/// Content of a file; a failure of the test if it cannot be read.
std::string contentOf(const std::filesystem::path& file);

/// A fresh folder with a simulated study, exported in all formats: "csv", "bids", "psych_ds".
class ExportedStudy {
 public:
  /// `protocol`: a shipped one. With frame logs.
  explicit ExportedStudy(const std::string& protocol);
  ~ExportedStudy();
  ExportedStudy(const ExportedStudy&) = delete;
  ExportedStudy& operator=(const ExportedStudy&) = delete;
  std::filesystem::path folder(const std::string& format) const { return folder_ / "out" / format; }

 private:
  std::filesystem::path folder_;
};

}  // namespace limen::test
