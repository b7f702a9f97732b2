// SPDX-License-Identifier: BSD-3-Clause
// NURBS evaluated as they are on a grid of each surface, without Bézier patches (Schwarz 2009,
// section 6.1.4): each sample for itself (Kanai 2007; SC-16), or from basis functions made once for each row
// and column (Krishnamurthy, Khardekar and McMains 2007; SC-17). Choices of the bench: spans are divided
// evenly, so that samples are those of a uniform tessellation of the Bézier patches, and spans are found on
// the GPU in both forms.
#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/nurbs/nurbs_bindings.h"
#include "renderer/techniques/tessellation/patch_buffers.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_vertex_array.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

enum class NurbsForm { Each, Grid };
constexpr EnumNames<NurbsForm, 2> enumNames(NurbsForm) {
  return {{{{NurbsForm::Each, "each"}, {NurbsForm::Grid, "grid"}}}};
}

struct DirectNurbsSettings {
  NurbsForm form = NurbsForm::Grid;
  int segments = 8;
  frame::ShadedSetting shading;
  static const SettingsTable<DirectNurbsSettings>& table() {
    using S = DirectNurbsSettings;
    static const SettingsTable<S> kTable = {
        {&S::form, "form", "Basis functions for each sample, or once for each row and column of samples",
         "Schwarz 2009, section 6.1.4"},
        {&S::segments, "segments", {1, 64}, "segments", "Segments of each span between knots"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

/// Ends of the spans with a length.
std::vector<double> breaksOf(const std::vector<double>& knots, int degree, int points) {
  std::vector<double> out = {knots[static_cast<size_t>(degree)]};
  for (size_t k = static_cast<size_t>(degree) + 1; k <= static_cast<size_t>(points); ++k)
    if (knots[k] > out.back()) out.push_back(knots[k]);
  return out;
}

class DirectNurbs : public Technique {
 public:
  using Settings = DirectNurbsSettings;
  explicit DirectNurbs(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    requireDrawn(frame.scene());
    makeBuffers(frame);
    const std::string folder = "renderer/techniques/tessellation/nurbs/";
    gl::ProgramCache& programs = frame.context().programs();
    gl::ShaderDefines defines;
    if (settings_.form == NurbsForm::Grid) {
      defines["GRID"] = "1";
      basisProgram_ = &programs.compute(folder + "basis.comp.glsl");
    }
    pointsProgram_ = &programs.compute(folder + "points.comp.glsl", defines);
    drawProgram_ = &programs.get({"renderer/techniques/tessellation/compute/surface.vert.glsl",
                                  "renderer/techniques/tessellation/surface.frag.glsl"});
    picture_.emplace(frame, settings_.shading, "nurbs");
    frame.passes().setBytesHeld("nurbs/basis", basis_->bytes());
    frame.passes().setBytesHeld("nurbs/vertices", vertices_->bytes() + indices_->bytes() + points_->bytes() +
                                                      knots_->bytes() + parameters_->bytes());
  }

  void render(frame::Frame& frame) override {
    records_->bindStorage(kNurbsSurfacesBuffer);
    points_->bindStorage(kNurbsPointsBuffer);
    knots_->bindStorage(kNurbsKnotsBuffer);
    parameters_->bindStorage(kNurbsParametersBuffer);
    basis_->bindStorage(kNurbsBasisBuffer);
    vertices_->bindStorage(kVerticesBuffer);
    if (basisProgram_) {
      const auto scope = frame.passes().open("nurbs/basis");
      forSurfaces(*basisProgram_, [](const NurbsRecord& of) { return of.columns + of.rows; });
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    {
      const auto scope = frame.passes().open("nurbs/vertices");
      forSurfaces(*pointsProgram_, [](const NurbsRecord& of) { return of.columns * of.rows; });
      glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
    }
    picture_->render(frame, [&] {
      drawProgram_->use();
      drawProgram_->set("anchorToClip", frame::anchorToClip(frame));
      array_->bind();
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices_->bytes() / 4), GL_UNSIGNED_INT, nullptr);
    });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  /// Against the scene's Bézier patches, which come from the same surfaces by inserting knots.
  std::vector<Counter> count(frame::Frame& frame) override {
    const scene::Scene& scene = frame.scene();
    const std::vector<TessellatedVertex> vertices = vertices_->read<TessellatedVertex>();
    glm::dvec3 low(1e300), high(-1e300);
    double position = 0.0, angle = 0.0;
    for (size_t i = 0; i < held_.size(); ++i) {
      const NurbsRecord& of = held_[i];
      const uint32_t spans = (of.columns - 1) / segments(), first = scene.nurbs[i].firstPatch;
      for (uint32_t row = 0; row < of.rows; ++row)
        for (uint32_t column = 0; column < of.columns; ++column) {
          const TessellatedVertex& vertex = vertices[of.firstVertex + row * of.columns + column];
          const uint32_t s = std::min(column / segments(), spans - 1),
                         t = std::min(row / segments(), (of.rows - 1) / segments() - 1);
          const surfaces::Patch& patch = scene.surfaces.patches[first + t * spans + s];
          const int n = settings_.segments;
          const surfaces::SurfaceJet exact = surfaces::evaluate(
              scene.surfaces, patch,
              surfaces::rectangleGridPoint(int(column - s * segments()), n, int(row - t * segments()), n),
              surfaces::Order::First);
          const glm::dvec3 found = frame.gpuScene().anchor() + glm::dvec3(vertex.position);
          low = glm::min(low, exact.p), high = glm::max(high, exact.p);
          position = std::max(position, glm::length(found - exact.p));
          const glm::dvec3 across = glm::cross(exact.u, exact.v), normal(vertex.normal);
          if (vertex.rung == kRungTangents && glm::length(across) > 0.0)
            angle = std::max(angle,
                             std::atan2(glm::length(glm::cross(across, normal)), glm::dot(across, normal)));
        }
    }
    return {{"nurbs_vertices", double(vertices.size())},
            {"tessellated_triangles", double(indices_->bytes() / 12)},
            {"nurbs_error_of_diagonal", position / glm::length(high - low)},
            {"nurbs_normal_error_deg", glm::degrees(angle)}};
  }

 private:
  uint32_t segments() const { return static_cast<uint32_t>(settings_.segments); }

  template <class Count>
  void forSurfaces(const gl::Program& program, Count count) const {
    program.use();
    for (uint32_t i = 0; i < held_.size(); ++i) {
      program.set("surfaceNumber", i);
      glDispatchCompute((count(held_[i]) + uint32_t(kTessellationGroup) - 1) / uint32_t(kTessellationGroup),
                        1, 1);
    }
  }

  void makeBuffers(frame::Frame& frame) {
    const scene::Scene& scene = frame.scene();
    const glm::dvec3 anchor = frame.gpuScene().anchor();
    std::vector<glm::vec4> points;
    std::vector<float> knots, parameters;
    std::vector<uint32_t> indices;
    uint32_t vertices = 0;
    const auto addKnots = [&](const std::vector<double>& of) {
      const auto first = static_cast<uint32_t>(knots.size());
      for (const double knot : of) knots.push_back(static_cast<float>(knot));
      return first;
    };
    const auto addParameters = [&](const std::vector<double>& breaks, uint32_t& first) {
      first = static_cast<uint32_t>(parameters.size());
      for (size_t i = 0; i + 1 < breaks.size(); ++i)
        for (int k = 0; k < settings_.segments; ++k)
          parameters.push_back(
              static_cast<float>(breaks[i] + (breaks[i + 1] - breaks[i]) * k / settings_.segments));
      parameters.push_back(static_cast<float>(breaks.back()));
      return static_cast<uint32_t>(parameters.size()) - first;
    };
    for (const scene::NurbsPart& part : scene.nurbs) {
      const surfaces::NurbsSurface& of = part.surface;
      NurbsRecord record{};
      record.firstPoint = static_cast<uint32_t>(points.size());
      for (const glm::dvec4& p : of.points)
        points.emplace_back(glm::dvec4(glm::dvec3(p) - p.w * anchor, p.w));
      record.pointsU = static_cast<uint32_t>(of.pointsU()),
      record.pointsV = static_cast<uint32_t>(of.pointsV());
      record.degreeU = static_cast<uint32_t>(of.degreeU), record.degreeV = static_cast<uint32_t>(of.degreeV);
      record.firstKnotU = addKnots(of.knotsU), record.firstKnotV = addKnots(of.knotsV);
      record.columns = addParameters(breaksOf(of.knotsU, of.degreeU, of.pointsU()), record.firstU);
      record.rows = addParameters(breaksOf(of.knotsV, of.degreeV, of.pointsV()), record.firstV);
      record.firstVertex = vertices;
      record.material = scene.parts[part.part].material;
      for (uint32_t j = 0; j + 1 < record.rows; ++j)
        for (uint32_t i = 0; i + 1 < record.columns; ++i) {
          const uint32_t a = vertices + i + record.columns * j, above = a + record.columns;
          indices.insert(indices.end(), {a, a + 1, above + 1, a, above + 1, above});
        }
      vertices += record.columns * record.rows;
      held_.push_back(record);
    }
    records_.emplace(held_), points_.emplace(points), knots_.emplace(knots), parameters_.emplace(parameters);
    basis_.emplace(static_cast<int64_t>(parameters.size()) * int64_t{sizeof(BasisRecord)}, nullptr);
    vertices_.emplace(int64_t{vertices} * int64_t{sizeof(TessellatedVertex)}, nullptr);
    indices_.emplace(indices);
    array_.emplace(*vertices_, *indices_);
  }

  Settings settings_;
  std::vector<NurbsRecord> held_;
  std::optional<gl::Buffer> records_, points_, knots_, parameters_, basis_, vertices_, indices_;
  std::optional<SurfaceVertexArray> array_;
  std::optional<SurfacePicture> picture_;
  const gl::Program *basisProgram_ = nullptr, *pointsProgram_ = nullptr, *drawProgram_ = nullptr;
};

const RegisteredTechnique<DirectNurbs> kDirectNurbsRegistered{
    {.name = "tessellation/direct_nurbs",
     .version = 1,
     .summary = "NURBS evaluated directly on a grid of each surface, without Bézier patches",
     .source =
         "Kanai 2007; Krishnamurthy, Khardekar and McMains 2007; Schwarz 2009, section 6.1.4 (SC-16, SC-17)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces", "nurbs"},
     .counters = {{"nurbs_vertices", "Vertices made", "vertices", Direction::LowerIsBetter},
                  {"tessellated_triangles", "Triangles made", "triangles", Direction::LowerIsBetter},
                  {"nurbs_error_of_diagonal",
                   "Distance of vertices from the same places of the Bézier patches, largest", "",
                   Direction::LowerIsBetter},
                  {"nurbs_normal_error_deg", "Angle of normals to those of the Bézier patches, largest",
                   "degree", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
