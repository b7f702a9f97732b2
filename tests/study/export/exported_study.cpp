// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/export/exported_study.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace limen::test {

Said run(const std::string& command) {
  Said out;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return out;
  std::array<char, 4096> buffer{};
  for (size_t count = 0; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    out.text.append(buffer.data(), count);
  const int status = pclose(pipe);
  out.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return out;
}

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

ExportedStudy::ExportedStudy(const std::string& protocol) {
  std::string pattern = (std::filesystem::temp_directory_path() / "limen_exported_XXXXXX").string();
  EXPECT_NE(mkdtemp(pattern.data()), nullptr);
  folder_ = pattern;
  const std::string program = LIMEN_BIN_DIR "/limen-study ", store = pattern + "/s.sqlite";
  const Said simulated = run(program + "simulate " + protocol + " --observers 2 --seed 3 --store " + store);
  EXPECT_EQ(simulated.status, 0) << simulated.text;
  const Said exported = run(program + "export " + store + " -o " + pattern +
                            "/out --frames --format csv --format bids --format psych-ds");
  EXPECT_EQ(exported.status, 0) << exported.text;
}

ExportedStudy::~ExportedStudy() { std::filesystem::remove_all(folder_); }

}  // namespace limen::test
