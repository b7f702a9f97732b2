// SPDX-License-Identifier: BSD-3-Clause
// Share of the light's area that no triangle hides, in closed form: beam tracing from every surface point.
// Seen from p, a triangle hides those points of the light's plane that lie within three planes through p and
// one edge each, and beyond the triangle's own plane. All four bounds are straight lines on the light, also
// for triangles that cross the light's plane or the plane through p parallel to it, so no clipping in depth
// is needed. The light is stored as disjoint convex pieces from which each such region is removed; overlaps
// cost nothing and are not counted twice.
#include <atomic>
#include <cmath>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/references/convex_pieces.h"
#include "renderer/references/light_shape.h"
#include "renderer/references/parallel.h"
#include "renderer/references/receiver_points.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

using techniques::Counter;

constexpr const char* kUnionName = "soft_shadows/exact_union";

/// Light-space box of some triangles.
struct Box {
  glm::dvec3 low{1e300}, high{-1e300};
  void extend(glm::dvec3 p) { low = glm::min(low, p), high = glm::max(high, p); }
};

/// The light's shape in light-plane coordinates scaled so that its bounding rectangle is [-1, 1]^2; an affine
/// map keeps shares of area, and an elliptic light becomes the unit disc.
class UnitLight {
 public:
  explicit UnitLight(const scene::AreaLight& light) : disc_(light.shape == scene::LightShape::Disc) {
    if (light.shape == scene::LightShape::Polygon)
      for (const Triangle2& t : triangulate(light.outline))
        pieces_.push_back({2.0 * t[0] - 1.0, 2.0 * t[1] - 1.0, 2.0 * t[2] - 1.0});
    else
      pieces_.push_back({{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}});
    total_ = area(pieces_);
  }
  const std::vector<ConvexPolygon>& pieces() const { return pieces_; }
  double share(const std::vector<ConvexPolygon>& pieces) const { return area(pieces) / total_; }

 private:
  double area(const std::vector<ConvexPolygon>& pieces) const {
    double sum = 0.0;
    for (const ConvexPolygon& piece : pieces) sum += disc_ ? piece.areaInUnitDisc() : piece.area();
    return sum;
  }
  bool disc_;
  std::vector<ConvexPolygon> pieces_;
  double total_ = 0.0;
};

/// Adds a bound to the region; false if it excludes the whole square. n.(l - p) >= offset becomes a line on
/// the light.
bool bound(ConvexRegion& region, glm::dvec3 n, glm::dvec3 p, double offset, glm::dvec2 halfSize) {
  const glm::dvec2 line(n.x * halfSize.x, n.y * halfSize.y);
  const double constant = -glm::dot(n, p) - offset, length = glm::length(line);
  // No point of the square is farther than sqrt 2 from its centre.
  if (constant >= 1.5 * length) return true;
  if (constant <= -1.5 * length) return false;
  region.planes[static_cast<size_t>(region.count++)] = {line / length, constant / length};
  return true;
}

struct ExactUnionSettings {
  int64_t maxTriangles = 20000;
  static const SettingsTable<ExactUnionSettings>& table() {
    static const SettingsTable<ExactUnionSettings> kTable = {
        {&ExactUnionSettings::maxTriangles,
         "max_triangles",
         {1, 10000000},
         "triangles",
         "Scenes with more triangles are refused: time grows with triangles times pixels"}};
    return kTable;
  }
};

class ExactUnion : public techniques::Technique {
 public:
  using Settings = ExactUnionSettings;
  explicit ExactUnion(const ExactUnionSettings& settings) : maxTriangles_(settings.maxTriangles) {}

