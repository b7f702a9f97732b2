// SPDX-License-Identifier: BSD-3-Clause
#include "vectors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "perception/metrics/row_sums.h"

namespace limen::perception::cvvdp {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double texture(int x, int y, int c) {
  return 0.5 + 0.18 * std::sin(kTurn * (x / 37.0 + y / 91.0 + c / 3.0)) +
         0.12 * std::sin(kTurn * (x / 11.0 - y / 7.5)) + 0.08 * std::sin(kTurn * x * y / 997.0);
}

}  // namespace

std::vector<Row> readRows(const std::string& file) {
  const std::string path = LIMEN_SOURCE_DIR "/tests/perception/color_video_vdp/reference/" + file;
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read the reference values " + path);
  std::vector<Row> rows;
  std::vector<std::string> columns;
  std::string line;
  while (std::getline(in, line)) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    Row& row = rows.emplace_back();
    for (size_t i = 0; i < cells.size(); ++i) row[columns[i]] = cells[i];
  }
  return rows;
}

const Vector& vectorOf(const std::string& id) {
  static const std::vector<Vector> kVectors = readVectors();
  for (const Vector& v : kVectors)
    if (v.id == id) return v;
  throw std::out_of_range("no vector " + id);
}

std::vector<std::string> vectorIds(const std::set<std::string>& without) {
  std::vector<std::string> out;
  for (int i = 1; i <= 24; ++i) {
    std::string id = (i < 10 ? "A0" : "A") + std::to_string(i);
    if (!without.contains(id)) out.push_back(std::move(id));
  }
  return out;
}

double number(const Row& row, const std::string& column) { return std::stod(row.at(column)); }

std::vector<Vector> readVectors() {
  std::vector<Vector> out;
  for (const Row& row : readRows("vectors.csv")) {
    Vector& v = out.emplace_back();
    v.row = row;
    v.id = row.at("id");
    v.jod = number(row, "jod_f64");
    v.jodFixed = number(row, "jod_parity_fixed");
    v.difference = number(row, "q_f64");
    v.width_ = std::stoi(row.at("width")), v.height_ = std::stoi(row.at("height"));
    v.frames_ = std::stoi(row.at("frames"));
    v.options.display = readDisplay(row.at("display"));
    v.options.framesPerSecond = number(row, "fps");
    v.options.padding = fromText<TemporalPadding>(row.at("temp_padding"));
    v.options.codeSteps = row.at("storage") == "u8" ? 255.0 : 0.0;
    std::istringstream stream(row.at("params"));
    for (std::string item; std::getline(stream, item, ';');) {
      const size_t equals = item.find('=');
      const std::string name = item.substr(0, equals), text = item.substr(equals + 1);
      v.words_[name] = text;
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (*end == '\0') v.parameters_[name] = value;
    }
    if (!v.parameters_.contains("seed")) continue;
    auto state = static_cast<uint32_t>(v.value("seed"));
    const size_t frames = row.at("generator") == "noisevid" ? static_cast<size_t>(v.frames_) : 1;
    v.random_.resize(frames * static_cast<size_t>(v.width_) * static_cast<size_t>(v.height_) * 3);
    for (double& value : v.random_) {
      state = 1664525U * state + 1013904223U;
      value = std::floor(state / 256.0) / 16777216.0;
    }
  }
  return out;
}

double Vector::random(int frame, int x, int y, int c) const {
  return random_[static_cast<size_t>(((frame * height_ + y) * width_ + x) * 3 + c)];
}

double Vector::bar(int frame, double speed, int x) const {
  const double place = std::fmod(x - speed * frame, width_);
  return (place < 0.0 ? place + width_ : place) < value("w") ? value("hi") : value("lo");
}

