// SPDX-License-Identifier: BSD-3-Clause
// Metrics of the tessellated surface itself, against the patches that it stands for, in double precision. The
// thesis bounds its errors and looks at pictures; it measures none.
#include "perception/metrics/metric.h"
#include "renderer/surfaces/surface_errors.h"

namespace limen::techniques {
namespace {

using perception::ComparisonInput;
using perception::MetricResult;
using perception::RegisteredMetric;

struct SurfaceDeviationSettings {
  int steps = 8;
  int64_t samples = 200000;
  static const SettingsTable<SurfaceDeviationSettings>& table() {
    using S = SurfaceDeviationSettings;
    static const SettingsTable<S> kTable = {
        {&S::steps, "steps", {1, 64}, "", "Steps of the grid of sample points on each triangle"},
        {&S::samples,
         "samples",
         {1000, 100000000},
         "points",
         "Sample points at most; of more, triangles at regular intervals are taken"}};
    return kTable;
  }
};

void requireTessellation(const ComparisonInput& input) {
  if (!input.tessellation || !input.patches)
    throw Error("this metric needs a technique that tessellates curved surfaces", "metrics",
                "use it with techniques of tessellation/");
}

/// As they were when they were drawn.
const surfaces::PatchSet& patchesOf(const ComparisonInput& input) {
  return input.tessellation->moved ? *input.tessellation->moved : *input.patches;
}

MetricResult measureDeviation(const ComparisonInput& input, const SurfaceDeviationSettings& settings) {
  requireTessellation(input);
  const surfaces::Deviation found =
      surfaces::deviationOf(patchesOf(input), *input.tessellation, {settings.steps, settings.samples});
  surfaces::PatchSet const& set = patchesOf(input);
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec4& p : set.points)
    if (p.w != 0.0) low = glm::min(low, glm::dvec3(p) / p.w), high = glm::max(high, glm::dvec3(p) / p.w);
  const double diagonal = low.x < high.x ? glm::length(high - low) : 1.0;
  MetricResult out;
  out.value = found.atParametersPx.most;
  const auto add = [&](const surfaces::Spread& spread, double scale) {
    for (const double value : {spread.mean, spread.p99, spread.most}) out.figures.push_back(value * scale);
  };
  add(found.atParametersPx, 1.0);
  add(found.closestPx, 1.0);
  add(found.atParameters, 1.0 / diagonal);
  add(found.closest, 1.0 / diagonal);
  out.figures.push_back(static_cast<double>(found.samples));
  out.evaluatedPixels = found.samples;
  return out;
}

std::vector<Quantity> deviationFigures() {
  std::vector<Quantity> out;
  const auto add = [&](const std::string& name, const std::string& title, const std::string& unit) {
    for (const auto& [suffix, label] :
         {std::pair("mean", "mean"), {"p99", "99th percentile"}, {"max", "largest"}})
      out.emplace_back(name.empty() ? suffix : std::string(suffix) + "_" + name, title + ", " + label, unit,
                       Direction::LowerIsBetter);
  };
  add("px", "Deviation from the surface", "px");
  add("closest_px", "Deviation from the closest point", "px");
  add("of_diagonal", "Deviation from the surface over the diagonal", "");
  add("closest_of_diagonal", "Deviation from the closest point over the diagonal", "");
  out.emplace_back("samples", "Sample points", "points", Direction::Neither);
  return out;
}

MetricResult measureNormals(const ComparisonInput& input, const perception::NoMetricSettings&) {
  requireTessellation(input);
  const surfaces::Spread found = surfaces::normalErrors(patchesOf(input), *input.tessellation);
  MetricResult out;
  out.value = found.most;
  const surfaces::Spread bent =
      surfaces::normalErrors(patchesOf(input), *input.tessellation, surfaces::NormalsOf::Geometry);
  out.figures = {found.mean, found.p99, found.most, bent.mean, bent.p99, bent.most};
  out.evaluatedPixels = static_cast<int64_t>(input.tessellation->positions.size());
  return out;
}

MetricResult measureCracks(const ComparisonInput& input, const perception::NoMetricSettings&) {
  requireTessellation(input);
  const surfaces::Cracks found = surfaces::cracksOf(patchesOf(input), *input.tessellation);
  MetricResult out;
  out.value =
      static_cast<double>(found.unequalVertices + found.loneVertices + found.openEdges + found.foldOvers);
  out.figures = {double(found.unequalVertices), double(found.loneVertices), double(found.openEdges),
                 double(found.foldOvers),       double(found.sides),        double(found.openSides)};
  out.evaluatedPixels = found.sides;
  return out;
}

const RegisteredMetric<SurfaceDeviationSettings> kSurfaceDeviationRegistered{
    {.name = "surface_deviation",
     .summary = "distance between the tessellation and the surface, at equal parameters and to the closest "
                "point, in "
                "pixels at the surface's depth and as a share of its diagonal",
     .source = "bench",
     .title = "Deviation from the surface, largest",
     .unit = "px",
     .figures = deviationFigures(),
     .needsTessellation = true,
     .needsReference = false},
    &measureDeviation};

const RegisteredMetric<perception::NoMetricSettings> kSurfaceNormalsRegistered{
    {.name = "surface_normals",
     .version = 2,
     .summary = "angle between vertex normals and those that the surface is shaded with, and those of its "
                "derivatives (`geometry`)",
     .source = "bench",
     .title = "Error of vertex normals, largest",
     .unit = "degree",
     .figures = {{"mean", "Error of vertex normals, mean", "degree", Direction::LowerIsBetter},
                 {"p99", "Error of vertex normals, 99th percentile", "degree", Direction::LowerIsBetter},
                 {"max", "Error of vertex normals, largest", "degree", Direction::LowerIsBetter},
                 {"geometry_mean", "Angle to the geometry's normals, mean", "degree",
                  Direction::LowerIsBetter},
                 {"geometry_p99", "Angle to the geometry's normals, 99th percentile", "degree",
                  Direction::LowerIsBetter},
                 {"geometry_max", "Angle to the geometry's normals, largest", "degree",
                  Direction::LowerIsBetter}},
     .needsTessellation = true,
     .needsReference = false},
    &measureNormals};

const RegisteredMetric<perception::NoMetricSettings> kSurfaceCracksRegistered{
    {.name = "surface_cracks",
     .summary = "vertices of common sides that differ in any bit or have no partner, open edges, triangles "
                "turned over",
     .source = "bench",
     .title = "Cracks and fold-overs",
     .unit = "",
     .figures = {{"unequal", "Vertices of common sides that differ", "vertices", Direction::LowerIsBetter},
                 {"lone", "T-vertices", "vertices", Direction::LowerIsBetter},
                 {"open", "Open edges within patches", "edges", Direction::LowerIsBetter},
                 {"fold_overs", "Triangles turned over", "triangles", Direction::LowerIsBetter},
                 {"sides", "Common sides compared", "sides", Direction::Neither},
                 {"open_sides", "Sides without one partner", "sides", Direction::Neither}},
     .needsTessellation = true,
     .needsReference = false},
    &measureCracks};

}  // namespace
}  // namespace limen::techniques
