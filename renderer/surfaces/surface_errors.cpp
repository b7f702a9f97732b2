// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/surface_errors.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <thread>
#include <utility>

#include "renderer/surfaces/normal.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec3;

Spread spreadOf(std::vector<double>& values) {
  Spread out;
  if (values.empty()) return out;
  for (const double value : values) out.mean += value;
  out.mean /= static_cast<double>(values.size());
  const size_t rank = (values.size() * 99 + 99) / 100 - 1;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  out.p99 = values[rank];
  out.most = *std::max_element(values.begin(), values.end());
  return out;
}

DomainPoint interpolated(const DomainPoint& a, const DomainPoint& b, const DomainPoint& c, dvec3 w) {
  return {w.x * a.u + w.y * b.u + w.z * c.u, w.x * a.v + w.y * b.v + w.z * c.v,
          w.x * a.restU + w.y * b.restU + w.z * c.restU, w.x * a.restV + w.y * b.restV + w.z * c.restV};
}

DomainPoint within(Domain domain, dvec2 at) {
  at = glm::clamp(at, dvec2(0.0), dvec2(1.0));
  if (domain == Domain::Triangle && at.x + at.y > 1.0) at /= at.x + at.y;
  return domainPoint(domain, at.x, at.y);
}

/// Distance from q to the patch, by Gauss-Newton steps from `at`, each of which must bring it closer.
double closestDistance(const PatchSet& set, const Patch& patch, DomainPoint at, dvec3 q, double start) {
  double best = start;
  for (int step = 0; step < 4; ++step) {
    const SurfaceJet jet = evaluate(set, patch, at, Order::First);
    const dvec3 away = q - jet.p;
    const double uu = glm::dot(jet.u, jet.u), uv = glm::dot(jet.u, jet.v), vv = glm::dot(jet.v, jet.v);
    const double det = uu * vv - uv * uv;
    const dvec2 right(glm::dot(jet.u, away), glm::dot(jet.v, away));
    dvec2 move;
    if (det > 1e-12 * uu * vv) {
      move = dvec2(vv * right.x - uv * right.y, uu * right.y - uv * right.x) / det;
    } else {
      move = dvec2(uu > 0.0 ? right.x / uu : 0.0, vv > 0.0 ? right.y / vv : 0.0);
    }
    at = within(patch.domain, dvec2(at.u, at.v) + move);
    const double distance = glm::length(evaluate(set, patch, at, Order::Position).p - q);
    if (!(distance < best)) break;
    best = distance;
  }
  return best;
}

struct Samples {
  std::vector<double> atParameters, closest, atParametersPx, closestPx;
};

void sampleTriangle(const PatchSet& set, const TessellatedSurface& surface, const glm::uvec3& t, int steps,
                    Samples& out) {
  const Patch& patch = set.patches[surface.patches[t.x]];
  const SurfaceView& view = surface.view;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      const dvec3 w(double(i) / steps, double(j) / steps, double(steps - i - j) / steps);
      const DomainPoint at =
          interpolated(surface.parameters[t.x], surface.parameters[t.y], surface.parameters[t.z], w);
      const dvec3 drawn = surface.anchor + w.x * dvec3(surface.positions[t.x]) +
                          w.y * dvec3(surface.positions[t.y]) + w.z * dvec3(surface.positions[t.z]);
      const dvec3 exact = evaluate(set, patch, at, Order::Position).p;
      const double distance = glm::length(drawn - exact);
      const double closest = closestDistance(set, patch, at, drawn, distance);
      out.atParameters.push_back(distance);
      out.closest.push_back(closest);
      const dvec3 seen = exact - view.eye;
      const double depth = glm::dot(seen, view.forward);
      if (!(depth > 0.0) || std::abs(glm::dot(seen, view.right)) > view.tanHalf.x * depth ||
          std::abs(glm::dot(seen, view.up)) > view.tanHalf.y * depth)
        continue;
      const double px = view.pxAtDistance / std::max(depth, view.nearest);
      out.atParametersPx.push_back(distance * px);
      out.closestPx.push_back(closest * px);
    }
}

/// work(thread, first, last) on all cores.
template <class Work>
void onAllCores(size_t count, const Work& work) {
  const size_t threads = std::max<size_t>(std::thread::hardware_concurrency(), 1);
  std::vector<std::jthread> helpers;
  for (size_t thread = 1; thread < threads; ++thread)
    helpers.emplace_back(
        [&, thread] { work(thread, count * thread / threads, count * (thread + 1) / threads); });
  work(0, 0, count / threads);
}

size_t coreCount() { return std::max<size_t>(std::thread::hardware_concurrency(), 1); }

void append(std::vector<double>& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Vertices of a patch on a side, by their place along it.
using SideVertices = std::map<double, glm::vec3>;

}  // namespace

Deviation deviationOf(const PatchSet& set, const TessellatedSurface& tessellation,
                      const DeviationSettings& settings) {
  const int64_t each = int64_t{settings.steps + 1} * (settings.steps + 2) / 2;
  const size_t count = tessellation.triangles.size();
  const size_t taken = std::min(count, static_cast<size_t>(std::max<int64_t>(settings.samples / each, 1)));
  std::vector<Samples> parts(coreCount());
  onAllCores(taken, [&](size_t thread, size_t first, size_t last) {
    for (size_t i = first; i < last; ++i)
      sampleTriangle(set, tessellation, tessellation.triangles[i * count / taken], settings.steps,
                     parts[thread]);
  });
  Samples all;
  for (const Samples& part : parts) {
    append(all.atParameters, part.atParameters);
    append(all.closest, part.closest);
    append(all.atParametersPx, part.atParametersPx);
    append(all.closestPx, part.closestPx);
  }
  Deviation out;
  out.samples = static_cast<int64_t>(all.atParameters.size());
  out.samplesInView = static_cast<int64_t>(all.atParametersPx.size());
  out.atParameters = spreadOf(all.atParameters);
  out.closest = spreadOf(all.closest);
  out.atParametersPx = spreadOf(all.atParametersPx);
  out.closestPx = spreadOf(all.closestPx);
  return out;
}

