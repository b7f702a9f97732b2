// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/recursion/diced_parts.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/recursion/recursion_bindings.h"
#include "renderer/techniques/tessellation/surface_view.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {

void requireCubic(const surfaces::PatchSet& set) {
  for (const surfaces::Patch& patch : set.patches)
    if (patch.degreeU != 3 || patch.degreeV != 3)
      throw Error("the scene has patches that are not of degree 3", "scene",
                  "recursion/cpu splits patches of any degree");
}

std::vector<RecursionPart> wholePatches(const surfaces::PatchSet& set) {
  std::vector<RecursionPart> out;
  for (uint32_t i = 0; i < set.patches.size(); ++i) {
    const bool triangle = set.patches[i].domain == surfaces::Domain::Triangle;
    out.push_back({triangle ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 0, 1, 1), 0.0F, 0.0F, i, 0});
  }
  return out;
}

DicedParts::DicedParts(frame::Frame& frame, const PatchBuffers& patches, const PartSettings& settings)
    : patches_(patches),
      grid_(settings.grid),
      lists_(frame::chosenRaster(settings.raster, frame.context()) == frame::Raster::Compute),
      picture_(frame, settings.shading, "recursion",
               lists_ ? frame::Raster::Compute : frame::Raster::Hardware),
      listed_(int64_t{sizeof(frame::RasterCount)}, nullptr) {
  gl::ProgramCache& programs = frame.context().programs();
  const std::string folder = "renderer/techniques/recursion/queues/";
  diceProgram_ = &programs.compute(folder + "dice.comp.glsl", patches.defines());
  roundsProgram_ = &programs.compute(folder + "rounds.comp.glsl");
  drawProgram_ = &programs.get({"renderer/techniques/tessellation/compute/surface.vert.glsl",
                                "renderer/techniques/tessellation/surface.frag.glsl"});
  const int64_t vertices = int64_t{grid_ + 1} * (grid_ + 1), indices = 6 * int64_t{grid_} * grid_;
  capacity_ = static_cast<uint32_t>(std::max<int64_t>(settings.capacity / vertices, patches.count()));
  vertices_.emplace(capacity_ * vertices * int64_t{sizeof(TessellatedVertex)}, nullptr);
  indices_.emplace(capacity_ * indices * 4, nullptr);
  array_.emplace(*vertices_, *indices_);
  frame.passes().setBytesHeld("recursion/dice", vertices_->bytes() + indices_->bytes());
}

void DicedParts::advance(const gl::Buffer& counters) const {
  roundsProgram_->set("partCapacity", capacity_);
  roundsProgram_->set("indicesPerPart", static_cast<uint32_t>(6 * grid_ * grid_));
  counters.bindStorage(kSplitCountersBuffer);
  listed_.bindStorage(kListedTrianglesBuffer);
  roundsProgram_->use();
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void DicedParts::dice(frame::Frame& frame, const gl::Buffer& parts, const gl::Buffer& counters) const {
  const auto scope = frame.passes().open("recursion/dice");
  diceProgram_->set("partCapacity", capacity_);
  diceProgram_->set("grid", grid_);
  patches_.bindStorage();
  indices_->bindStorage(kIndicesBuffer);
  counters.bindStorage(kDiceCountersBuffer);
  parts.bindStorage(kFinishedBuffer);
  vertices_->bindStorage(kVerticesBuffer);
  diceProgram_->use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, counters.id());
  glDispatchComputeIndirect(offsetof(RecursionCounters, diceGroupsX));
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void DicedParts::render(frame::Frame& frame, const gl::Buffer& parts, const gl::Buffer& counters) {
  dice(frame, parts, counters);
  if (lists_) {
    picture_.renderListed(frame, {*vertices_, *indices_, listed_, int64_t{capacity_} * 2 * grid_ * grid_});
    return;
  }
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  picture_.render(frame, [&] {
    drawProgram_->use();
    drawProgram_->set("anchorToClip", frame::anchorToClip(frame));
    array_->bind();
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, counters.id());
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(offsetof(RecursionCounters, indices)));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  });
}

std::shared_ptr<surfaces::TessellatedSurface> DicedParts::surface(frame::Frame& frame,
                                                                  const gl::Buffer& partsBuffer,
                                                                  const gl::Buffer& counters) const {
  const uint32_t count = std::min(counters.read<RecursionCounters>()[0].finished, capacity_);
  const auto parts = partsBuffer.read<RecursionPart>(0, count);
  const auto grid = static_cast<uint32_t>(grid_), side = grid + 1;
  const auto vertices = vertices_->read<TessellatedVertex>(0, int64_t{count} * side * side);
  auto out = std::make_shared<surfaces::TessellatedSurface>();
  const surfaces::PatchSet& set = frame.scene().surfaces;
  out->anchor = frame.gpuScene().anchor(), out->view = viewOf(frame);
  out->factors.assign(set.patches.size(), {});
  std::vector<uint32_t> places(vertices.size());
  for (uint32_t p = 0; p < count; ++p) {
    const RecursionPart& part = parts[p];
    const bool triangle = set.patches[part.patchNumber].domain == surfaces::Domain::Triangle;
    out->factors[part.patchNumber].fill(1);  // drawn
    for (uint32_t j = 0; j < side; ++j)
      for (uint32_t i = 0; i < side; ++i) {
        if (triangle && i + j > grid) continue;
        const uint32_t slot = (p * side + j) * side + i;
        places[slot] = static_cast<uint32_t>(out->positions.size());
        out->positions.push_back(vertices[slot].position);
        out->normals.push_back(vertices[slot].normal);
        out->patches.push_back(part.patchNumber);
        const glm::dvec2 a(part.corners.x, part.corners.y), b(part.corners.z, part.corners.w),
            c(part.lastU, part.lastV);
        const double x = double(i) / grid, y = double(j) / grid;
        const glm::dvec2 at = triangle ? (1.0 - x - y) * a + x * b + y * c : a + (b - a) * glm::dvec2(x, y);
        out->parameters.push_back(surfaces::domainPoint(
            triangle ? surfaces::Domain::Triangle : surfaces::Domain::Rectangle, at.x, at.y));
      }
  }
  for (const glm::uvec3& t : indices_->read<glm::uvec3>(0, int64_t{count} * 2 * grid * grid))
    if (t.x != t.y) out->triangles.emplace_back(places[t.x], places[t.y], places[t.z]);
  return out;
}

}  // namespace limen::techniques
