// SPDX-License-Identifier: BSD-3-Clause
// The four conditions of Holländer 2013, section 1.1, each with the failing mesh of its figure 1.1.
#include <gtest/gtest.h>

#include "experiments/base/error.h"
#include "renderer/surfaces/table_layout.h"
#include "tests/renderer/subdivision/meshes.h"

namespace limen::surfaces {
namespace {

using Faces = std::vector<std::vector<uint32_t>>;

MeshFault faultOf(size_t vertices, const Faces& faces) {
  const auto fault = findFault(vertices, faces);
  EXPECT_TRUE(fault.has_value());
  return fault ? fault->fault : MeshFault::UnknownVertex;
}

TEST(Manifold, AVertexTwiceInAPolygonIsRefused) {
  EXPECT_EQ(faultOf(7, {{0, 1, 2, 3, 0, 4, 5, 6}}), MeshFault::RepeatedVertex);
  EXPECT_EQ(faultOf(3, {{0, 1, 1}}), MeshFault::RepeatedVertex);
  EXPECT_EQ(faultOf(2, {{0, 1}}), MeshFault::RepeatedVertex);
}

TEST(Manifold, AVertexOfSixBoundaryEdgesIsRefused) {
  EXPECT_EQ(faultOf(7, {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}}), MeshFault::CrowdedBoundary);
}

TEST(Manifold, AnEdgeOfThreeFacesIsRefused) {
  EXPECT_EQ(faultOf(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), MeshFault::CrowdedEdge);
}

/// Two closed tetrahedra that meet in one vertex: no boundary, yet not connected there.
TEST(Manifold, FacesThatMeetInAVertexAloneAreRefused) {
  EXPECT_EQ(
      faultOf(7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}}),
      MeshFault::SeveralFans);
}

TEST(Manifold, OpposedFacesAndUnknownVerticesAreRefused) {
  EXPECT_EQ(faultOf(4, {{0, 1, 2}, {0, 1, 3}}), MeshFault::OpposedFaces);
  EXPECT_EQ(faultOf(3, {{0, 1, 7}}), MeshFault::UnknownVertex);
}

TEST(Manifold, GoodMeshesPass) {
  for (const PolygonMesh& mesh :
       {bipyramid(3), bipyramid(20), boundaryFan(1), boundaryFan(9), openSheet(4, true), openSheet(3, false)})
    EXPECT_FALSE(findFault(mesh.points.size(), mesh.faces).has_value());
  EXPECT_FALSE(findFault(4, {{0, 1, 2}}).has_value()) << "a vertex without faces does no harm";
}

TEST(Manifold, TheErrorSaysWhereAndWhy) {
  PolygonMesh mesh;
  mesh.points.resize(5);
  mesh.faces = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  try {
    ruleMesh(mesh, SubdivisionScheme::Loop);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("edge 0-1 has 3 faces"), std::string::npos) << error.what();
  }
  EXPECT_THROW(ruleMesh(openSheet(2, false), SubdivisionScheme::Loop), Error);
  EXPECT_THROW(ruleMesh(openSheet(2, true), SubdivisionScheme::Butterfly), Error);
  PolygonMesh semiSharp = bipyramid(5);
  semiSharp.sharpness[edgeKey(0, 2)] = 1.5;
  EXPECT_EQ(stepsUntilSmooth(semiSharp), 2);
  EXPECT_THROW(tableLayout(semiSharp, SubdivisionScheme::Loop, 1, 1), Error);
  EXPECT_THROW(ruleMesh(semiSharp, SubdivisionScheme::Butterfly), Error);
}

}  // namespace
}  // namespace limen::surfaces
