// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/image_sequence.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <regex>

#include "experiments/base/error.h"
#include "experiments/base/video.h"
#include "perception/command/video_inputs.h"

namespace limen::perception {
namespace {

namespace fs = std::filesystem;

/// A file name split at its number.
struct NumberPlace {
  std::string before, after;
  size_t width = 0;  ///< smallest number of digits
  bool padded = false;
};

std::optional<NumberPlace> findPlace(const std::string& name) {
  static const std::regex kPlace("%(0([0-9]+))?d|#+", std::regex::optimize);
  std::smatch match;
  if (!std::regex_search(name, match, kPlace)) return std::nullopt;
  NumberPlace place;
  place.before = match.prefix();
  place.after = match.suffix();
  if (name[static_cast<size_t>(match.position())] == '#') {
    place.width = static_cast<size_t>(match.length());
  } else if (match[2].matched) {
    place.width = static_cast<size_t>(std::min(std::stoul("0" + match[2].str().substr(0, 3)), 18UL));
  }
  place.padded = place.width > 0;
  if (std::regex_search(place.after, kPlace))
    throw Error("'" + name + "' has places for two numbers", {}, "a sequence counts with one");
  return place;
}

/// The number in `name`, if the pattern could produce it.
std::optional<int64_t> numberIn(const NumberPlace& place, const std::string& name) {
  const size_t around = place.before.size() + place.after.size();
  if (name.size() <= around || name.compare(0, place.before.size(), place.before) != 0 ||
      name.compare(name.size() - place.after.size(), place.after.size(), place.after) != 0)
    return std::nullopt;
  const std::string digits = name.substr(place.before.size(), name.size() - around);
  if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 18) return std::nullopt;
  const size_t width = std::max<size_t>(place.width, 1);
  if (digits.size() < width || (digits.size() > width && digits[0] == '0')) return std::nullopt;
  int64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

/// Digits compare as numbers.
bool naturallyLess(const std::string& a, const std::string& b) {
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!isDigit(a[i]) || !isDigit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto run = [&](const std::string& text, size_t& at) {
      while (at + 1 < text.size() && text[at] == '0' && isDigit(text[at + 1])) ++at;
      const size_t start = at;
      while (at < text.size() && isDigit(text[at])) ++at;
      return text.substr(start, at - start);
    };
    const std::string first = run(a, i), second = run(b, j);
    if (first.size() != second.size()) return first.size() < second.size();
    if (first != second) return first < second;
  }
  if ((i < a.size()) != (j < b.size())) return j < b.size();
  return a < b;
}

ImageSequence numbered(const std::string& argument, const NumberPlace& place) {
  const fs::path folder = fs::path(argument).parent_path();
  ImageSequence sequence;
  sequence.argument = argument;
  sequence.single = false;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, code)) {
    const std::string name = entry.path().filename().string();
    const std::optional<int64_t> number = numberIn(place, name);
    if (number && entry.is_regular_file(code))
      sequence.frames.push_back({(folder / name).string(), number, {}});
  }
  std::sort(sequence.frames.begin(), sequence.frames.end(),
            [](const SequenceFrame& a, const SequenceFrame& b) { return *a.number < *b.number; });
  constexpr size_t kMostNamed = 1000;
  for (size_t i = 1; i < sequence.frames.size(); ++i)
    for (int64_t n = *sequence.frames[i - 1].number + 1;
         n < *sequence.frames[i].number && sequence.missing.size() < kMostNamed; ++n)
      sequence.missing.push_back(n);
  return sequence;
}

