// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/vertex_occlusion/vertex_technique.h"

#include <epoxy/gl.h>

#include <chrono>
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/scene/part_motion.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
#include "renderer/visibility_fields/all_cores.h"
#include "renderer/visibility_fields/map_functions.h"

namespace limen::techniques {
namespace vf = visibility_fields;
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<OccludedVertex> receivingVertices(const scene::Scene& scene) {
  const scene::Mesh& mesh = scene.mesh;
  std::vector<glm::dvec3> normals(mesh.positions.size(), glm::dvec3(0.0));
  std::vector<bool> receives(mesh.positions.size(), false);
  for (const scene::Part& part : scene.parts) {
    if (!part.receiverOnly) continue;
    for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i) {
      const glm::uvec3 t = mesh.triangles[i];
      const glm::dvec3 a = mesh.positions[t.x];
      const glm::dvec3 across = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
      for (int corner = 0; corner < 3; ++corner) normals[t[corner]] += across, receives[t[corner]] = true;
    }
  }
  std::vector<OccludedVertex> out;
  for (uint32_t i = 0; i < mesh.positions.size(); ++i)
    if (receives[i] && glm::length(normals[i]) > 0.0)
      out.push_back({i, mesh.positions[i], glm::normalize(normals[i])});
  return out;
}

}  // namespace

const SettingsTable<VertexRays>& VertexRays::table() {
  using S = VertexRays;
  static const SettingsTable<S> kTable = {{&S::rays,
                                           "rays",
                                           {1, 4096},
                                           "rays",
                                           "Rays per vertex, a square number",
                                           "Gaitatzes 2012, section 4.6.1 (256)"},
                                          falloffBinding(&S::falloff),
                                          falloffRadiusBinding(&S::radius),
                                          objectsBinding(&S::objects)};
  return kTable;
}

void VertexRays::check() const {
  ReceiverRays square;
  square.rays = rays;
  square.check();
}

void VertexTechnique::prepare(frame::Frame& frame) {
  const vf::RigidObjects objects = objectsOf(frame, rays_.objects);
  const auto start = std::chrono::steady_clock::now();
  const int64_t held = prepareObjects(objects.objects);
  makeS_ = secondsSince(start);
  radius_ = rays_.radius * frame.gpuScene().diagonal();
  // Of a binary falloff nothing farther counts.
  far_ = rays_.falloff == Falloff::Binary ? radius_ : 1e30;
  rest_ = receivingVertices(frame.scene());
  vertices_ = rest_;
  motions_ = scene::motionsOfVertices(frame.scene());
  if (vertices_.empty())
    throw Error("no part of the scene only receives, so that there are no vertices to occlude", {},
                "use 'tessellated_corner', or a scene over a ground");
  const int side = static_cast<int>(std::lround(std::sqrt(double(rays_.rays))));
  directions_.clear();
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      directions_.emplace_back(
          vf::fieldDirection((glm::vec2(x, y) + 0.5F) / float(side), vf::kFieldConcentric));
  values_.assign(frame.gpuScene().vertexCount(), 1.0F);
  onGpu_.emplace(values_);
  picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
  program_ = &frame.context().programs().compute(
      "renderer/techniques/visibility_fields/vertex_occlusion/vertex_picture.comp.glsl");
  frame.passes().setBytesHeld(pass_, held);
  frame.passes().setBytesHeld(pass_ + "/picture", picture_->bytes() + onGpu_->bytes());
}

double VertexTechnique::openShare(const OccludedVertex& vertex) const {
  constexpr size_t kAtOnce = 16;
  const glm::vec3 z(vertex.normal);
  const glm::dvec3 x(vf::fieldTangent(z)), y(vf::fieldBitangent(z));
  // Clear of neighbours in the same plane.
  const glm::dvec3 origin = vertex.position + 1e-5 * radius_ * vertex.normal;
  double open = 0.0;
  glm::dvec3 ways[kAtOnce];
  double found[kAtOnce];
  for (size_t first = 0; first < directions_.size(); first += kAtOnce) {
    const size_t count = std::min(kAtOnce, directions_.size() - first);
    for (size_t i = 0; i < count; ++i) {
      const glm::dvec3 d = directions_[first + i];
      ways[i] = glm::normalize(d.x * x + d.y * y + d.z * vertex.normal);
    }
    distances(origin, {ways, count}, far_, {found, count});
    for (size_t i = 0; i < count; ++i) {
      if (found[i] < 0.0)
        open += 1.0;
      else if (rays_.falloff == Falloff::Binary)
        open += found[i] > radius_ ? 1.0 : 0.0;
      else
        open += rays_.falloff == Falloff::Linear ? std::min(1.0, found[i] / radius_)
                                                 : 1.0 - std::exp(-found[i] / radius_);
    }
  }
  return open / double(directions_.size());
}

void VertexTechnique::moveVertices(const scene::Scene& scene, double timeS) {
  for (size_t i = 0; i < rest_.size(); ++i) {
    const uint32_t motion = motions_[rest_[i].number];
    if (motion == 0) continue;
    const glm::dmat4 now = scene.motions[motion - 1].at(timeS);
    vertices_[i].position = glm::dvec3(now * glm::dvec4(rest_[i].position, 1.0));
    vertices_[i].normal = glm::normalize(glm::dmat3(now) * rest_[i].normal);
  }
}

void VertexTechnique::render(frame::Frame& frame) {
  const gl::Texture& positions =
      frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Position}).texture();
  const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
  {
    const auto scope = frame.passes().open(pass_);
    const auto start = std::chrono::steady_clock::now();
    if (!frame.scene().motions.empty()) {
      moveVertices(frame.scene(), frame.timeS());
      place(frame.scene(), frame.timeS());
    }
    vf::onAllCores(vertices_.size(), [&](size_t i) {
      values_[vertices_[i].number] = static_cast<float>(openShare(vertices_[i]));
    });
    occlusionS_ = secondsSince(start);
  }
  const auto scope = frame.passes().open(pass_ + "/picture");
  onGpu_->write(0, onGpu_->bytes(), values_.data());
  frame.gpuScene().bindStorage();
  onGpu_->bindStorage(kVertexValuesBuffer);
  positions.bindTexture(kFieldPositionUnit);
  ids.bindTexture(kFieldIdsUnit);
  picture_->bindImage(kFieldOutImage, gl::Access::Write);
  program_->set("sizePx", frame.sizePx());
  program_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

std::vector<Counter> VertexTechnique::count(frame::Frame&) {
  std::vector<Counter> out = {{"occluded_vertices", double(vertices_.size())},
                              {"occlusion_rays", double(vertices_.size()) * double(rays_.rays)},
                              {"cpu_prepare_s", makeS_},
                              {"cpu_occlusion_s", occlusionS_}};
  addCounters(out);
  return out;
}

std::vector<Quantity> VertexTechnique::quantities() {
  return {{"occluded_vertices", "Vertices whose occlusion is found", "", Direction::Neither,
           "Gaitatzes 2012, Table 1"},
          {"occlusion_rays", "Rays from vertices", "rays", Direction::Neither, "Gaitatzes 2012, Table 1"},
          {"cpu_prepare_s", "Time to make the fields, or the tracer's tree, on the CPU", "s",
           Direction::LowerIsBetter, "Gaitatzes 2012, Table 1"},
          {"cpu_occlusion_s", "Time of the vertices' occlusion on the CPU, last frame", "s",
           Direction::LowerIsBetter, "Gaitatzes 2012, Table 1"}};
}

}  // namespace limen::techniques
