// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/subdivision/fragments/fragment_layout.h"

#include <algorithm>

#include "experiments/base/error.h"
#include "renderer/surfaces/half_edges.h"

namespace limen::techniques {
namespace {

/// A vertex of the mesh with its faces, counter-clockwise; face i lies between edges i and i + 1.
struct RingAround {
  std::vector<uint32_t> ends, diagonals;
  std::vector<char> sharp;
  bool closed = true, corner = false;
  int own = 0;  ///< edge along which the quad that asks begins

  int size() const { return static_cast<int>(ends.size()); }
  int sharpEdges() const { return static_cast<int>(std::count(sharp.begin(), sharp.end(), 1)); }
  /// -1: beyond the boundary.
  int edge(int i) const {
    if (closed) return (i % size() + size()) % size();
    return i >= 0 && i < size() ? i : -1;
  }
  int face(int i) const {
    const int at = edge(i);
    return at >= static_cast<int>(diagonals.size()) ? -1 : at;
  }
  bool isSharp(int i) const { return edge(i) >= 0 && sharp[static_cast<size_t>(edge(i))] != 0; }
  bool isPlain() const { return closed && size() == 4 && sharpEdges() == 0; }
};

class FragmentMaker {
 public:
  explicit FragmentMaker(const surfaces::RuleMesh& mesh) : mesh_(mesh), edges_(mesh.vertices, mesh.faces) {}

  /// Which of the quad's vertices can be the one at (0, 0); -1: none.
  int rotationOf(uint32_t face) const {
    const std::array<RingAround, 4> rings = ringsOf(face, 0);
    if (std::ranges::all_of(rings, &RingAround::isPlain)) return 0;
    for (int c = 0; c < 4; ++c) {
      const auto at = [&](int k) -> const RingAround& { return rings[static_cast<size_t>((c + k) % 4)]; };
      // Sharp edges may pass along the two sides from (0, 0) alone.
      if (passesStraight(at(1), at(1).own + 1, at(1).own - 1) && at(2).isPlain() &&
          passesStraight(at(3), at(3).own, at(3).own + 2))
        return c;
    }
    return -1;
  }

  void add(uint32_t face, uint32_t material, FragmentLayout& out) const {
    const std::array<RingAround, 4> rings = ringsOf(face, rotationOf(face));
    const RingAround& ring = rings[0];
    FragmentRecord record{};
    record.edges = static_cast<uint32_t>(ring.size()), record.own = static_cast<uint32_t>(ring.own);
    record.material = material;
    if (ring.isPlain()) record.flags |= kFragmentRegular;
    if (ring.closed) record.flags |= kFragmentClosed;
    if (ring.corner) record.flags |= kFragmentCorner;
    if (!ring.corner && ring.sharpEdges() == 2) record.flags |= kFragmentCrease;
    if (ring.isSharp(ring.own)) record.flags |= kFragmentSharpX;
    if (ring.isSharp(ring.own + 1)) record.flags |= kFragmentSharpY;
    if (ring.sharpEdges() >= 2) {
      int first = ring.own, last = ring.own + 1;
      while (!ring.isSharp(first)) --first;
      while (!ring.isSharp(last)) ++last;
      record.sectorFirst = static_cast<uint32_t>(ring.edge(first));
      record.sectorFaces = static_cast<uint32_t>(last - first);
    }
    for (int i = 0; i < ring.size(); ++i)
      if (ring.isSharp(i)) (i < 32 ? record.sharpLow : record.sharpHigh) |= 1U << (i % 32);
    out.fragments.push_back(record);
    addControls(rings, vertexOf(face, rotationOf(face)), out);
  }

  RingAround around(uint32_t vertex, uint32_t ownEnd) const {
    const surfaces::HalfEdges::Ring found = edges_.ring(vertex);
    RingAround out{found.ends, {}, {}, found.closed, mesh_.corners.contains(vertex), 0};
    uint32_t h = edges_.outgoing[vertex];
    for (size_t i = 0; i < found.ends.size(); ++i) {
      out.sharp.push_back(mesh_.isSharp(vertex, found.ends[i]) ? 1 : 0);
      if (found.ends[i] == ownEnd) out.own = static_cast<int>(i);
      if (h == surfaces::HalfEdges::kNone || (!found.closed && i + 1 == found.ends.size())) continue;
      out.diagonals.push_back(edges_.from[edges_.next[edges_.next[h]]]);
      h = edges_.turned(h);
    }
    return out;
  }

