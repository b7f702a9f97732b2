// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/light_picture.h"

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/image_file.h"

namespace limen::scene {
namespace {

const char* const kValuesHint = "save it with values from 0 on that emit something";

double linearOf(double coded) {
  return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}

/// Pixels of a row or column that a cell covers, and how much of each.
struct Cover {
  int first = 0;
  std::vector<double> lengths;  // sum: size / cells
};

Cover coverOf(int cell, int cells, int size) {
  const double low = double(cell) * size / cells, high = double(cell + 1) * size / cells;
  Cover out;
  out.first = static_cast<int>(low);
  for (int i = out.first; i < size && i < high; ++i)
    out.lengths.push_back(std::min(high, i + 1.0) - std::max(low, double(i)));
  return out;
}

}  // namespace

Image readRadiance(const std::string& path) {
  const ImageFile file = readImageFile(path);
  const auto stored = static_cast<size_t>(file.image.channels);
  Image radiance(file.image.width, file.image.height, 3);
  bool emits = false;
  for (size_t i = 0; i < radiance.pixels(); ++i)
    for (size_t channel = 0; channel < 3; ++channel) {
      double value = file.image.data[i * stored + std::min(channel, stored - 1)];
      if (file.integer) value = linearOf(value);
      if (!file.alpha.data.empty() && !file.premultiplied) value *= file.alpha.data[i];
      if (!(value >= 0.0) || !std::isfinite(value))
        throw Error("a light cannot emit " + std::to_string(value) + ", the value of pixel " +
                        std::to_string(i % size_t(radiance.width)) + ", " +
                        std::to_string(i / size_t(radiance.width)),
                    path, kValuesHint);
      emits = emits || value > 0.0;
      radiance.data[3 * i + channel] = static_cast<float>(value);
    }
  if (!emits) throw Error("a light that shows this picture emits nothing: it is black", path, kValuesHint);
  return radiance;
}

std::vector<LightPart> pictureParts(const Image& radiance, int cells) {
  std::vector<Cover> columns, rows;
  for (int i = 0; i < cells; ++i) {
    columns.push_back(coverOf(i, cells, radiance.width));
    rows.push_back(coverOf(cells - 1 - i, cells, radiance.height));
  }
  const double cellArea = double(radiance.width) / cells * (double(radiance.height) / cells);
  std::vector<LightPart> parts;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const Cover &across = columns[size_t(i)], &along = rows[size_t(j)];
      glm::dvec3 sum(0.0);
      for (size_t y = 0; y < along.lengths.size(); ++y)
        for (size_t x = 0; x < across.lengths.size(); ++x)
          for (int channel = 0; channel < 3; ++channel)
            sum[channel] += along.lengths[y] * across.lengths[x] *
                            radiance.at(across.first + int(x), along.first + int(y), channel);
      if (sum == glm::dvec3(0.0)) continue;
      const glm::dvec2 low = glm::dvec2(i, j) / double(cells),
                       high = glm::dvec2(i + 1, j + 1) / double(cells);
      parts.push_back({{low, {high.x, low.y}, high, {low.x, high.y}}, glm::vec3(sum / cellArea)});
    }
  return parts;
}

}  // namespace limen::scene
