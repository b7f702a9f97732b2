// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of trees of points, their cuts and their views share. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::many_lods {
#endif

// Tree of spheres: node 1 is the root, 2 i and 2 i + 1 the children of i, leaves n .. 2 n - 1 for n =
// 2^depth.
const uint kRootNode = 1u;
const int kMostDepth = 22;

// Why a cut is exact in floats (sphere_tree.h): parents are larger than they need be by this share, and a
// test for culling gives way by this share of the distance for each level above the leaves.
const float kSphereSlack = 1.220703125e-4f;    // 2^-13
const float kCullSlack = 1.9073486328125e-6f;  // 2^-19
// Directions as they are unpacked deviate from those merged by less than this, rad.
const float kConeSlack = 1e-3f;

// A view: where it stands, what it can see, and how large things are in it.
struct CutView {  // std430; vectors relative to the scene's anchor
  vec4 eye;       // w: q^2, where a sphere of radius r at distance d is fine enough if d > q r; q >= 1
  vec4 axisX;     // unit; w: tangent of half the field of view (Perspective)
  vec4 axisY;     // unit, down in the tile; w: tangent
  vec4 axisZ;     // unit, into the view; w: kView...
  vec4 frustum;   // secants of half the fields of view, x and y; z: 1 / range of depths; w: object that it does not show; 0: none
};
#ifdef __cplusplus
static_assert(sizeof(CutView) == 80);
#endif
const uint kViewHemisphere = 0u;  // stereographic: all directions in front fill the disc in the tile
const uint kViewPerspective = 1u;

// A view as it was when cuts were last found, and how far the tree had travelled then.
struct LastView {  // std430
  CutView view;
  double centres, radii;
};
// How far a tree's nodes have moved since it was made: the sum over its updates of the farthest that a centre went, and of the most by
// which a radius changed; and both of the update that is going on, as bits.
struct TreeTravel {  // std430
  double centres, radii;
  uint centreNow, radiusNow;
  uint unused0, unused1;
};
#ifdef __cplusplus
static_assert(sizeof(LastView) == 96 && sizeof(TreeTravel) == 32);
#endif

// Lists of cuts: x: node, y: view and this flag: nothing is left to do in this frame.
const uint kEntryDone = 0x80000000u;

// What becomes of an entry in a step. Bit 0 set: it is split, and the bits say which nodes of the subtree below it
// are (bit 0 the node itself, then its descendants as in a heap). Else how many nodes it climbs, from bit 8, or
// kCodeDropped.
const uint kCodeSplit = 1u;
const uint kCodeClimbShift = 8u;
const uint kCodeDropped = 0x80000000u;
const uint kCodeOpen = 0x40000000u;  // it is left over for the next step as it is
const int kMostSplitLevels = 5;

// Cuts by geometry shaders.
const uint kFeedbackNodesUnit = 0u;
const uint kFeedbackViewsUnit = 1u;

const int kCutGroup = 256;
const int kCutRows = 4;  // entries of an invocation
const int kCutTile = kCutGroup * kCutRows;
// Entries of an invocation in steps in one dispatch: fewer leave registers for more groups; where entries are only kept or left over,
// two share a parent's test.
const int kSplitRows = 1;
const int kKeepRows = 2;
const int kMostCutGroups = 16384;  // of a dispatch; groups take several tiles
const int kMostCutSteps = 64;
const int kCutScanGroup = 256;
const int kCutScanRows = 8;  // tiles of an invocation

