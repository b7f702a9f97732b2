// SPDX-License-Identifier: BSD-3-Clause
#include <signal.h>
#include <sys/stat.h>

#include "experiments/store/sessions.h"
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

mode_t modeOf(const std::string& file) {
  struct stat facts {};
  EXPECT_EQ(stat(file.c_str(), &facts), 0) << file;
  return facts.st_mode & 0777;
}

TEST_F(StoreTest, AnEmptyFileIsANewStore) {
  writeFile(path("empty.sqlite"), "");
  rawSql(path("bare.sqlite"),
         "PRAGMA journal_mode = WAL");  // what is left of a creation that was killed early
  rawSql(path("vacuumed.sqlite"), "VACUUM");
  EXPECT_TRUE(isUnwritten(path("absent.sqlite")));
  for (const char* name : {"empty.sqlite", "bare.sqlite", "vacuumed.sqlite"}) {
    EXPECT_TRUE(isUnwritten(path(name))) << name;
    EXPECT_THAT(errorOf([&] { Store store(path(name), Access::ReadOnly); }), HasSubstr("is empty")) << name;
    { Store store(path(name), Access::ReadWrite); }
    EXPECT_FALSE(isUnwritten(path(name))) << name;
    EXPECT_EQ(Store(path(name), Access::ReadOnly).allRuns().size(), 0U) << name;
  }
  writeFile(path("junk"), "text");
  rawSql(path("music.sqlite"), "CREATE TABLE song (title TEXT)");
  for (const char* name : {"junk", "music.sqlite", "."}) EXPECT_FALSE(isUnwritten(path(name))) << name;
}

TEST_F(StoreTest, AnEmptyFileWithAJournalToRollBackIsANewStore) {
  // The file and its journal in the middle of a transaction that does not fit into the cache, as a kill
  // leaves them. Only a writer may roll it back.
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path("a.sqlite").c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database,
                         "PRAGMA cache_size = 1; BEGIN; CREATE TABLE x (y); WITH RECURSIVE n(i) AS (SELECT 1 "
                         "UNION ALL SELECT i + 1 FROM n WHERE i < 200) INSERT INTO x SELECT "
                         "randomblob(1000) FROM n",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  for (const char* suffix : {"", "-journal"})
    writeFile(path("killed.sqlite") + suffix, readFile(path("a.sqlite") + suffix));
  sqlite3_close(database);
  ASSERT_GT(readFile(path("killed.sqlite")).size(), 0U) << "nothing is to be rolled back";
  EXPECT_TRUE(isUnwritten(path("killed.sqlite")));
  { Store store(path("killed.sqlite"), Access::ReadWrite); }
  EXPECT_EQ(Store(path("killed.sqlite"), Access::ReadOnly).allRuns().size(), 0U);
}

TEST_F(StoreTest, AKillDuringCreationLeavesAFileThatIsNewOrAStore) {
  int unwritten = 0;
  for (int round = 0; round < 60; ++round) {
    const std::string file = path("s" + std::to_string(round) + ".sqlite");
    const pid_t child = startChild([&] { SessionLog log(file); });
    usleep(static_cast<useconds_t>(50 * round));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    if (isUnwritten(file)) {
      ++unwritten;
    } else {
      EXPECT_EQ(Store(file, Access::ReadOnly).allRuns().size(), 0U) << round;
    }
    SessionLog log(file);
    EXPECT_EQ(log.sessionNames("anna").size(), 0U) << round;
    EXPECT_EQ(modeOf(file), 0600u) << round;
  }
  EXPECT_GT(unwritten, 0) << "the kills came too late to test anything";
}

TEST_F(StoreTest, AStoreWithSessionsIsTheOwnersAlone) {
  { SessionLog log(path("new.sqlite")); }
  EXPECT_EQ(modeOf(path("new.sqlite")), 0600u);
  // A sweep's store that gets its first session.
  { Store store(path("sweep.sqlite"), Access::ReadWrite); }
  EXPECT_EQ(modeOf(path("sweep.sqlite")) & 0044u, 0044u) << "runs of sweeps are no secret";
  SessionLog log(path("sweep.sqlite"));
  log.participantNumber("anna", "2026-03-01T12:00:00.000Z");
  for (const char* suffix : {"", "-wal", "-shm"})
    EXPECT_EQ(modeOf(path("sweep.sqlite") + suffix), 0600u) << suffix;
}

TEST_F(StoreTest, AnOlderStoreWithSessionsIsHiddenByTheNextWriter) {
  {
    SessionLog log(path("s.sqlite"));
    StudySession session;
    session.participant = "anna";
    session.participantNumber = log.participantNumber("anna", "2026-03-01T12:00:00.000Z");
    session.name = "1";
    session.protocol = "p0";
    session.display = "d0";
    session.started = "2026-03-01T12:00:00.000Z";
    log.start(session, {"p0", "quick", "quick.yaml", "t", "title: t"}, {"d0", "desk", "name: desk", {}},
              {"none", false, {}}, {}, {});
  }
  chmod(path("s.sqlite").c_str(), 0644);
  { Store store(path("s.sqlite"), Access::ReadWrite); }
  EXPECT_EQ(modeOf(path("s.sqlite")), 0600u);
}

}  // namespace
}  // namespace limen::store