double Vector::reference(int frame, int x, int y, int c) const {
  const std::string& generator = row.at("generator");
  if (generator == "uniform") return value("v");
  if (generator == "noise" || generator == "noisevid" || generator == "gain" || generator == "flicker")
    return value("o") + value("m") * texture(x, y, c);
  if (generator == "blur")
    return value("o") + value("m") * (words_.at("src") == "lcg" ? random(0, x, y, c) : texture(x, y, c));
  if (generator == "band") return (x + 0.5) / width_;
  if (generator == "bar") return bar(frame, value("v"), x);
  if (generator == "linear") return std::pow(10.0, value("lo") + value("m") * texture(x, y, c));
  if (generator == "checker") {
    const double n = value("n");
    const auto cell = static_cast<int64_t>(std::floor(x / n) + std::floor(y / n));
    return value("lo") + (value("hi") - value("lo")) * static_cast<double>(cell % 2);
  }
  return 0.0;
}

double Vector::sample(bool test, int frame, int x, int y, int c) const {
  const std::string& generator = row.at("generator");
  const auto colour = [&](const char* r, const char* g, const char* b) {
    return value(c == 0 ? r : c == 1 ? g : b);
  };
  if (generator == "grating") {
    const double s = value("s"), dx = x - (width_ - 1) / 2.0, dy = y - (height_ - 1) / 2.0;
    const double window = s == 0.0 ? 1.0 : std::exp(-(dx * dx + dy * dy) / (2.0 * s * s));
    const double wave = window * std::sin(kTurn * (value("fx") * x + value("fy") * y));
    return value("b") + value(test ? "a1" : "a0") * colour("kr", "kg", "kb") * wave;
  }
  if (!test) return reference(frame, x, y, c);
  if (generator == "uniform") return value("v") + colour("dr", "dg", "db");
  if (generator == "noise" || generator == "noisevid")
    return reference(frame, x, y, c) +
           value("amp") * (random(frame, x, y, value("mono") == 1.0 ? 0 : c) - 0.5);
  if (generator == "gain") return reference(frame, x, y, c) * colour("gr", "gg", "gb");
  if (generator == "checker") return reference(frame, x + static_cast<int>(value("dx")), y, c);
  if (generator == "band")
    return std::floor(reference(frame, x, y, c) * value("levels") + 0.5) / value("levels");
  if (generator == "bar") {
    if (words_.at("mode") != "hold") return bar(frame, value("v2"), x);
    const auto n = static_cast<int>(value("n"));
    return bar(n * (frame / n), value("v"), x);
  }
  if (generator == "flicker")
    return reference(frame, x, y, c) + value("a") * colour("kr", "kg", "kb") *
                                           std::sin(kTurn * value("f") * (frame + 0.5) / options.framesPerSecond);
  if (generator == "linear")
    return reference(frame, x, y, c) *
           (1.0 + value("a") * std::sin(kTurn * (value("fx") * x + value("fy") * y)));
  // Blur: mean of the window, coordinates clamped.
  const auto r = static_cast<int>(value("r"));
  double sum = 0.0;
  for (int dy = -r; dy <= r; ++dy)
    for (int dx = -r; dx <= r; ++dx)
      sum += reference(frame, std::clamp(x + dx, 0, width_ - 1), std::clamp(y + dy, 0, height_ - 1), c);
  return sum / ((2 * r + 1) * (2 * r + 1));
}

Image Vector::image(bool test, int frame) const {
  Image out(width_, height_, 3);
  const bool linear = row.at("generator") == "linear";
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      for (int c = 0; c < 3; ++c) {
        double value = sample(test, frame, x, y, c);
        if (!linear) value = std::clamp(value, 0.0, 1.0);
        if (options.codeSteps > 0.0) value = std::floor(options.codeSteps * value + 0.5) / options.codeSteps;
        out.at(x, y, c) = static_cast<float>(value);
      }
  return out;
}

Pair Vector::pair() const {
  return {width_, height_, frames_, [this](int frame) { return image(true, frame); },
          [this](int frame) { return image(false, frame); }};
}

double Vector::sumOf(bool test) const {
  CompensatedSum sum;
  for (int frame = 0; frame < frames_; ++frame)
    for (const float value : image(test, frame).data)
      sum.add(options.codeSteps > 0.0 ? std::round(value * options.codeSteps) : double{value});
  return sum.value();
}

}  // namespace limen::perception::cvvdp
