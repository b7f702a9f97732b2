// SPDX-License-Identifier: BSD-3-Clause
// All steps in one dispatch, each as propagate.comp.glsl does it. Lights at groups' sides go through a buffer, in words of 16 bits of
// data and 16 of a tag, the step: who reads polls the words themselves until all tags are those of the step. Each word says by itself
// that it is new, so that nothing needs a signal or a memory barrier.
//
// Two halves of the buffer, of even and odd steps, suffice. A group writes its words of step s + 2 over those of s after a barrier that
// follows its reading of step s + 1 from each neighbour. A neighbour writes that after a barrier that follows its own reading of step s.
// So all that still had to read step s have done so. Tags are counted on from dispatch to dispatch and wrap; a word that is polled holds
// either its step's tag or that of the last step that wrote to its half, which is fewer than 2^16 steps ago.
//
// Between a barrier and the next an invocation waits for words that another of the same group, of its neighbour, has yet to send. GPUs
// run all invocations of a group at a time; a renderer that runs one after another up to the next barrier needs one in between, as
// where two shells of lights do not fit into shared memory.
#include "renderer/techniques/global_illumination/voxel_propagation/resident_tile.glsl"

#ifdef FIELD_HALF
const int kTaggedWords = 1;  // of four each
#else
const int kTaggedWords = 2;
#endif
// Half, channel, layer, row, column.
layout(std430, binding = kStepLightsBuffer) coherent volatile buffer Lights { uvec4 outside[]; };

uvec4 tagged(uvec2 data, uint tag) { return uvec4(data.x & 0xffffu, data.x >> 16, data.y & 0xffffu, data.y >> 16) | tag << 16; }
bool bears(uvec4 words, uint tag) { return all(equal(words >> 16, uvec4(tag))); }
uvec2 dataOf(uvec4 words) { return (words.xz & 0xffffu) | words.yw << 16; }

void send(int index, LightKept kept, uint tag) {
#ifdef FIELD_HALF
  outside[index] = tagged(kept, tag);
#else
  const uvec4 bits = floatBitsToUint(kept);
  outside[kTaggedWords * index] = tagged(bits.xy, tag);
  outside[kTaggedWords * index + 1] = tagged(bits.zw, tag);
#endif
}

// Waits until all words are those of the step.
LightKept receive(int index, uint tag) {
  uvec4 words[kTaggedWords];
  bool done = false;
  for (uint poll = 0u; poll < mostPolls; ++poll) {
    done = true;
    for (int i = 0; i < kTaggedWords; ++i) {
      words[i] = outside[kTaggedWords * index + i];
      done = done && bears(words[i], tag);
    }
    if (done) break;
    if ((poll & 63u) == 63u && stuck != 0u) break;
    pause();
  }
  if (!done) giveUp();
#ifdef FIELD_HALF
  return dataOf(words[0]);
#else
  return uintBitsToFloat(uvec4(dataOf(words[0]), dataOf(words[1])));
#endif
}

void main() {
  const ivec3 tile = ivec3(gl_WorkGroupID);
  const int index = int(gl_LocalInvocationIndex);
  Resident me = residentVoxel();
  const int ownOutside = outsideIndex(me.voxel, me.channel);
  int shell = 0;
  barrier();
  for (int s = 1;; ++s) {
    me.own = afterResidentStep(me, shell);
    if (s == steps) break;
    const LightKept kept = keptOf(me.own);
    const uint tag = (firstSignal + uint(s)) & 0xffffu;
    if (me.atSide) send(halfOf(s) + ownOutside, kept, tag);
#if SHELLS == 1
    barrier();  // all have read what is written over next, and sent theirs
#else
    shell = kShellLights - shell;
#endif
    lights[shell + me.place] = kept;
    for (int i = index; i < 3 * kBeyond; i += kInvocations) {
      int side;
      const int of = i / kBeyond;
      const ivec3 beyond = beyondTile(i - of * kBeyond, side), at = kTile * tile + beyond;
      if (isInGrid(at)) lights[shell + inShell(beyond, of)] = receive(halfOf(s) + outsideIndex(at, of), tag);
    }
    barrier();
    if (lost != 0u) return;
  }
  keepResident(me);
}
