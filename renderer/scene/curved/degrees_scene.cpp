// SPDX-License-Identifier: BSD-3-Clause
// Patches of all degrees side by side, polynomial or rational, as they are or turned into the other kind
// (SC-01 to SC-03, SC-06).
#include <array>
#include <cmath>

#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/patch_convert.h"

namespace limen::scene {
namespace {

enum class Conversion { None, Triangles, Rectangles };
constexpr EnumNames<Conversion, 3> enumNames(Conversion) {
  return {{{{Conversion::None, "none"},
            {Conversion::Rectangles, "rectangles"},
            {Conversion::Triangles, "triangles"}}}};
}

struct DegreesSettings {
  Conversion conversion = Conversion::None;
  double weightRatio = 1.0;
  int64_t seed = 1;
  int tessellation = 8;
  static const SettingsTable<DegreesSettings>& table() {
    using S = DegreesSettings;
    static const SettingsTable<S> kTable = {
        {&S::conversion, "conversion",
         "Rectangles of degrees that sum to 9 at most become two triangles each, or triangles rectangles "
         "with a "
         "side collapsed to a point",
         "Schwarz 2009, section 6.1.2"},
        {&S::weightRatio, "weight_ratio", {1.0, 1e6}, "", "Largest over smallest weight of control points"},
        {&S::seed, "seed", {0, 1e9}, "", "Seed of heights and weights"},
        {&S::tessellation,
         "tessellation",
         {1, 32},
         "segments",
         "Segments along each side of a patch in the mesh"}};
    return kTable;
  }
};

constexpr double kDegreeCell = 0.24;

/// Control points over a net of a cell with random heights and weights.
class NetMaker {
 public:
  NetMaker(const DegreesSettings& settings, Random& random) : ratio_(settings.weightRatio), random_(random) {}
  glm::dvec4 point(glm::dvec3 corner, double x, double z) {
    const glm::dvec3 p = corner + kDegreeCell * glm::dvec3(0.85 * x, random_.uniform(0.0, 0.7), -0.85 * z);
    return surfaces::weighted(p, std::pow(ratio_, random_.uniform(-0.5, 0.5)));
  }

 private:
  double ratio_;
  Random& random_;
};

surfaces::PatchSet allDegrees(const DegreesSettings& settings) {
  Random random(settings.seed);
  NetMaker make(settings, random);
  surfaces::PatchSet set;
  for (int degree = 1; degree <= surfaces::kMaxDegree; ++degree) {
    const double left = kDegreeCell * (degree - 1 - 0.5 * surfaces::kMaxDegree);
    // Degrees (n, n), (n, 10 - n), (n, 9 - n) and, as triangles, n.
    const std::array<int, 3> others = {degree, 10 - degree, std::max(9 - degree, 1)};
    for (size_t row = 0; row < others.size(); ++row) {
      const int n = others[row];
      std::vector<glm::dvec4> net;
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= degree; ++i)
          net.push_back(
              make.point({left, 0.05, kDegreeCell * (1.0 - double(row))}, double(i) / degree, double(j) / n));
      surfaces::addRectangle(set, degree, n, net);
    }
    std::vector<glm::dvec4> net;
    for (int i = degree; i >= 0; --i)
      for (int k = 0; k <= degree - i; ++k)
        net.push_back(
            make.point({left, 0.05, 2.0 * kDegreeCell}, double(i) / degree, double(degree - i - k) / degree));
    surfaces::addTriangle(set, degree, net);
  }
  return set;
}

surfaces::PatchSet converted(const surfaces::PatchSet& set, Conversion conversion) {
  if (conversion == Conversion::None) return set;
  surfaces::PatchSet out;
  for (const surfaces::Patch& patch : set.patches) {
    const bool rectangle = patch.domain == surfaces::Domain::Rectangle;
    if (rectangle && conversion == Conversion::Triangles &&
        patch.degreeU + patch.degreeV <= surfaces::kMaxDegree) {
      rectangleAsTriangles(set, patch, out);
    } else if (!rectangle && conversion == Conversion::Rectangles) {
      triangleAsRectangle(set, patch, out);
    } else {
      surfaces::Patch same = patch;
      same.firstPoint = static_cast<uint32_t>(out.points.size());
      const auto first = set.points.begin() + patch.firstPoint;
      out.points.insert(out.points.end(), first, first + patch.points());
      out.patches.push_back(same);
    }
  }
  return out;
}

Scene buildDegrees(const DegreesSettings& settings) {
  Scene scene;
  addGround(scene, 10.0);
  addSurface(scene, "patches", converted(allDegrees(settings), settings.conversion), settings.tessellation,
             {0.64F, 0.6F, 0.52F});
  frameStanding(scene, 0.4, 1.1);
  setStillCamera(scene, orbitCamera({0.0, 0.1, 0.15}, 3.4, 8.0, 38.0));
  return scene;
}

const RegisteredScene<DegreesSettings> kDegrees{
    {.name = "curved/degrees",
     .version = 1,
     .summary = "Rectangles and triangles of degrees 1 to 9, polynomial or rational",
     .source = "Schwarz 2009, section 6.1"},
    buildDegrees};

}  // namespace
}  // namespace limen::scene
