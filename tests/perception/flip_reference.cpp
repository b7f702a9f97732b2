// SPDX-License-Identifier: BSD-3-Clause
#include "flip_reference.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

namespace limen::perception {
namespace {

constexpr double kPi = std::numbers::pi;

struct Plane {
  int width, height;
  std::vector<double> data;
  double at(int x, int y) const {  // the image goes on as its edge
    x = std::clamp(x, 0, width - 1), y = std::clamp(y, 0, height - 1);
    return data[static_cast<size_t>(y) * width + x];
  }
};

struct Kernel {
  int radius;
  std::vector<double> data;
  double& at(int x, int y) { return data[static_cast<size_t>((y + radius) * (2 * radius + 1) + x + radius)]; }
};

Kernel makeKernel(int radius, const std::function<double(int, int)>& value) {
  Kernel kernel{radius, std::vector<double>(static_cast<size_t>((2 * radius + 1) * (2 * radius + 1)))};
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x) kernel.at(x, y) = value(x, y);
  return kernel;
}

Plane convolve(const Plane& plane, Kernel kernel) {
  Plane out{plane.width, plane.height, {}};
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      double sum = 0.0;
      for (int j = -kernel.radius; j <= kernel.radius; ++j)
        for (int i = -kernel.radius; i <= kernel.radius; ++i) sum += kernel.at(i, j) * plane.at(x + i, y + j);
      out.data.push_back(sum);
    }
  return out;
}

Kernel sensitivityKernel(double ppd, double a1, double b1, double a2, double b2) {
  const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * kPi * kPi)) * ppd));
  Kernel kernel = makeKernel(radius, [&](int x, int y) {
    const double squared = (x * x + y * y) / (ppd * ppd);
    return a1 * std::sqrt(kPi / b1) * std::exp(-kPi * kPi * squared / b1) +
           a2 * std::sqrt(kPi / b2) * std::exp(-kPi * kPi * squared / b2);
  });
  double sum = 0.0;
  for (const double value : kernel.data) sum += value;
  for (double& value : kernel.data) value /= sum;
  return kernel;
}

Kernel featureKernel(double ppd, bool edge, bool alongX) {
  const double sd = 0.5 * 0.082 * ppd;
  Kernel kernel = makeKernel(static_cast<int>(std::ceil(3.0 * sd)), [&](int x, int y) {
    const double g = std::exp(-(x * x + y * y) / (2.0 * sd * sd));
    const double along = alongX ? x : y;
    return edge ? -along * g : (along * along / (sd * sd) - 1.0) * g;
  });
  double positive = 0.0, negative = 0.0;
  for (const double value : kernel.data) (value > 0.0 ? positive : negative) += value;
  for (double& value : kernel.data)
    if (value != 0.0) value /= value > 0.0 ? positive : -negative;
  return kernel;
}

const glm::dvec3 kWhite(0.950428545, 1.0, 1.088900371);

glm::dmat3 xyzFromRgb() {
  return glm::transpose(glm::dmat3(10135552.0 / 24577794.0, 8788810.0 / 24577794.0,
                                   4435075.0 / 24577794.0,                                                 //
                                   2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0,  //
                                   1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0));
}

glm::dvec3 toHuntLab(glm::dvec3 rgb) {
  const glm::dvec3 xyz = xyzFromRgb() * rgb / kWhite;
  const auto f = [](double t) {
    const double d = 6.0 / 29.0;
    return t > d * d * d ? std::cbrt(t) : t / (3.0 * d * d) + 4.0 / 29.0;
  };
  const double l = 116.0 * f(xyz.y) - 16.0;
  return {l, 0.01 * l * 500.0 * (f(xyz.x) - f(xyz.y)), 0.01 * l * 200.0 * (f(xyz.y) - f(xyz.z))};
}

double hyab(glm::dvec3 a, glm::dvec3 b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

/// What of an image is compared.
struct Seen {
  std::vector<glm::dvec3> lab;
  std::vector<double> edge, point;
};

Seen see(const Image& image, double ppd) {
  Plane y{image.width, image.height, {}}, cx = y, cz = y, luminance = y;
  for (size_t i = 0; i < image.pixels(); ++i) {
    const glm::dvec3 rgb(image.data[3 * i], image.data[3 * i + 1], image.data[3 * i + 2]);
    const glm::dvec3 xyz = xyzFromRgb() * rgb / kWhite;
    y.data.push_back(116.0 * xyz.y - 16.0);
    cx.data.push_back(500.0 * (xyz.x - xyz.y));
    cz.data.push_back(200.0 * (xyz.y - xyz.z));
    luminance.data.push_back(xyz.y);
  }
  y = convolve(y, sensitivityKernel(ppd, 1.0, 0.0047, 0.0, 1e-5));
  cx = convolve(cx, sensitivityKernel(ppd, 1.0, 0.0053, 0.0, 1e-5));
  cz = convolve(cz, sensitivityKernel(ppd, 34.1, 0.04, 13.5, 0.025));
  Seen seen;
  const glm::dmat3 rgbFromXyz = glm::inverse(xyzFromRgb());
  for (size_t i = 0; i < image.pixels(); ++i) {
    const double fy = (y.data[i] + 16.0) / 116.0;
    const glm::dvec3 xyz = glm::dvec3(fy + cx.data[i] / 500.0, fy, fy - cz.data[i] / 200.0) * kWhite;
    seen.lab.push_back(toHuntLab(glm::clamp(rgbFromXyz * xyz, 0.0, 1.0)));
  }
  const auto strength = [&](bool edge) {
    const Plane x = convolve(luminance, featureKernel(ppd, edge, true));
    const Plane yy = convolve(luminance, featureKernel(ppd, edge, false));
    std::vector<double> out;
    for (size_t i = 0; i < x.data.size(); ++i) out.push_back(std::hypot(x.data[i], yy.data[i]));
    return out;
  };
  seen.edge = strength(true);
  seen.point = strength(false);
  return seen;
}

}  // namespace

FlipReference computeFlipReference(const Image& test, const Image& reference, double ppd) {
  const Seen t = see(test, ppd), r = see(reference, ppd);
  const double largest = std::pow(hyab(toHuntLab({0.0, 1.0, 0.0}), toHuntLab({0.0, 0.0, 1.0})), 0.7);
  FlipReference out{Image(test.width, test.height, 1), 0.0};
  for (size_t i = 0; i < test.pixels(); ++i) {
    const double raised = std::pow(hyab(t.lab[i], r.lab[i]), 0.7);
    const double knee = 0.4 * largest;
    const double colour =
        raised < knee ? 0.95 / knee * raised : 0.95 + 0.05 * (raised - knee) / (largest - knee);
    const double feature = std::sqrt(
        std::max(std::abs(t.edge[i] - r.edge[i]), std::abs(t.point[i] - r.point[i])) / std::sqrt(2.0));
    const double flip = std::pow(colour, 1.0 - feature);
    out.map.data[i] = static_cast<float>(flip);
    out.mean += flip / static_cast<double>(test.pixels());
  }
  return out;
}

}  // namespace limen::perception