  void prepare(frame::Frame& frame) override {
    triangles_.emplace(frame.scene(), frame.gpuScene().anchor());
    if (static_cast<int64_t>(triangles_->count()) > maxTriangles_)
      throw Error("the scene has " + std::to_string(triangles_->count()) +
                      " triangles, more than 'max_triangles' (" + std::to_string(maxTriangles_) + ")",
                  kUnionName,
                  "raise it (time grows with triangles times pixels) or use soft_shadows/ray_traced");
    const glm::dmat4 toLight = frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor());
    for (size_t i = 0; i < triangles_->count(); ++i) {
      if (i % kGroup == 0) groups_.emplace_back();
      boxes_.emplace_back();
      for (int k = 0; k < 3; ++k) {
        corners_.emplace_back(toLight * glm::dvec4(triangles_->corner(i, k), 1.0));
        boxes_.back().extend(corners_.back()), groups_.back().extend(corners_.back());
      }
    }
    product_.emplace(gl::Format::R32F, frame.sizePx());
    visibility_ = Image(frame.sizePx().x, frame.sizePx().y, 1);
    frame.passes().setBytesHeld("exact_union/upload", product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const std::vector<ReceiverPoint> points = readReceiverPoints(frame, *triangles_);
    {
      const auto scope = frame.passes().open("exact_union/union");
      unite(frame, points);
    }
    const auto scope = frame.passes().open("exact_union/upload");
    product_->write(visibility_);
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"occluders_per_receiver", occludersPerReceiver_}};
  }

 private:
  static constexpr size_t kGroup = 32;

  void unite(const frame::Frame& frame, const std::vector<ReceiverPoint>& points) {
    const scene::AreaLight& light = frame.scene().lights.at(0);
    const glm::dmat4 toLight = light.toLightSpace(frame.gpuScene().anchor());
    const UnitLight unit(light);
    std::fill(visibility_.data.begin(), visibility_.data.end(), 1.0F);
    std::atomic<int64_t> occluders = 0;
    parallelFor(points.size(), [&](size_t, size_t first, size_t last) {
      std::vector<ConvexRegion> regions;
      for (size_t i = first; i < last; ++i) {
        const ReceiverPoint& point = points[i];
        const glm::dvec3 p(toLight * glm::dvec4(point.position, 1.0)),
            normal(toLight * glm::dvec4(point.normal, 0.0));
        findOccluders(p, point.triangle, 0.5 * light.size, regions);
        occluders += static_cast<int64_t>(regions.size());
        visibility_.data[point.pixel] = static_cast<float>(share(unit, p, normal, 0.5 * light.size, regions));
      }
    });
    occludersPerReceiver_ = points.empty() ? 0.0 : double(occluders) / double(points.size());
  }

  static double share(const UnitLight& unit, glm::dvec3 p, glm::dvec3 normal, glm::dvec2 halfSize,
                      std::vector<ConvexRegion>& regions) {
    // A surface is opaque: what lies behind its plane is hidden, whether or not the body is closed.
    ConvexRegion behind;
    behind.low = glm::dvec2(-2.0), behind.high = glm::dvec2(2.0);
    ConvexPieces visible(unit.pieces());
    if (bound(behind, -normal, p, 0.0, halfSize)) visible.subtract(behind);
    // Large regions first: they remove what many small ones would otherwise have to be cut from.
    std::sort(regions.begin(), regions.end(),
              [](const ConvexRegion& a, const ConvexRegion& b) { return a.area > b.area; });
    for (const ConvexRegion& region : regions) {
      if (visible.empty()) break;
      visible.subtract(region);
    }
    return glm::clamp(unit.share(visible.pieces()), 0.0, 1.0);
  }

  void findOccluders(glm::dvec3 p, uint32_t own, glm::dvec2 halfSize,
                     std::vector<ConvexRegion>& regions) const {
    regions.clear();
    const glm::dvec2 low = glm::min(glm::dvec2(p), -halfSize), high = glm::max(glm::dvec2(p), halfSize);
    const auto apart = [&](const Box& box) {
      return box.low.x > high.x || box.high.x < low.x || box.low.y > high.y || box.high.y < low.y ||
             box.low.z > p.z || box.high.z < 0.0;
    };
    for (size_t group = 0; group < groups_.size(); ++group) {
      if (apart(groups_[group])) continue;
      for (size_t i = group * kGroup; i < std::min((group + 1) * kGroup, boxes_.size()); ++i) {
        ConvexRegion region;
        if (i != own && !apart(boxes_[i]) && makeRegion(p, i, halfSize, region)) regions.push_back(region);
      }
    }
  }

  /// False if the triangle hides nothing of the light's bounding rectangle from p.
  bool makeRegion(glm::dvec3 p, size_t triangle, glm::dvec2 halfSize, ConvexRegion& region) const {
    const glm::dvec3 a = corners_[3 * triangle] - p, b = corners_[3 * triangle + 1] - p,
                     c = corners_[3 * triangle + 2] - p;
    glm::dvec3 n = glm::cross(b - a, c - a);
    double height = glm::dot(n, a);  // of the triangle's plane over p, times |n|
    const double tolerance = triangles_->planeTolerance();
    if (!(height * height > tolerance * tolerance * glm::dot(n, n)))
      return false;  // edge-on, degenerate or NaN
    const double side = height > 0.0 ? 1.0 : -1.0;
    n *= side, height *= side;
    if (!bound(region, n * (1.0 - kLightMargin), p, height, halfSize) ||
        !bound(region, side * glm::cross(a, b), p, 0.0, halfSize) ||
        !bound(region, side * glm::cross(b, c), p, 0.0, halfSize) ||
        !bound(region, side * glm::cross(c, a), p, 0.0, halfSize))
      return false;
    ConvexPolygon covered = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}, inside, outside;
    for (int i = 0; i < region.count && !covered.empty(); ++i) {
      split(covered, region.planes[static_cast<size_t>(i)], inside, outside);
      covered = inside;
    }
    region.area = covered.area();
    if (covered.empty() || region.area <= 0.0) return false;
    region.low = region.high = covered[0];
    for (int i = 1; i < covered.size(); ++i)
      region.low = glm::min(region.low, covered[i]), region.high = glm::max(region.high, covered[i]);
    return true;
  }

  int64_t maxTriangles_;
  std::optional<Triangles> triangles_;
  std::vector<glm::dvec3> corners_;  // three a triangle, light space
  std::vector<Box> boxes_, groups_;  // of each triangle, of each kGroup triangles
  std::optional<gl::Texture> product_;
  Image visibility_;
  double occludersPerReceiver_ = 0.0;
};

const techniques::RegisteredTechnique<ExactUnion> kExactUnionRegistered{
    {.name = kUnionName,
     .version = 1,
     .summary = "Exact visible area of the light: union of all triangles' projections, double precision",
     .source = "Schwarz 2009, section 3.3 (beam tracing)",
     .needs = {"area_light"},
     .reference = true,
     .onCpu = true,
     .counters = {
         {"occluders_per_receiver", "Occluding triangles per receiver", "", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::references