ImageSequence globbed(const std::string& argument) {
  ImageSequence sequence;
  sequence.argument = argument;
  sequence.single = false;
  glob_t found{};
  if (glob(argument.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
    for (size_t i = 0; i < found.gl_pathc; ++i)
      if (fs::is_regular_file(found.gl_pathv[i])) sequence.frames.push_back({found.gl_pathv[i], {}, {}});
  globfree(&found);
  std::sort(sequence.frames.begin(), sequence.frames.end(),
            [](const SequenceFrame& a, const SequenceFrame& b) { return naturallyLess(a.path, b.path); });
  return sequence;
}

ImageSequence ofVideo(const std::string& argument) {
  ImageSequence sequence;
  sequence.argument = argument;
  sequence.single = false;
  sequence.video = true;
  const int64_t frames = videoInput(argument).facts().frames;
  for (int64_t index = 0; index < frames; ++index) sequence.frames.push_back({argument, index + 1, index});
  return sequence;
}

std::string numbersText(const std::vector<int64_t>& numbers) {
  std::string out;
  for (size_t i = 0; i < std::min<size_t>(numbers.size(), 8); ++i)
    out += (i ? ", " : "") + std::to_string(numbers[i]);
  return numbers.size() > 8 ? out + ", ... (" + std::to_string(numbers.size()) + " in all)" : out;
}

void checkCounts(const ImageSequence& first, const ImageSequence& other, bool byNumber) {
  if (byNumber) {
    std::vector<int64_t> a, b, lacking;
    for (const SequenceFrame& frame : first.frames) a.push_back(*frame.number);
    for (const SequenceFrame& frame : other.frames) b.push_back(*frame.number);
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(lacking));
    if (!lacking.empty())
      throw Error("'" + other.argument + "' lacks the frames " + numbersText(lacking) + " of '" +
                      first.argument + "'",
                  {}, "give sequences of the same frames");
    std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(lacking));
    if (!lacking.empty())
      throw Error("'" + first.argument + "' lacks the frames " + numbersText(lacking) + " of '" +
                      other.argument + "'",
                  {}, "give sequences of the same frames");
  } else if (first.frames.size() != other.frames.size()) {
    throw Error(fmt::format("'{}' has {} frames, '{}' has {}", first.argument, first.frames.size(),
                            other.argument, other.frames.size()),
                {}, "give sequences of the same length");
  }
}

}  // namespace

ImageSequence expandImages(const std::string& argument) {
  std::error_code code;
  if (argument.empty()) throw Error("an image's name is empty");
  if (fs::exists(argument, code)) {
    if (isVideoName(argument) && !fs::is_directory(argument, code)) return ofVideo(argument);
    ImageSequence image;
    image.argument = argument;
    image.frames = {{argument, {}, {}}};
    return image;
  }
  const fs::path path(argument);
  ImageSequence sequence;
  if (const std::optional<NumberPlace> place = findPlace(path.filename().string())) {
    sequence = numbered(argument, *place);
  } else if (argument.find_first_of("*?[") != std::string::npos) {
    sequence = globbed(argument);
  } else {
    throw Error("no such image '" + argument + "'", {}, "check the path");
  }
  if (sequence.frames.empty())
    throw Error("no file matches '" + argument + "'", {}, "check the path and the pattern");
  return sequence;
}

std::string FrameSet::label() const {
  if (number) return "frame " + std::to_string(*number);
  return paths.empty() ? "frame " + std::to_string(index + 1) : fs::path(paths.front()).filename().string();
}

std::vector<FrameSet> alignSequences(const std::vector<ImageSequence>& sequences) {
  const ImageSequence* lead = nullptr;
  for (const ImageSequence& sequence : sequences) {
    if (sequence.single) continue;
    if (!lead) {
      lead = &sequence;
      continue;
    }
    const bool byNumber = lead->frames.front().number && sequence.frames.front().number;
    checkCounts(*lead, sequence, byNumber && !lead->video && !sequence.video);
  }
  const size_t count = lead ? lead->frames.size() : 1;
  std::vector<FrameSet> frames(count);
  for (size_t i = 0; i < count; ++i) {
    frames[i].index = i;
    if (lead) frames[i].number = lead->frames[i].number;
    for (const ImageSequence& sequence : sequences) {
      const SequenceFrame frame = sequence.frames.empty() ? SequenceFrame{}
                                  : sequence.single       ? sequence.frames.front()
                                                          : sequence.frames[i];
      frames[i].paths.push_back(frame.path);
      frames[i].videoFrames.push_back(frame.videoFrame);
    }
  }
  return frames;
}

bool hasNumberPlace(const std::string& path) {
  return findPlace(fs::path(path).filename().string()).has_value();
}

std::string fillNumber(const std::string& pattern, const FrameSet& frame) {
  const fs::path path(pattern);
  const std::optional<NumberPlace> place = findPlace(path.filename().string());
  if (!place) return pattern;
  const int64_t number = frame.number ? *frame.number : static_cast<int64_t>(frame.index) + 1;
  const std::string digits = fmt::format("{:0{}}", number, std::max<size_t>(place->width, 1));
  return (path.parent_path() / (place->before + digits + place->after)).string();
}

}  // namespace limen::perception
