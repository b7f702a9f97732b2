// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "renderer/scene/import.h"

namespace limen::scene {

/// What the process that reads a mesh file sends to the one that asked: either a mesh or why there is none.
/// In this machine's byte order.
using SendBytes = std::function<void(const void* data, size_t bytes)>;
void sendMesh(const ImportedMesh& mesh, const SendBytes& send);
void sendRefusal(const std::string& message, const SendBytes& send);

struct ReceivedMesh {
  ImportedMesh mesh;
  std::string refusal;  ///< empty: there is a mesh
};
/// `receive` fills exactly so many bytes or throws. The sender is not trusted: throws Error if what it says
/// is no mesh (a triangle without its vertex, parts that do not tile the triangles, a coordinate that is not
/// finite); memory is only taken for what has arrived.
using ReceiveBytes = std::function<void(void* data, size_t bytes)>;
ReceivedMesh receiveMesh(const ReceiveBytes& receive);

}  // namespace limen::scene
