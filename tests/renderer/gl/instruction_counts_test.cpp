// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/instruction_counts.h"

#include <gtest/gtest.h>

#include "experiments/base/error.h"

namespace limen::gl {
namespace {

using Class = InstructionClass;

double count(const InstructionCounts& counts, Class kind) { return counts[static_cast<size_t>(kind)]; }

/// As the driver writes it: resources, then the assembly, then bytes.
std::string binaryOf(const std::string& body) {
  return std::string("source\0Places\0", 14) +
         "!!NVcp5.0\nOPTION NV_internal;\nGROUP_SIZE 512;\nSTORAGE sbo_buf0[] = { program.storage[0] };\n"
         "TEMP R0, R1;\nSHORT TEMP HC;\n" +
         body + "END\n" + std::string("\0\1REP.S ;\n", 10);
}

TEST(InstructionCounts, CountsWrittenComponentsByClass) {
  const auto parts =
      countInstructions(binaryOf("MUL.S.PREC R0.zw, invocation.groupid.xyxy, {64, 32, 0, 0}.xyxy;\n"
                                 "ADD.F32 R1, R0, R0;\n"
                                 "MAD.F32 R0.x, R0, R1, R0;\n"
                                 "DP3.F32 R0.x, R0, R1;\n"
                                 "DIV.S R0.y, R0.x, {68, 0, 0, 0}.x;\n"
                                 "DIV.F32 R0.z, R0.x, R0.w;\n"
                                 "POW.F32 R0.x, R0.y, R0.z;\n"
                                 "I2F.U R0.w, R0;\n"
                                 "MOV.S R0, R1;\n"
                                 "LDB.F32X4 R0, sbo_buf0[R1.x + 16];\n"
                                 "TXF.F R1.xyz, R1.xyzz, handle(D0.x), 2D;\n"
                                 "STS.F32 R0, shared_mem[R0.y];\n"
                                 "LDS.F32X4 R0, shared_mem[R0.y + 16];\n"
                                 "STOREIM.F handle(D0.x), R0.x, R2, 2D;\n"
                                 "ATOMS.ADD.U32 R0.x, R0.z, shared_mem[0];\n"
                                 "BAR ;\n"
                                 "IF NE.x;\nENDIF;\n"));
  ASSERT_EQ(parts.size(), 1U);
  const InstructionCounts& counts = parts[0].counts;
  EXPECT_EQ(count(counts, Class::Arithmetic), 2 + 4 + 1 + 3 + 1 + 1);
  EXPECT_EQ(count(counts, Class::Division), 1);
  EXPECT_EQ(count(counts, Class::Special), 1 + 2);
  EXPECT_EQ(count(counts, Class::Conversion), 1);
  EXPECT_EQ(count(counts, Class::Move), 4);
  EXPECT_EQ(count(counts, Class::Load), 1);
  EXPECT_EQ(count(counts, Class::Fetch), 1);
  EXPECT_EQ(count(counts, Class::SharedStore), 1);
  EXPECT_EQ(count(counts, Class::SharedLoad), 1);
  EXPECT_EQ(count(counts, Class::Store), 1);
  EXPECT_EQ(count(counts, Class::Atomic), 1);
  EXPECT_EQ(count(counts, Class::Barrier), 1);
  EXPECT_EQ(count(counts, Class::Flow), 2);
}

TEST(InstructionCounts, LoopsAreCountedAlone) {
  const auto parts =
      countInstructions(binaryOf("ADD.S R0.x, R0, R0;\n"
                                 "REP.S ;\nSGE.S.CC HC.x, R0.y, R0;\nBRK (NE.x);\n"
                                 "REP.S {3, 0, 0, 0};\nADD.F32 R0.xy, R0, R0;\nENDREP;\n"
                                 "REP.S ;\nLDS.F32 R0.x, shared_mem[R0.y];\nENDREP;\nENDREP;\n"
                                 "REP.S ;\nSTB.F32 R0, sbo_buf0[R0.x];\nENDREP;\n"));
  ASSERT_EQ(parts.size(), 5U);
  EXPECT_EQ(parts[1].name, "1");
  EXPECT_FALSE(parts[1].iterations.has_value());
  EXPECT_EQ(parts[2].name, "1.1");
  EXPECT_EQ(parts[2].iterations, 3);
  EXPECT_EQ(parts[3].name, "1.2");
  EXPECT_EQ(parts[4].name, "2");
  EXPECT_EQ(count(parts[1].counts, Class::Arithmetic), 1);
  EXPECT_EQ(count(parts[2].counts, Class::Arithmetic), 2);

  const InstructionCounts total = totalCounts(parts, {{"1", 2.5}, {"1.2", 4.0}});
  EXPECT_EQ(count(total, Class::Arithmetic), 1 + 2.5 * (1 + 3 * 2));
  EXPECT_EQ(count(total, Class::SharedLoad), 2.5 * 4);
  EXPECT_EQ(count(total, Class::Store), 1);
  EXPECT_THROW(totalCounts(parts, {{"3", 1.0}}), Error);
  EXPECT_THROW(totalCounts(parts, {{"main", 2.0}}), Error);
}

TEST(InstructionCounts, RefusesWhatIsNoAssembly) {
  EXPECT_THROW(countInstructions("llvm"), Error);
  EXPECT_THROW(countInstructions("!!NVcp5.0\nADD.S R0.x, R0, R0;\n"), Error);
  EXPECT_THROW(countInstructions(binaryOf("REP.S ;\n")), Error);
  EXPECT_THROW(countInstructions(binaryOf("ENDREP;\n")), Error);
}

}  // namespace
}  // namespace limen::gl