struct CutStep {                         // std430
  uint classifyX, classifyY, classifyZ;  // indirect arguments of its dispatches
  uint scanX, scanY, scanZ;
  uint emitX, emitY, emitZ;
  uint readAt;      // first entry that it finds
  uint count;       // entries that it finds
  uint budget;      // splits that the list has room for
  uint full;        // not 0: it has more to split than that
  uint finishedAt;  // first entry of the list that becomes the frame's
  uint finished;    // entries that are there already
  uint leftAt;      // where it writes what the next step has to look at
  // Of steps in one dispatch, so far: splits asked for, entries finished and left over, groups that are done.
  uint asked, made, left, groupsDone;
};
struct CutControl {          // std430; followed by the steps
  uint drawX, drawY, drawZ;  // indirect arguments of a dispatch over the list, in groups of kSplatGroup
  uint count;                // entries of the list
  uint readAt;               // first entry of the list
  uint refused;              // splits that the list had no room for, in this frame
  uint splits;               // of this frame, by one level each
  uint steps;                // of this frame
  uint tests, merges;        // predicates evaluated, merges by one level each; counted on request
  uint unused0, unused1, unused2, unused3, unused4, unused5;
};
#ifdef __cplusplus
static_assert(sizeof(CutStep) == 80 && sizeof(CutControl) == 64 && offsetof(CutStep, scanX) == 12 &&
              offsetof(CutStep, emitX) == 24);
#endif

// Rules of a step.
const uint kRuleSplit = 0u;    // split what is too coarse, as far as this step can
const uint kRuleClimb = 1u;    // and merge all the way first
const uint kRuleOneEdge = 2u;  // split or merge by one level; pairs merge if both are there
const uint kRuleLiteral = 3u;  // as listing 3.1 has it

const uint kCutNodesBuffer = 0u;
const uint kCutViewsBuffer = 1u;
const uint kCutListBuffer = 2u;
const uint kCutCodesBuffer = 3u;
const uint kCutTilesBuffer = 4u;
const uint kCutControlBuffer = 5u;
const uint kCutLinksBuffer = 6u;
// Of entries that are not tested while nothing has moved too far; not with links.
const uint kCutMotionsBuffer = 6u;
const uint kCutMarginsBuffer = 7u;
const uint kMotionLastViewsBuffer = 3u;
const uint kMotionTravelBuffer = 4u;
// Triangle of the sample of an inner node, where samples are those of all nodes.
const uint kNoTriangle = 0xffffffffu;

// Of a node of a tree that is not complete (tree_shape.h).
struct TreeLink {   // std430
  uint firstChild;  // even, its sibling follows; 0: a leaf
  uint parent;
  uint height;      // edges to the farthest leaf below
  uint leaves;      // below, or 1
};
#ifdef __cplusplus
static_assert(sizeof(TreeLink) == 16);
#endif

// Update of the tree.
const int kUpdateGroup = 256;
const int kUpdateLevels = 9;  // of a dispatch: 512 leaves or nodes of a group become 1
const uint kUpdatePositionsBuffer = 0u;
const uint kUpdateIndicesBuffer = 1u;
const uint kUpdatePointsBuffer = 2u;
const uint kUpdateNodesBuffer = 3u;
const uint kUpdateConesBuffer = 4u;
const uint kUpdateTravelBuffer = 5u;

// Atlas of views: tile after tile, row after row. Nodes, views, list and control as above.
const int kSplatGroup = 256;
const int kSmallSplatPx = 16;  // boxes of more pixels are drawn by the whole group
const uint kSplatDepthsBuffer = 3u;
const uint kSplatWinnersBuffer = 4u;
const uint kSplatColoursBuffer = 6u;
const uint kSplatOwnersBuffer = 6u;  // not with colours
const uint kSplatConesBuffer = 7u;
const uint kAtlasEmpty = 0xffffffffu;
const float kFarthestDepth = 0.99999988079071045f;  // 1 - 2^-23: what lies farther, too

const int kPushPullGroup = 256;

// Cuts drawn in place.
const int kInPlaceGroup = 256;
const int kSequentialGroup = 32;
struct InPlaceCounts {  // std430
  uint deepest;         // most entries that a stack held
  uint refused;         // splits that a stack had no room for
  uint drawn;           // nodes, of all views
  uint rounds;          // of all groups
  uint unfinished;      // groups that a software renderer's limit on loops stopped: tiles are worthless
  uint unused0, unused1, unused2;
};
#ifdef __cplusplus
static_assert(sizeof(InPlaceCounts) == 32);
#endif
const uint kInPlaceCountsBuffer = 5u;

// Values of the tree's nodes, four halves each (ValueTree).
const uint kAverageValuesBuffer = 0u;

#ifdef __cplusplus
}  // namespace limen::many_lods
#endif
