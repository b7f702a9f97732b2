// SPDX-License-Identifier: BSD-3-Clause
#include "tests/experiments/store/store_fixture.h"

namespace limen::store {
namespace {

using testing::HasSubstr;

TEST_F(StoreTest, AFileThatIsNoDatabaseIsRefusedAndLeftAlone) {
  for (const std::string& text : {std::string("hello"), std::string(5000, 'x')}) {
    writeFile(path("junk.txt"), text);
    for (const Access access : {Access::ReadOnly, Access::ReadWrite}) {
      const std::string error = errorOf([&] { Store store(path("junk.txt"), access); });
      EXPECT_THAT(error, HasSubstr("is not a result store"));
      EXPECT_THAT(error, HasSubstr("junk.txt"));
      EXPECT_EQ(readFile(path("junk.txt")), text);
    }
  }
}

TEST_F(StoreTest, AnotherProgramsDatabaseIsRefusedAndLeftAlone) {
  rawSql(path("music.sqlite"), "CREATE TABLE song (title TEXT)");
  for (const Access access : {Access::ReadOnly, Access::ReadWrite})
    EXPECT_THAT(errorOf([&] { Store store(path("music.sqlite"), access); }), HasSubstr("not a result store"));
  EXPECT_EQ(rawSql(path("music.sqlite"), "SELECT group_concat(name) FROM sqlite_schema"), "song");
}

TEST_F(StoreTest, ANewerSchemaIsRefused) {
  Store(path("s.sqlite"), Access::ReadWrite);
  rawSql(path("s.sqlite"), "PRAGMA user_version = 9999");
  for (const Access access : {Access::ReadOnly, Access::ReadWrite})
    EXPECT_THAT(errorOf([&] { Store store(path("s.sqlite"), access); }), HasSubstr("schema version 9999"));
}

TEST_F(StoreTest, AMissingFileOrAFolderIsRefusedForReading) {
  EXPECT_THAT(errorOf([&] { Store store(path("none.sqlite"), Access::ReadOnly); }), HasSubstr("no such"));
  EXPECT_FALSE(std::filesystem::exists(path("none.sqlite")));
  EXPECT_THAT(errorOf([&] { Store store(folder_.string(), Access::ReadWrite); }), HasSubstr("is a folder"));
}

TEST_F(StoreTest, AMissingFolderIsMade) {
  { Store store(path("a/b/s.sqlite"), Access::ReadWrite); }
  EXPECT_TRUE(std::filesystem::exists(path("a/b/s.sqlite")));
}

TEST_F(StoreTest, AFileInTheWayOfTheFolderIsRefused) {
  writeFile(path("a"), "text");
  EXPECT_THAT(errorOf([&] { Store store(path("a/s.sqlite"), Access::ReadWrite); }),
              HasSubstr("cannot be created"));
}

TEST_F(StoreTest, AStoreOpenedForReadingRefusesToWrite) {
  { Store store(path("s.sqlite"), Access::ReadWrite); }
  Store store(path("s.sqlite"), Access::ReadOnly);
  EXPECT_THAT(errorOf([&] { store.claim(makeRun("k")); }), HasSubstr("cannot be written"));
}

TEST_F(StoreTest, AStoreInAReadOnlyFolderCanBeReadButNotWritten) {
  {
    Store store(path("s.sqlite"), Access::ReadWrite);
    addDone(store, makeRun("k"));
  }
  std::filesystem::permissions(path("s.sqlite"), std::filesystem::perms(0444));
  std::filesystem::permissions(folder_, std::filesystem::perms(0555));
  const pid_t child = startChild([&] {
    if (geteuid() == 0 && setuid(65534) != 0) throw Error("cannot become a user without rights");
    if (Store(path("s.sqlite"), Access::ReadOnly).allRuns().size() != 1) throw Error("the run is not there");
    const std::string error = errorOf([&] { Store store(path("s.sqlite"), Access::ReadWrite); });
    if (error.find("cannot be written") == std::string::npos) throw Error(error);
  });
  EXPECT_EQ(exitCode(child), 0);
  std::filesystem::permissions(folder_, std::filesystem::perms(0755));
}

TEST_F(StoreTest, NamesWithSpecialLettersWork) {
  const std::string name = path("50% größer? #1 & 'quoted'.sqlite");
  {
    Store store(name, Access::ReadWrite);
    addDone(store, makeRun("k"));
  }
  EXPECT_EQ(Store(name, Access::ReadOnly).allRuns().size(), 1U);
}

TEST_F(StoreTest, ConstraintsOfTheSchemaAreInForce) {
  Store store(path("s.sqlite"), Access::ReadWrite);
  store::Run run = makeRun("k");
  run.environment = 77;  // no such row
  EXPECT_THAT(errorOf([&] { store.claim(run); }), HasSubstr("FOREIGN KEY"));
  EXPECT_TRUE(store.allRuns().empty());
}

TEST_F(StoreTest, TheFileIsAWriteAheadLogStoreOfVersionThree) {
  { Store store(path("s.sqlite"), Access::ReadWrite); }
  EXPECT_EQ(rawSql(path("s.sqlite"), "PRAGMA journal_mode"), "wal");
  EXPECT_EQ(rawSql(path("s.sqlite"), "PRAGMA user_version"), "3");
}

}  // namespace
}  // namespace limen::store