 private:
  uint32_t vertexOf(uint32_t face, int corner) const {
    return mesh_.faces[face][static_cast<size_t>(corner % 4)];
  }
  std::array<RingAround, 4> ringsOf(uint32_t face, int rotation) const {
    std::array<RingAround, 4> out;
    for (int k = 0; k < 4; ++k)
      out[static_cast<size_t>(k)] = around(vertexOf(face, rotation + k), vertexOf(face, rotation + k + 1));
    return out;
  }
  static bool passesStraight(const RingAround& ring, int a, int b) {
    if (ring.isPlain()) return true;
    const bool regular = ring.closed ? ring.size() == 4 : ring.size() == 3;
    return regular && !ring.corner && ring.sharpEdges() == 2 && ring.isSharp(a) && ring.isSharp(b);
  }

  static void addControls(const std::array<RingAround, 4>& rings, uint32_t first, FragmentLayout& out) {
    std::array<uint32_t, 16> grid;
    grid.fill(first);
    const auto set = [&](glm::ivec2 at, uint32_t vertex) {
      grid[static_cast<size_t>(at.x + 1 + 4 * (at.y + 1))] = vertex;
    };
    glm::ivec2 place(0), along(1, 0);
    for (int k = 0; k < 4; ++k) {
      const RingAround& ring = rings[static_cast<size_t>(k)];
      glm::ivec2 way = {along.y, -along.x};  // of the edge before the quad's own
      for (int i = ring.own - 1; i <= ring.own + 2; ++i) {
        const glm::ivec2 next = {-way.y, way.x};
        if (ring.edge(i) >= 0) set(place + way, ring.ends[static_cast<size_t>(ring.edge(i))]);
        if (ring.face(i) >= 0 && (i < ring.own + 2 || ring.isPlain()))
          set(place + way + next, ring.diagonals[static_cast<size_t>(ring.face(i))]);
        way = next;
      }
      place += along;
      along = {-along.y, along.x};
    }
    set({0, 0}, first);
    out.controls.insert(out.controls.end(), grid.begin(), grid.end());
    const RingAround& ring = rings[0];
    for (uint32_t i = 0; i < out.ringPoints / 2; ++i) {
      out.controls.push_back(i < ring.ends.size() ? ring.ends[i] : first);
      out.controls.push_back(i < ring.diagonals.size() ? ring.diagonals[i] : first);
    }
  }

  const surfaces::RuleMesh& mesh_;
  surfaces::HalfEdges edges_;
};

}  // namespace

bool isSeparated(const surfaces::RuleMesh& mesh) {
  const FragmentMaker maker(mesh);
  for (uint32_t f = 0; f < mesh.faces.size(); ++f)
    if (maker.rotationOf(f) < 0) return false;
  return true;
}

FragmentLayout fragmentLayout(const surfaces::RuleMesh& mesh, uint32_t material) {
  const FragmentMaker maker(mesh);
  FragmentLayout out;
  out.ringPoints = 8;
  for (const std::vector<uint32_t>& face : mesh.faces)
    for (const uint32_t vertex : face) {
      const RingAround ring = maker.around(vertex, vertex);
      if (ring.closed && ring.sharpEdges() == 1)
        throw Error("a crease ends inside the surface", "",
                    "fragment meshes take creases that run around, or from corner to corner");
      if (ring.size() > static_cast<int>(kFragmentMostEdges))
        throw Error("a vertex has " + std::to_string(ring.size()) + " edges", "",
                    "fragment meshes take " + std::to_string(kFragmentMostEdges));
      out.ringPoints = std::max(out.ringPoints, 2 * static_cast<uint32_t>(ring.size()));
    }
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (maker.rotationOf(f) < 0)
      throw Error("a face has two extraordinary vertices", "", "use one step more before fragments");
    maker.add(f, material, out);
  }
  return out;
}

}  // namespace limen::techniques
