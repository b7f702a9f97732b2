// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/mesh_import/mesh_stream.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "experiments/base/error.h"

namespace limen::scene {
namespace {

constexpr uint32_t kMesh = 0x4853454d, kRefusal = 0x4c465552, kEnd = 0x20444e45;  // "MESH", "RUFL", "END "
constexpr uint64_t kLongestText = 1 << 16;
constexpr uint64_t kMostElements = 0xffffffff;  // indices have 32 bits

template <class T>
void sendValue(const T& value, const SendBytes& send) {
  static_assert(std::is_trivially_copyable_v<T>);
  send(&value, sizeof value);
}

void sendText(const std::string& text, const SendBytes& send) {
  const uint64_t length = std::min<uint64_t>(text.size(), kLongestText);
  sendValue(length, send);
  send(text.data(), length);
}

template <class T>
void sendAll(const std::vector<T>& values, const SendBytes& send) {
  static_assert(std::is_trivially_copyable_v<T>);
  sendValue(static_cast<uint64_t>(values.size()), send);
  send(values.data(), values.size() * sizeof(T));
}

[[noreturn]] void refuse(const std::string& what) { throw Error("the import sent " + what); }

template <class T>
T receiveValue(const ReceiveBytes& receive) {
  T value{};
  receive(&value, sizeof value);
  return value;
}

std::string receiveText(const ReceiveBytes& receive) {
  const auto length = receiveValue<uint64_t>(receive);
  if (length > kLongestText) refuse("a name that is too long");
  std::string text(length, '\0');
  receive(text.data(), length);
  return text;
}

uint64_t receiveCount(const ReceiveBytes& receive) {
  const auto count = receiveValue<uint64_t>(receive);
  if (count > kMostElements) refuse("a count that cannot be");
  return count;
}

template <class T>
std::vector<T> receiveAll(const ReceiveBytes& receive) {
  constexpr uint64_t kPiece = 1 << 18;
  std::vector<T> values;
  for (uint64_t left = receiveCount(receive); left > 0;) {
    const uint64_t piece = std::min(left, kPiece);
    const size_t begin = values.size();
    values.resize(begin + piece);
    receive(values.data() + begin, piece * sizeof(T));
    left -= piece;
  }
  return values;
}

void check(const ImportedMesh& imported) {
  const Mesh& mesh = imported.mesh;
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner)
      if (triangle[corner] >= mesh.positions.size()) refuse("a triangle without its vertex");
  for (const glm::dvec3& p : mesh.positions)
    if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
      refuse("a coordinate that is not finite");
  for (const Material& material : imported.materials)
    for (int channel = 0; channel < 3; ++channel)
      if (!(material.albedo[channel] >= 0.0F && material.albedo[channel] <= 1.0F))
        refuse("a colour outside 0 to 1");
  uint64_t next = 0;
  for (const Part& part : imported.parts) {
    if (part.firstTriangle != next || part.material >= imported.materials.size())
      refuse("parts that do not fit the mesh");
    next += part.triangleCount;
  }
  if (next != mesh.triangles.size()) refuse("parts that do not fit the mesh");
}

}  // namespace

void sendMesh(const ImportedMesh& mesh, const SendBytes& send) {
  sendValue(kMesh, send);
  sendAll(mesh.mesh.positions, send);
  sendAll(mesh.mesh.triangles, send);
  sendValue(static_cast<uint64_t>(mesh.materials.size()), send);
  for (const Material& material : mesh.materials) {
    sendText(material.name, send);
    sendValue(material.albedo, send);
  }
  sendValue(static_cast<uint64_t>(mesh.parts.size()), send);
  for (const Part& part : mesh.parts) {
    sendText(part.name, send);
    sendValue(part.firstTriangle, send);
    sendValue(part.triangleCount, send);
    sendValue(part.material, send);
  }
  sendValue(kEnd, send);
}

void sendRefusal(const std::string& message, const SendBytes& send) {
  sendValue(kRefusal, send);
  sendText(message, send);
  sendValue(kEnd, send);
}

ReceivedMesh receiveMesh(const ReceiveBytes& receive) {
  ReceivedMesh out;
  const auto kind = receiveValue<uint32_t>(receive);
  if (kind == kRefusal) {
    out.refusal = receiveText(receive);
    if (out.refusal.empty()) refuse("a refusal without a reason");
  } else if (kind == kMesh) {
    out.mesh.mesh.positions = receiveAll<glm::dvec3>(receive);
    out.mesh.mesh.triangles = receiveAll<glm::uvec3>(receive);
    for (uint64_t left = receiveCount(receive); left > 0; --left) {
      Material material;
      material.name = receiveText(receive);
      material.albedo = receiveValue<glm::vec3>(receive);
      out.mesh.materials.push_back(std::move(material));
    }
    for (uint64_t left = receiveCount(receive); left > 0; --left) {
      Part part;
      part.name = receiveText(receive);
      part.firstTriangle = receiveValue<uint32_t>(receive);
      part.triangleCount = receiveValue<uint32_t>(receive);
      part.material = receiveValue<uint32_t>(receive);
      out.mesh.parts.push_back(std::move(part));
    }
    check(out.mesh);
  } else {
    refuse("something else than a mesh");
  }
  if (receiveValue<uint32_t>(receive) != kEnd) refuse("more than a mesh");
  return out;
}

}  // namespace limen::scene
