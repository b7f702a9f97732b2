// SPDX-License-Identifier: BSD-3-Clause
// How many invocations of a group before this one have a flag set, and how many in all. FLAG_SCAN: 0: sums by an up and a down
// sweep in shared memory, 1: ballots of subgroups (KHR_shader_subgroup), 2: ballots by ARB_shader_ballot. FLAG_GROUP: invocations
// of the group, a power of two. The including shader enables the extensions before anything else, and includes this below its
// layout. All of the group call.
// Source: Holländer 2013, section 3.7.1.
shared uint flagLine[FLAG_GROUP];

#if FLAG_SCAN == 0
uint flagsBefore(bool flag, out uint total) {
  const uint me = gl_LocalInvocationIndex;
  barrier();
  flagLine[me] = flag ? 1u : 0u;
  barrier();
  for (uint step_ = 1u; step_ < uint(FLAG_GROUP); step_ *= 2u) {
    const uint right = (me + 1u) * 2u * step_ - 1u;
    if (right < uint(FLAG_GROUP)) flagLine[right] += flagLine[right - step_];
    barrier();
  }
  total = flagLine[FLAG_GROUP - 1];
  barrier();
  if (me == 0u) flagLine[FLAG_GROUP - 1] = 0u;
  barrier();
  for (uint step_ = uint(FLAG_GROUP) / 2u; step_ > 0u; step_ /= 2u) {
    const uint right = (me + 1u) * 2u * step_ - 1u;
    if (right < uint(FLAG_GROUP)) {
      const uint own = flagLine[right], left = flagLine[right - step_];
      flagLine[right - step_] = own;
      flagLine[right] = own + left;
    }
    barrier();
  }
  return flagLine[me];
}
#else
// Invocations are taken in the order of subgroups.
uint flagsBefore(bool flag, out uint total) {
#if FLAG_SCAN == 1
  const uvec4 votes = subgroupBallot(flag);
  const uint before = subgroupBallotExclusiveBitCount(votes), own = subgroupBallotBitCount(votes);
  const uint subgroup = gl_SubgroupID, subgroups = gl_NumSubgroups;
  const bool first = gl_SubgroupInvocationID == 0u;
#else
  const uvec2 votes = unpackUint2x32(ballotARB(flag));
  const uvec2 below = unpackUint2x32(gl_SubGroupLtMaskARB);
  const uint before = uint(bitCount(votes.x & below.x) + bitCount(votes.y & below.y));
  const uint own = uint(bitCount(votes.x) + bitCount(votes.y));
  const uint subgroup = gl_LocalInvocationIndex / gl_SubGroupSizeARB;
  const uint subgroups = uint(FLAG_GROUP) / gl_SubGroupSizeARB;
  const bool first = gl_SubGroupInvocationARB == 0u;
#endif
  barrier();
  if (first) flagLine[subgroup] = own;
  barrier();
  uint sum = before;
  total = 0u;
  for (uint i = 0u; i < subgroups; ++i) {
    if (i < subgroup) sum += flagLine[i];
    total += flagLine[i];
  }
  return sum;
}
#endif
