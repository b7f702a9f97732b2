// SPDX-License-Identifier: BSD-3-Clause
// Fields kept on disk.
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "renderer/scene/shapes.h"
#include "renderer/visibility_fields/field_store.h"
#include "tests/renderer/visibility_fields/field_fixture.h"

namespace limen::visibility_fields {
namespace {

class KeptFields : public Field {
 protected:
  void SetUp() override {
    Field::SetUp();
    std::string pattern = (std::filesystem::temp_directory_path() / "limen_fields_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    std::filesystem::remove_all(folder_);
    Field::TearDown();
  }
  std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) out.push_back(entry.path());
    return out;
  }
  std::string folder_;
};

TEST_F(KeptFields, AreReadAsTheyWereMade) {
  const std::vector<RigidObject> objects = {objectOf(coneAndBox()),
                                            objectOf(scene::box({0, 0, 0}, {1, 2, 3}))};
  for (const int bits : {1, 8, 32}) {
    const FieldForm form{PositionForm::Lattice, 82, DirectionForm::Concentric, 16, bits};
    const VisibilityFields made(context(), objects, form);
    const VisibilityFields first(context(), {objects[1]}, form, 0, folder_);
    EXPECT_EQ(first.fieldsRead(), 0U);
    const VisibilityFields second(context(), objects, form, 0, folder_);
    EXPECT_EQ(second.fieldsRead(), 1U);
    const VisibilityFields third(context(), objects, form, 0, folder_);
    EXPECT_EQ(third.fieldsRead(), 2U);
    for (uint32_t object = 0; object < 2; ++object) {
      EXPECT_EQ(second.readShares(object), made.readShares(object)) << bits;
      EXPECT_EQ(third.readShares(object), made.readShares(object)) << bits;
    }
  }
}

// Another object or form is another file; one that is cut short or has a letter changed is made again and
// replaced.
TEST_F(KeptFields, ADamagedFileIsReplaced) {
  const RigidObject object = objectOf(coneAndBox());
  FieldForm form{PositionForm::Lattice, 82, DirectionForm::Concentric, 16, 8};
  const std::vector<float> right = VisibilityFields(context(), {object}, form, 0, folder_).readShares(0);
  ASSERT_EQ(files().size(), 1U);
  const std::filesystem::path file = files()[0];
  for (const bool cut : {true, false}) {
    if (cut) {
      std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    } else {
      std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
      out.seekp(1000);
      out.put(static_cast<char>(0x5a)), out.put(static_cast<char>(0xa5));
    }
    const VisibilityFields again(context(), {object}, form, 0, folder_);
    EXPECT_EQ(again.fieldsRead(), 0U);
    EXPECT_EQ(again.readShares(0), right);
    EXPECT_EQ(VisibilityFields(context(), {object}, form, 0, folder_).fieldsRead(), 1U);
  }
  form.directions = 8;
  EXPECT_EQ(VisibilityFields(context(), {object}, form, 0, folder_).fieldsRead(), 0U);
  EXPECT_EQ(files().size(), 2U);
}

// Writers and readers at once, as of several processes: whatever is there is whole.
TEST_F(KeptFields, AreWholeWhileOthersWriteThem) {
  const FieldStore store(folder_, "device");
  const std::string path = folder_ + "/one.field";
  const StoredField field{std::vector<uint32_t>(50000, 7U), {}};
  store.write(path, field);
  std::atomic<int> missing = 0;
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 4; ++thread)
      threads.emplace_back([&, thread] {
        for (int i = 0; i < 10; ++i)
          if (thread % 2 == 0)
            store.write(path, field);
          else if (!store.read(path, 50000, 0))
            ++missing;
      });
  }
  EXPECT_EQ(missing, 0);
  EXPECT_EQ(files().size(), 1U);
}

}  // namespace
}  // namespace limen::visibility_fields