Spread normalErrors(const PatchSet& set, const TessellatedSurface& tessellation, NormalsOf of) {
  std::vector<std::vector<double>> parts(coreCount());
  onAllCores(tessellation.positions.size(), [&](size_t thread, size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      Patch patch = set.patches[tessellation.patches[i]];
      if (of == NormalsOf::Geometry) patch.normalDegree = 0;
      const SurfaceNormal exact = normalAt(set, patch, tessellation.parameters[i]);
      if (exact.rung == NormalRung::None) continue;
      const dvec3 drawn(tessellation.normals[i]);
      // Stable for small angles, unlike the arc cosine.
      parts[thread].push_back(glm::degrees(
          std::atan2(glm::length(glm::cross(drawn, exact.direction)), glm::dot(drawn, exact.direction))));
    }
  });
  std::vector<double> all;
  for (const std::vector<double>& part : parts) append(all, part);
  return spreadOf(all);
}

Cracks cracksOf(const PatchSet& set, const TessellatedSurface& tessellation) {
  Cracks out;
  std::vector<std::array<SideVertices, 4>> sides(set.patches.size());
  for (size_t i = 0; i < tessellation.positions.size(); ++i) {
    const uint32_t number = tessellation.patches[i];
    const DomainPoint& at = tessellation.parameters[i];
    const glm::vec3 position = tessellation.positions[i];
    // Along the side from its first corner, as the smaller of the two rounded ways to say it.
    const auto add = [&](size_t side, double t) { sides[number][side].emplace(t, position); };
    if (set.patches[number].domain == Domain::Rectangle) {
      if (at.v == 0.0) add(0, at.u);
      if (at.restU == 0.0) add(1, at.v);
      if (at.restV == 0.0) add(2, at.restU);
      if (at.u == 0.0) add(3, at.restV);
    } else {
      if (at.w() == 0.0) add(0, at.v);
      if (at.u == 0.0) add(1, at.w());
      if (at.v == 0.0) add(2, at.u);
    }
  }
  for (size_t i = 0; i < set.patches.size() && i < set.neighbours.size(); ++i)
    for (size_t side = 0; side < static_cast<size_t>(sidesOf(set.patches[i].domain)); ++side) {
      const Neighbour& neighbour = set.neighbours[i][side];
      if (neighbour.patch < 0) {
        out.openSides += !sides[i][side].empty() && !isCollapsed(set, set.patches[i], static_cast<int>(side));
        continue;
      }
      if (neighbour.patch < static_cast<int32_t>(i)) continue;  // compared from the other patch
      const SideVertices &mine = sides[i][side],
                         &theirs =
                             sides[static_cast<size_t>(neighbour.patch)][static_cast<size_t>(neighbour.side)];
      if (mine.empty() || theirs.empty()) continue;
      ++out.sides;
      // Places agree to rounding: 1 - t and (n - i) / n may differ in the last bit.
      const auto near = [](const SideVertices& in, double t) {
        const auto found = in.lower_bound(t - 1e-9);
        return found != in.end() && found->first <= t + 1e-9 ? &found->second : nullptr;
      };
      size_t met = 0;
      for (const auto& [t, position] : mine) {
        const glm::vec3* other = near(theirs, neighbour.reversed ? 1.0 - t : t);
        if (!other) {
          ++out.loneVertices;
          continue;
        }
        ++met;
        if (std::memcmp(other, &position, sizeof(position)) != 0) ++out.unequalVertices;
      }
      out.loneVertices += static_cast<int64_t>(theirs.size()) - static_cast<int64_t>(met);
    }
  // Edges by place, so that it does not matter whether triangles share vertices.
  using Place = std::pair<uint32_t, std::pair<double, double>>;
  std::map<std::pair<Place, Place>, int> edges;
  const auto place = [&](uint32_t vertex) {
    const DomainPoint& at = tessellation.parameters[vertex];
    return Place{tessellation.patches[vertex], {at.u, at.v}};
  };
  const auto onOneSide = [&](uint32_t a, uint32_t b) {
    const DomainPoint &p = tessellation.parameters[a], &q = tessellation.parameters[b];
    const bool rectangle = set.patches[tessellation.patches[a]].domain == Domain::Rectangle;
    return (p.u == 0.0 && q.u == 0.0) || (p.v == 0.0 && q.v == 0.0) || (p.restU == 0.0 && q.restU == 0.0) ||
           (rectangle && p.restV == 0.0 && q.restV == 0.0);
  };
  for (const glm::uvec3& t : tessellation.triangles) {
    const DomainPoint &a = tessellation.parameters[t.x], &b = tessellation.parameters[t.y],
                      &c = tessellation.parameters[t.z];
    if (!((b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u) > 0.0)) ++out.foldOvers;
    for (int i = 0; i < 3; ++i) {
      const uint32_t from = t[i], to = t[(i + 1) % 3];
      if (onOneSide(from, to)) continue;
      const auto opposite = edges.find({place(to), place(from)});
      if (opposite != edges.end() && opposite->second > 0) {
        if (--opposite->second == 0) edges.erase(opposite);
      } else {
        ++edges[{place(from), place(to)}];
      }
    }
  }
  for (const auto& [edge, count] : edges) out.openEdges += count;
  return out;
}

}  // namespace limen::surfaces
