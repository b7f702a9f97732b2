// SPDX-License-Identifier: BSD-3-Clause
#include "study/export/pseudonyms.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "experiments/base/error.h"
#include "experiments/base/folder_lock.h"
#include "experiments/base/replace_file.h"
#include "perception/psychometrics/random.h"

namespace limen::study {
namespace {

constexpr const char* kHeader = "participant,pseudonym";

}  // namespace

std::string keyFileOf(const std::string& store) { return store + ".key.csv"; }

Pseudonyms::Pseudonyms(const std::string& keyFile) : file_(keyFile) { read(); }

void Pseudonyms::read() {
  known_.clear();
  std::ifstream in(file_);
  if (!in) return;
  std::string line;
  std::set<std::string> taken;
  for (int number = 1; std::getline(in, line); ++number) {
    if (number == 1 && line == kHeader) continue;
    const size_t comma = line.find(',');
    const std::string where = file_ + ":" + std::to_string(number);
    if (number == 1 || comma == std::string::npos || comma == 0 || comma + 1 == line.size())
      throw Error("not a line of a key table: '" + line + "'", where, "restore the file from a copy");
    if (!known_.emplace(line.substr(0, comma), line.substr(comma + 1)).second ||
        !taken.insert(line.substr(comma + 1)).second)
      throw Error("a code or pseudonym appears twice", where, "restore the file from a copy");
  }
}

void Pseudonyms::assign(std::vector<std::string> codes) {
  const FolderLock lock(std::filesystem::path(file_).parent_path().string());
  read();  // another process may have written it since
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  std::erase_if(codes, [this](const std::string& code) { return known_.count(code) != 0; });
  if (codes.empty()) return;
  // Cannot be derived from anything exported: the seed is not kept, only the file is.
  std::random_device device;
  psychometrics::Random random((uint64_t{device()} << 32) ^ device());
  random.shuffle(codes);
  std::set<std::string> taken;
  for (const auto& [code, pseudonym] : known_) taken.insert(pseudonym);
  int next = 1;
  for (const std::string& code : codes) {
    std::string pseudonym;
    do pseudonym = fmt::format("P{:03}", next++);
    while (taken.count(pseudonym));
    known_[code] = pseudonym;
  }
  std::string text = fmt::format("{}\n", kHeader);
  for (const auto& [code, pseudonym] : known_) text += fmt::format("{},{}\n", code, pseudonym);
  replaceFile(file_, text, {}, Readers::OwnerOnly);
}

const std::string& Pseudonyms::of(const std::string& code) const { return known_.at(code); }

std::string ageBin(const std::string& age) {
  int years = 0;
  const auto [end, error] = std::from_chars(age.data(), age.data() + age.size(), years);
  if (error != std::errc() || end != age.data() + age.size() || years < 0 || years > 120) return age;
  return years < 18    ? "under 18"
         : years >= 80 ? "80 or more"
                       : fmt::format("{}-{}", years < 20 ? 18 : years / 10 * 10, years / 10 * 10 + 9);
}

}  // namespace limen::study
