// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/detail_by_size.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <sstream>

#include "renderer/visibility_fields/cpu_field.h"

namespace limen::techniques {
namespace vf = visibility_fields;
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

struct Candidate {
  vf::FieldForm form;
  double words, square;  ///< square: of the bound per pixel of size
};

double squareOf(const vf::FieldForm& form) {
  const double wrong = vf::fieldSpacing(form) + (form.bits == 1 ? 1.0 : 0.0);
  return 2.0 * M_PI * wrong * wrong;
}

/// Forms that no other betters in both, coarsest first; the last is `finest`.
std::vector<Candidate> candidatesUpTo(const vf::FieldForm& finest) {
  std::vector<Candidate> all;
  for (const int positions : {82, 290, 1090, 4226, 16642})
    for (const int directions : {8, 16, 32, 64, 128, 256})
      for (const int bits : {1, finest.bits}) {
        if (positions > finest.positions || directions > finest.directions) continue;
        vf::FieldForm form = finest;
        form.positions = positions, form.directions = directions, form.bits = bits;
        all.push_back({form, double(positions) * directions * form.wordsPerRow(), squareOf(form)});
      }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return a.words != b.words ? a.words < b.words : a.square < b.square;
  });
  std::vector<Candidate> best;
  for (const Candidate& each : all)
    if (best.empty() || each.square < best.back().square) best.push_back(each);
  return best;
}

std::string threePlaces(double value) {
  std::ostringstream out;
  out.precision(3);
  out << value;
  return out.str();
}

std::string formText(const vf::FieldForm& form) {
  const std::string side = std::to_string(form.directions);
  return std::to_string(form.positions) + " x " + side + " x " + side + " of " + std::to_string(form.bits) +
         (form.bits == 1 ? " bit" : " bits");
}

}  // namespace

double sizePx(const scene::Camera& camera, glm::ivec2 pictureSizePx, const vf::Pose& pose) {
  const double focalPx = 0.5 * pictureSizePx.y / std::tan(0.5 * glm::radians(camera.verticalFovDeg));
  const double distance = glm::distance(camera.eye, pose.centre), radius = pose.radius;
  if (!(distance > radius)) return kNoBound;
  // Of the cone that holds the sphere.
  return focalPx * radius / std::sqrt(distance * distance - radius * radius);
}

double boundBySize(const vf::FieldForm& form, double sizePx, glm::ivec2 pictureSizePx) {
  return std::sqrt(squareOf(form) / (double(pictureSizePx.x) * pictureSizePx.y)) * sizePx;
}

size_t ChosenDetail::formCount() const {
  std::map<std::string, int> texts;
  for (const vf::FieldForm& form : forms) ++texts[formText(form)];
  return texts.size();
}

ChosenDetail formsBySize(const vf::FieldForm& finest, const std::vector<double>& sizesPx,
                         glm::ivec2 pictureSizePx, double error) {
  const std::vector<Candidate> candidates = candidatesUpTo(finest);
  std::vector<size_t> chosen(sizesPx.size(), 0);
  const double pixels = double(pictureSizePx.x) * pictureSizePx.y;
  const auto square = [&](size_t object, size_t candidate) {
    return candidates[candidate].square * sizesPx[object] * sizesPx[object] / pixels;
  };
  bool unbounded = false;
  for (size_t i = 0; i < sizesPx.size(); ++i)
    if (!std::isfinite(sizesPx[i])) chosen[i] = candidates.size() - 1, unbounded = true;
  const auto total = [&] {
    double sum = 0.0;
    for (size_t i = 0; i < sizesPx.size(); ++i)
      if (std::isfinite(sizesPx[i])) sum += square(i, chosen[i]);
    return sum;
  };
  double sum = total();
  while (sum > error * error) {
    double best = 0.0;
    size_t object = 0, to = 0;
    for (size_t i = 0; i < sizesPx.size(); ++i)
      for (size_t next = chosen[i] + 1; next < candidates.size(); ++next) {
        const double gain =
            (square(i, chosen[i]) - square(i, next)) / (candidates[next].words - candidates[chosen[i]].words);
        if (gain > best) best = gain, object = i, to = next;
      }
    if (!(best > 0.0)) {
      // All are the finest: each keeps to its share by itself, if it can.
      const double share = error * error / double(sizesPx.size());
      for (size_t i = 0; i < sizesPx.size(); ++i)
        for (size_t each = candidates.size(); each-- > 0;)
          if (std::isfinite(sizesPx[i]) && square(i, each) <= share) chosen[i] = each;
      sum = total();
      break;
    }
    chosen[object] = to;
    sum = total();  // anew, so that no rounding adds up
  }
  ChosenDetail out;
  out.error = error;
  out.bound = unbounded ? kNoBound : std::sqrt(sum);
  for (const size_t each : chosen) out.forms.push_back(candidates[each].form);
  return out;
}

std::vector<std::string> detailRemarks(const ChosenDetail& detail, const std::vector<std::string>& names) {
  struct Group {
    int objects = 0;
    std::string first;
  };
  std::map<std::string, Group> groups;
  for (size_t i = 0; i < detail.forms.size(); ++i) {
    Group& group = groups[formText(detail.forms[i])];
    if (group.objects++ == 0) group.first = names[i];
  }
  std::string text = "fields by size:";
  bool any = false;
  for (const auto& [form, group] : groups) {
    text += any ? "; " : " ";
    any = true;
    text +=
        form + " for " +
        (group.objects == 1 ? "'" + group.first + "'"
                            : std::to_string(group.objects) + " objects, the first '" + group.first + "'");
  }
  std::vector<std::string> out = {text};
  if (!std::isfinite(detail.bound))
    out.emplace_back(
        "the camera is within an object's sphere, so that there is no bound of the error: that object has "
        "the finest field given");
  else if (!detail.kept())
    out.push_back("the bound of the error is " + threePlaces(detail.bound) + ", above the " +
                  threePlaces(detail.error) + " asked for, even with the finest fields given");
  return out;
}

}  // namespace limen::techniques
