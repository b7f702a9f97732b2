// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/camera_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::scene {
namespace {

constexpr double kSmallestFovDeg = 0.01, kLargestFovDeg = 179.0;  // limits of CameraPath::at()
/// Sine of the angle below which view and up do not determine which way is up: the cross product of two unit
/// vectors has an absolute rounding error of 1e-16, which turns the picture by 1e-10 rad at this angle.
constexpr double kSmallestUpSine = 1e-6;
/// Lengths whose squares are normal doubles.
constexpr double kSmallestLength = 1e-150, kLargestLength = 1e150;

const char* const kForm = "write 'eye X Y Z target X Y Z', then 'up X Y Z' and 'fov DEGREES' if needed";

bool isFinite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool hasUsableLength(glm::dvec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest >= kSmallestLength && largest <= kLargestLength;
}

std::string vectorText(glm::dvec3 v) {
  return shortestNumber(v.x) + " " + shortestNumber(v.y) + " " + shortestNumber(v.z);
}

class CameraReader {
 public:
  CameraReader(const std::string& text, const std::string& where) : text_(text), where_(where), in_(text) {}

  Camera read() {
    Camera camera;
    std::set<std::string> seen;
    for (std::string word; in_ >> word;) {
      if (word == "eye")
        camera.eye = vector(word);
      else if (word == "target")
        camera.target = vector(word);
      else if (word == "up")
        camera.up = vector(word);
      else if (word == "fov")
        camera.verticalFovDeg = number(word);
      else
        throw refuse("'" + word + "' where eye, target, up or fov is expected");
      if (!seen.insert(word).second) throw refuse("'" + word + "' is given twice");
    }
    for (const char* needed : {"eye", "target"})
      if (!seen.count(needed)) throw refuse(std::string("'") + needed + "' is missing");
    return camera;
  }

 private:
  Error refuse(const std::string& what) const {
    return Error("camera '" + text_ + "': " + what, where_, kForm);
  }

  glm::dvec3 vector(const std::string& key) {
    const double x = number(key), y = number(key), z = number(key);
    return {x, y, z};
  }

  double number(const std::string& key) {
    std::string word;
    if (!(in_ >> word)) throw refuse("a number of '" + key + "' is missing");
    // std::from_chars takes no plus sign.
    std::string_view digits = word;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    double value = 0.0;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (result.ec == std::errc::result_out_of_range)
      throw refuse("'" + word + "' of '" + key + "' is beyond the range of numbers");
    if (result.ec != std::errc{} || result.ptr != digits.data() + digits.size())
      throw refuse("'" + word + "' of '" + key + "' is not a number" +
                   (word.find(',') != std::string::npos ? "; no commas" : ""));
    return value;
  }

  const std::string& text_;
  const std::string& where_;
  std::istringstream in_;
};

}  // namespace

void checkCamera(const Camera& camera, const std::string& where) {
  const auto refuse = [&](const std::string& what, const std::string& hint) {
    return Error("camera '" + toText(camera) + "': " + what, where, hint);
  };
  if (!isFinite(camera.eye) || !isFinite(camera.target) || !isFinite(camera.up) ||
      !std::isfinite(camera.verticalFovDeg))
    throw refuse("a value is not finite", "give numbers");
  if (!(camera.verticalFovDeg >= kSmallestFovDeg && camera.verticalFovDeg <= kLargestFovDeg))
    throw refuse("the field of view is " + shortestNumber(camera.verticalFovDeg) + " degrees",
                 "allowed: 0.01 to 179");
  const glm::dvec3 view = camera.target - camera.eye;
  if (view == glm::dvec3(0.0))
    throw refuse("eye and target are the same point", "move the target along the view direction");
  if (!hasUsableLength(view))
    throw refuse("eye and target are too near or too far apart", "allowed: 1e-150 to 1e150 world units");
  if (!hasUsableLength(camera.up))
    throw refuse("'up' has no usable length", "give a vector of about length 1");
  if (glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) < kSmallestUpSine)
    throw refuse("'up' is parallel to the view direction", "give an 'up' at an angle to it");
}

Camera parseCamera(const std::string& text, const std::string& where) {
  const Camera camera = CameraReader(text, where).read();
  checkCamera(camera, where);
  return camera;
}

std::string toText(const Camera& camera) {
  return "eye " + vectorText(camera.eye) + " target " + vectorText(camera.target) + " up " +
         vectorText(camera.up) + " fov " + shortestNumber(camera.verticalFovDeg);
}

}  // namespace limen::scene
