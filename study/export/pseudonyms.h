// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace limen::study {

/// Maps participant codes to pseudonyms. The table is in a separate file beside the store ("STORE.key.csv",
/// readable only by its owner) and never part of an export: whoever has both can identify participants.
class Pseudonyms {
 public:
  /// Reads the file if there is one. Throws Error on a damaged one.
  explicit Pseudonyms(const std::string& keyFile);

  /// Gives every code without one a pseudonym P001, P002 ... in an order unrelated to that of the sessions,
  /// and writes the file. Existing pseudonyms stay. Throws Error if it cannot be written. Processes that do
  /// this at once agree.
  void assign(std::vector<std::string> codes);
  const std::string& of(const std::string& code) const;

 private:
  void read();
  std::string file_;
  std::map<std::string, std::string> known_;
};

std::string keyFileOf(const std::string& store);

/// A decade: "20-29" of "23"; text that is not a whole number from 0 to 120 (already a bin) stays unchanged.
std::string ageBin(const std::string& age);

}  // namespace limen::study
