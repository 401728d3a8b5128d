#include "base/error.hpp"
#include "base/file.hpp"
#include "preprocess/build_work.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {
namespace {

class WorkTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::path(testing::TempDir()) / ("triptych_work_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    make_folder(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path pack() const { return folder / "a.tpk"; }
  std::filesystem::path journal() const { return folder / "a.tpk.work" / "journal"; }

  /// Does units first up to, not including, end in a process that then dies on the spot.
  void work_and_die(int end, const std::string& fingerprint) const {
    const pid_t child = ::fork();
    if (child == 0) {
      BuildWork work(pack(), fingerprint);
      for (int i = 0; i < end; ++i) do_unit(work, i);
      work.parts().append(std::as_bytes(std::span("half a unit")));
      ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
  }

  static int do_unit(BuildWork& work, int number) {
    int taken = -1;
    const auto index = static_cast<uint32_t>(number);
    work.run(
        UnitKind::divided_mesh, std::span(&index, 1),
        [](uint32_t unit) {
          return record_bytes(
              UnitResult{{}, {record_bytes(unit)}, record_bytes(static_cast<int>(unit) * 10)});
        },
        [&](uint32_t, const StoredUnit& stored) { taken = stored.figures_as<int>(); });
    return taken;
  }

  std::filesystem::path folder;
};

TEST_F(WorkTest, a_folder_that_no_build_left_is_refused_and_stays_as_it_is) {
  make_folder(folder / "a.tpk.work");
  write_file(folder / "a.tpk.work" / "diary", std::string("mine"));
  EXPECT_THROW(BuildWork(pack(), "same"), Error);
  EXPECT_EQ(read_text_file(folder / "a.tpk.work" / "diary"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.tpk.work" / "lock"));
}

TEST_F(WorkTest, a_killed_process_leaves_its_finished_units_and_the_next_one_goes_on) {
  work_and_die(3, "same");
  BuildWork work(pack(), "same");
  EXPECT_EQ(work.left_to_replay(), 3u);
  EXPECT_EQ(work.parts().size(), 3 * sizeof(int));  // what the fourth unit had begun is gone
  for (int i = 0; i < 5; ++i) EXPECT_EQ(do_unit(work, i), i * 10);
  const auto bytes = work.parts().read({0, 5 * sizeof(int)});
  ByteReader reader(bytes, "parts");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(reader.read<int>(), i);
}

TEST_F(WorkTest, chunks_and_geometry_are_numbered_in_the_order_of_the_indices_and_again_from_the_journal) {
  const std::vector<uint32_t> indices = {2, 3, 7};
  const auto unit = [](uint32_t index) {
    Chunk chunk;  // index + 1 triangles
    for (uint32_t i = 0; i < index + 3; ++i) {
      const auto at = static_cast<int>(i);
      chunk.vertices.push_back({{at, at * at, at % 2}, 0});
      if (i >= 2) chunk.indices.insert(chunk.indices.end(), {0, i - 1, i});
    }
    return record_bytes(
        UnitResult{{{EncodedChunk(chunk), index}}, {record_bytes(index), {}}, record_bytes(index)});
  };
  const auto run_and_check = [&](BuildWork& work) {
    std::vector<uint32_t> taken;
    work.run(UnitKind::hlod, indices, unit, [&](uint32_t index, const StoredUnit& stored) {
      EXPECT_EQ(stored.first_chunk, taken.size());
      ASSERT_EQ(stored.chunks.size(), 1u);
      EXPECT_EQ(stored.chunks[0].triangle_count, index + 1);
      EXPECT_EQ(stored.chunks[0].lattice, index);
      ASSERT_EQ(stored.geometry.size(), 2u);
      EXPECT_EQ(record_of<uint32_t>(work.surfaces().read(stored.geometry[0]), "surfaces"), index);
      EXPECT_EQ(stored.geometry[1].size, 0u);
      EXPECT_EQ(stored.figures_as<uint32_t>(), index);
      taken.push_back(index);
    });
    EXPECT_EQ(taken, indices);
    EXPECT_EQ(work.pack().chunks().size(), 3u);
  };
  const pid_t child = ::fork();
  if (child == 0) {
    BuildWork work(pack(), "same");
    run_and_check(work);
    ::_exit(HasFailure() ? 1 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  BuildWork work(pack(), "same");
  EXPECT_EQ(work.left_to_replay(), 1u);
  run_and_check(work);
}

TEST_F(WorkTest, a_journal_of_other_units_is_an_error) {
  work_and_die(1, "same");
  BuildWork work(pack(), "same");
  const uint32_t index = 0;
  EXPECT_THROW(work.run(UnitKind::hlod, std::span(&index, 1), {}, {}), Error);
}

TEST_F(WorkTest, another_fingerprint_and_an_empty_one_start_again) {
  work_and_die(3, "same");
  EXPECT_EQ(BuildWork(pack(), "other").left_to_replay(), 0u);
  work_and_die(3, "");
  EXPECT_EQ(BuildWork(pack(), "").left_to_replay(), 0u);
}

TEST_F(WorkTest, a_record_that_was_not_written_whole_is_done_again) {
  work_and_die(3, "same");
  std::filesystem::resize_file(journal(), std::filesystem::file_size(journal()) - 1);
  BuildWork work(pack(), "same");
  EXPECT_EQ(work.left_to_replay(), 2u);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(do_unit(work, i), i * 10);
  EXPECT_EQ(work.parts().size(), 4 * sizeof(int));
}

TEST_F(WorkTest, what_is_done_after_a_torn_record_is_found_again_by_a_third_run) {
  work_and_die(3, "same");
  std::filesystem::resize_file(journal(), std::filesystem::file_size(journal()) - 1);
  work_and_die(6, "same");
  BuildWork work(pack(), "same");
  EXPECT_EQ(work.left_to_replay(), 6u);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(do_unit(work, i), i * 10);
}

TEST_F(WorkTest, a_damaged_record_and_what_came_after_it_is_done_again) {
  work_and_die(3, "same");
  std::string bytes = read_text_file(journal());
  bytes[bytes.size() / 2] ^= 0x10;
  write_file(journal(), bytes);
  BuildWork work(pack(), "same");
  EXPECT_LT(work.left_to_replay(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(do_unit(work, i), i * 10);
}

TEST_F(WorkTest, an_end_that_is_no_kill_leaves_nothing) {
  {
    BuildWork work(pack(), "same");
    do_unit(work, 0);
    EXPECT_TRUE(std::filesystem::exists(journal()));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(WorkTest, two_processes_cannot_build_the_same_pack) {
  BuildWork work(pack(), "same");
  EXPECT_THROW(BuildWork(pack(), "same"), Error);
  EXPECT_TRUE(std::filesystem::exists(journal()));  // the first one goes on
}

TEST_F(WorkTest, a_place_that_cannot_be_written_is_an_error_with_its_name) {
  try {
    BuildWork work(folder / "missing" / "a.tpk", "");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("missing/a.tpk"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace triptych
