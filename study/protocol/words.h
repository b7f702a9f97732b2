// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace limen::study {

/// What participants read besides a protocol's own texts, by key, in one language. The English file has all
/// keys; a translation has the same ones, with the same {placeholders}.
class Words {
 public:
  /// Throws one Error with a line for each problem: missing and unknown keys, other placeholders.
  static Words parse(const std::string& text, const std::string& path);
  static const Words& english();

  /// Programmer error if there is no such key.
  const std::string& operator[](std::string_view key) const;
  /// The text with its placeholders replaced.
  std::string filled(std::string_view key,
                     const std::vector<std::pair<std::string, std::string>>& values) const;
  const std::map<std::string, std::string, std::less<>>& all() const { return texts_; }
  const std::string& path() const { return path_; }
  const std::string& hash() const { return hash_; }  ///< SHA-256 of the file's text

 private:
  std::map<std::string, std::string, std::less<>> texts_;
  std::string path_, hash_;
};

/// `nameOrPath`: a language in study/words, or a file; relative to `folder` if it is there.
Words readWords(const std::string& nameOrPath, const std::string& folder);

}  // namespace limen::study
