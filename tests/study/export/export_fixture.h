// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "study/export/export.h"
#include "study/export/pseudonyms.h"

namespace limen::study {

/// A store of one study, and what its exports write.
class Export : public testing::Test {
 protected:
  Export() : folder_(std::filesystem::temp_directory_path() / ("limen_export_" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    store_ = folder_ / "study.sqlite";
  }
  ~Export() override { std::filesystem::remove_all(folder_); }

  /// A session of three trials: practice, one whose frames came late, its repetition.
  void addSession(const std::string& participant, const std::string& name, bool simulated = false);

  static std::string read(const std::filesystem::path& file) {
    std::ifstream in(file);
    EXPECT_TRUE(in) << file;
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Cells of a table without quotes in it, by column.
  static std::vector<std::map<std::string, std::string>> parse(const std::string& text, char separator);

  ExportRequest request(const std::string& name, std::vector<ExportFormat> formats) {
    ExportRequest out;
    out.store = store_;
    out.folder = folder_ / name;
    out.formats = std::move(formats);
    out.frames = true;
    return out;
  }
  std::string subjectOf(const std::string& code) {
    Pseudonyms pseudonyms(keyFileOf(store_));
    return pseudonyms.of(code);
  }

  std::filesystem::path folder_;
  std::string store_;
  uint64_t seed_ = 18446744073709551615U;
  double reactionTimeS_ = 0.25;
  bool markers_ = false;  ///< sessions were run with a recorder
};

}  // namespace limen::study
