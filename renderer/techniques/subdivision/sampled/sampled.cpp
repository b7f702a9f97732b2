// SPDX-License-Identifier: BSD-3-Clause
// Limit points of subdivision surfaces on the CPU, in double precision, at even grids of each face: by steps
// of subdivision and limit masks (SC-19), by tabulated weights (SC-20), or by direct evaluation after Stam
// (SC-21). Schwarz 2009, section 6.1.5. Vertices are made once, and drawn in each frame.
#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/catmull_clark_masks.h"
#include "renderer/surfaces/catmull_clark_point.h"
#include "renderer/surfaces/loop_point.h"
#include "renderer/surfaces/loop_subdivision.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_vertex_array.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

enum class LimitMethod { Steps, Tables, Direct };
constexpr EnumNames<LimitMethod, 3> enumNames(LimitMethod) {
  return {
      {{{LimitMethod::Direct, "direct"}, {LimitMethod::Steps, "steps"}, {LimitMethod::Tables, "tables"}}}};
}

enum class LimitScheme { CatmullClark, Loop };
constexpr EnumNames<LimitScheme, 2> enumNames(LimitScheme) {
  return {{{{LimitScheme::CatmullClark, "catmull_clark"}, {LimitScheme::Loop, "loop"}}}};
}

struct SampledSettings {
  LimitScheme scheme = LimitScheme::CatmullClark;
  LimitMethod method = LimitMethod::Steps;
  int levels = 3;
  frame::ShadedSetting shading;
  static const SettingsTable<SampledSettings>& table() {
    using S = SampledSettings;
    static const SettingsTable<S> kTable = {
        {&S::scheme, "scheme",
         "Of quads, or of triangles, into which quads are then cut along their first diagonal",
         "Schwarz 2009, section 6.1.5"},
        {&S::method, "method",
         "Steps of subdivision and limit masks, weights tabulated for each kind of surroundings, or direct "
         "evaluation at each sample",
         "Schwarz 2009, section 6.1.5"},
        {&S::levels, "levels", {0, 6}, "steps", "Each face gets two to this power segments along its sides"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
  void check() const {
    if (scheme == LimitScheme::Loop && method == LimitMethod::Tables)
      throw Error("weights are tabulated of Catmull-Clark's surfaces alone", "method", "use steps or direct");
  }
};

/// A vertex and where it lies on which face of the cage.
struct LimitSample {
  glm::dvec3 position{0.0}, normal{0.0};
  uint32_t face = 0;
  glm::dvec2 at{0.0};
};

/// Vertices, of which each face has its own, and triangles.
struct LimitMesh {
  std::vector<LimitSample> samples;
  std::vector<uint32_t> indices;
};

/// Corners of fine faces in the parameters of the cage's, by the order in which steps number faces.
template <size_t kCorners>
using FaceCorners = std::vector<std::pair<uint32_t, std::array<glm::dvec2, kCorners>>>;

FaceCorners<4> quadCorners(size_t faces, int levels) {
  FaceCorners<4> out;
  for (uint32_t f = 0; f < faces; ++f) out.push_back({f, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}});
  for (int level = 0; level < levels; ++level) {
    FaceCorners<4> next;
    for (const auto& [face, c] : out)
      for (size_t i = 0; i < 4; ++i)
        next.push_back({face,
                        {{c[i], 0.5 * (c[i] + c[(i + 1) % 4]), 0.25 * (c[0] + c[1] + c[2] + c[3]),
                          0.5 * (c[i] + c[(i + 3) % 4])}}});
    out = std::move(next);
  }
  return out;
}

/// Weights of the first and second vertex.
FaceCorners<3> triangleCorners(size_t faces, int levels) {
  FaceCorners<3> out;
  for (uint32_t f = 0; f < faces; ++f) out.push_back({f, {{{1, 0}, {0, 1}, {0, 0}}}});
  for (int level = 0; level < levels; ++level) {
    FaceCorners<3> next;
    for (const auto& [face, c] : out) {
      const std::array<glm::dvec2, 3> middles = {0.5 * (c[0] + c[1]), 0.5 * (c[1] + c[2]),
                                                 0.5 * (c[2] + c[0])};
      for (size_t i = 0; i < 3; ++i) next.push_back({face, {{c[i], middles[i], middles[(i + 2) % 3]}}});
      next.push_back({face, middles});
    }
    out = std::move(next);
  }
  return out;
}

/// Faces of the finest mesh, each with its own vertices.
template <size_t kCorners, class Limit>
LimitMesh meshOf(const surfaces::PolygonMesh& fine, const Limit& limit,
                 const FaceCorners<kCorners>& corners) {
  LimitMesh out;
  for (size_t f = 0; f < fine.faces.size(); ++f) {
    const auto first = static_cast<uint32_t>(out.samples.size());
    for (size_t k = 0; k < kCorners; ++k)
      out.samples.push_back(
          {limit.points[fine.faces[f][k]], limit.normals[f][k], corners[f].first, corners[f].second[k]});
    for (uint32_t k = 1; k + 1 < kCorners; ++k)
      out.indices.insert(out.indices.end(), {first, first + k, first + k + 1});
  }
  return out;
}

/// From the differences of a grid; zero where there are none.
glm::dvec3 gridNormal(const std::vector<glm::dvec3>& grid, int n, int i, int j) {
  const auto at = [&](int x, int y) {
    return grid[static_cast<size_t>(std::clamp(x, 0, n) + (n + 1) * std::clamp(y, 0, n))];
  };
  const glm::dvec3 normal = glm::cross(at(i + 1, j) - at(i - 1, j), at(i, j + 1) - at(i, j - 1));
  const double length = glm::length(normal);
  return length > 0.0 ? normal / length : glm::dvec3(0.0);
}

LimitMesh gridsOf(const surfaces::PolygonMesh& cage, const SampledSettings& settings, size_t& tables) {
  const int n = 1 << settings.levels;
  const bool direct = settings.method == LimitMethod::Direct;
  const surfaces::MeshTopology topology(cage);
  surfaces::CatmullClarkMasks masks(n);
  LimitMesh out;
  for (uint32_t f = 0; f < cage.faces.size(); ++f) {
    const auto first = static_cast<uint32_t>(out.samples.size());
    const std::vector<glm::dvec3> grid = direct ? std::vector<glm::dvec3>() : masks.grid(cage, topology, f);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        LimitSample sample{{}, {}, f, {double(i) / n, double(j) / n}};
        if (direct) {
          const surfaces::LimitPoint point = surfaces::catmullClarkPoint(cage, f, sample.at.x, sample.at.y);
          sample.position = point.position, sample.normal = point.normal;
        } else {
          sample.position = grid[static_cast<size_t>(i + (n + 1) * j)];
          sample.normal = gridNormal(grid, n, i, j);
        }
        out.samples.push_back(sample);
      }
    const auto row = static_cast<uint32_t>(n) + 1;
    for (uint32_t j = 0; j + 1 < row; ++j)
      for (uint32_t i = 0; i + 1 < row; ++i) {
        const uint32_t a = first + i + row * j;
        out.indices.insert(out.indices.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
      }
  }
  tables = masks.tables();
  return out;
}

LimitMesh directTriangles(const surfaces::PolygonMesh& cage, int levels) {
  LimitMesh out;
  for (const auto& [face, corners] : triangleCorners(cage.faces.size(), levels))
    for (const glm::dvec2 at : corners) {
      const surfaces::LimitPoint point = surfaces::loopPoint(cage, face, at.x, at.y);
      out.indices.push_back(static_cast<uint32_t>(out.samples.size()));
      out.samples.push_back({point.position, point.normal, face, at});
    }
  return out;
}

class SampledSubdivision : public Technique {
 public:
  using Settings = SampledSettings;
  explicit SampledSubdivision(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    const surfaces::SubdivisionSurface& surface = frame.scene().subdivisions.at(0);
    cage_ = surface.cage;
    if (settings_.scheme == LimitScheme::Loop) cage_ = surfaces::triangulated(std::move(cage_));
    mesh_ = made();
    const glm::dvec3 anchor = frame.gpuScene().anchor();
    const uint32_t material = frame.scene().parts[surface.part].material;
    std::vector<TessellatedVertex> vertices;
    for (const LimitSample& sample : mesh_.samples)
      vertices.push_back(
          {glm::vec3(sample.position - anchor), material, glm::vec3(sample.normal), kRungField});
    vertices_.emplace(vertices), indices_.emplace(mesh_.indices);
    array_.emplace(*vertices_, *indices_);
    drawProgram_ =
        &frame.context().programs().get({"renderer/techniques/tessellation/compute/surface.vert.glsl",
                                         "renderer/techniques/tessellation/surface.frag.glsl"});
    picture_.emplace(frame, settings_.shading, "subdivision");
    frame.passes().setBytesHeld("subdivision/vertices", vertices_->bytes() + indices_->bytes());
  }

  void render(frame::Frame& frame) override {
    picture_->render(frame, [&] {
      drawProgram_->use();
      drawProgram_->set("anchorToClip", frame::anchorToClip(frame));
      array_->bind();
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(mesh_.indices.size()), GL_UNSIGNED_INT, nullptr);
    });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  /// Against direct evaluation: at most `kChecked` samples at regular intervals.
  std::vector<Counter> count(frame::Frame&) override {
    constexpr size_t kChecked = 2000;
    const bool isLoop = settings_.scheme == LimitScheme::Loop;
    glm::dvec3 low(1e300), high(-1e300);
    double most = 0.0;
    for (size_t i = 0; i < mesh_.samples.size(); i += mesh_.samples.size() / kChecked + 1) {
      const LimitSample& sample = mesh_.samples[i];
      const surfaces::LimitPoint exact =
          isLoop ? surfaces::loopPoint(cage_, sample.face, sample.at.x, sample.at.y)
                 : surfaces::catmullClarkPoint(cage_, sample.face, sample.at.x, sample.at.y);
      most = std::max(most, glm::length(exact.position - sample.position));
      low = glm::min(low, exact.position), high = glm::max(high, exact.position);
    }
    return {{"limit_samples", double(mesh_.samples.size())},
            {"limit_error_of_diagonal", most / glm::length(high - low)},
            {"weight_tables", double(tables_)}};
  }

 private:
  LimitMesh made() {
    const bool isLoop = settings_.scheme == LimitScheme::Loop;
    if (settings_.method != LimitMethod::Steps)
      return isLoop ? directTriangles(cage_, settings_.levels) : gridsOf(cage_, settings_, tables_);
    if (isLoop) {
      const surfaces::PolygonMesh fine = surfaces::loop(cage_, settings_.levels);
      return meshOf<3>(fine, surfaces::loopLimit(fine),
                       triangleCorners(cage_.faces.size(), settings_.levels));
    }
    const surfaces::PolygonMesh fine = surfaces::catmullClark(cage_, settings_.levels);
    return meshOf<4>(fine, surfaces::catmullClarkLimit(fine),
                     quadCorners(cage_.faces.size(), settings_.levels));
  }

  Settings settings_;
  surfaces::PolygonMesh cage_;
  LimitMesh mesh_;
  size_t tables_ = 0;
  std::optional<gl::Buffer> vertices_, indices_;
  std::optional<SurfaceVertexArray> array_;
  std::optional<SurfacePicture> picture_;
  const gl::Program* drawProgram_ = nullptr;
};

const RegisteredTechnique<SampledSubdivision> kSampledSubdivisionRegistered{
    {.name = "subdivision/sampled",
     .version = 1,
     .summary =
         "Subdivision surfaces by limit points on grids: steps and limit masks, tabulated weights, or direct "
         "evaluation",
     .source =
         "Bolz and Schröder 2002; Schaefer and Warren 2007; Stam 1998; Schwarz 2009, section 6.1.5 (SC-19 to "
         "SC-21)",
     .product = ProductKind::Colour,
     .needs = {"subdivision_surfaces"},
     .counters = {{"limit_samples", "Limit points made", "points", Direction::Neither},
                  {"limit_error_of_diagonal", "Distance from points by direct evaluation, largest", "",
                   Direction::LowerIsBetter},
                  {"weight_tables", "Kinds of surroundings tabulated", "", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
