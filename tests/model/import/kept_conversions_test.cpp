// What readers made of files, kept by the files' bytes.
#include "model/import/kept_conversions.hpp"

#include "ifc_files.hpp"
#include "import_support.hpp"
#include "model/import/mesh_stream_source.hpp"

namespace triptych {
namespace {

class Conversions : public testing::Test {
 protected:
  Conversions() : file(test::write_model("a.step", "what is in it")) { std::filesystem::remove(kept); }

  /// What a conversion of the file says, and its output; counts those that are made.
  std::string convert(
      const std::string& how = "reader", const ContentKey& readers = {1, 1},
      const std::function<void()>& meanwhile = [] {}) {
    BuildCache cache(kept, {1, 2});
    KeptConversions conversions(cache, readers);
    const auto source = std::make_shared<StreamSource>(file);
    const Converted converted = conversions.get(source, how, kept.parent_path(), [&] {
      ++made;
      meanwhile();
      std::vector<std::byte> bytes(3'000'000, std::byte{7});  // several stretches
      return Converted{
          std::make_shared<StreamSource>("output", std::move(bytes)), {"one", "two\tthree"}, reads};
    });
    EXPECT_EQ(cache.count().found + cache.count().made, 1u);
    cache.commit();
    std::vector<std::byte> output(converted.output->size());
    SourceReader(converted.output).read(0, output);
    EXPECT_EQ(output, std::vector<std::byte>(3'000'000, std::byte{7}));
    EXPECT_EQ(converted.warnings, (std::vector<std::string>{"one", "two\tthree"}));
    return converted.output->name();
  }

  const std::filesystem::path file, kept = file.parent_path() / "cache";
  std::vector<std::filesystem::path> reads;
  int made = 0;
};

TEST_F(Conversions, of_the_same_bytes_are_made_once_wherever_the_file_lies) {
  convert();
  convert();
  EXPECT_EQ(made, 1);
  const auto moved = file.parent_path() / "b.step";
  std::filesystem::rename(file, moved);
  std::filesystem::copy(moved, file);  // another time of change
  EXPECT_EQ(convert(), file.string());
  EXPECT_EQ(made, 1);
}

TEST_F(Conversions, of_other_bytes_flags_or_readers_are_made_again) {
  convert();
  convert("reader --chord 1");
  convert("reader --chord 1", {1, 9});
  test::write_model("a.step", "what was in it");
  convert("reader --chord 1", {1, 9});
  EXPECT_EQ(made, 4);
}

TEST_F(Conversions, of_a_file_that_changes_meanwhile_are_not_kept) {
  convert("reader", {1, 1}, [] { test::write_model("a.step", "something else"); });
  test::write_model("a.step", "what is in it");
  convert();
  EXPECT_EQ(made, 2);
}

TEST_F(Conversions, that_read_other_files_are_not_kept) {
  reads = {file};
  convert();
  convert();
  EXPECT_EQ(made, 2);
}

TEST_F(Conversions, that_are_damaged_are_made_again) {
  convert();
  std::fstream stream(kept, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(2'000'000);
  stream.put('x');
  stream.close();
  convert();
  EXPECT_EQ(made, 2);
  convert();
  EXPECT_EQ(made, 2);
}

TEST_F(Conversions, of_ifc_give_the_same_model) {
  const auto ifc =
      test::write_model("a.ifc", test::ifc_file(test::element(100, "#110") + test::block(110, 4, 0.2, 3)));
  const Model plain = import_model({ifc});
  for (const uint64_t found : {0, 1}) {
    BuildCache cache(kept, {1, 2});
    KeptConversions conversions(cache, {1, 1});
    ImportOptions options;
    options.kept_conversions = &conversions;
    const Model model = import_model({ifc}, options);
    EXPECT_EQ(cache.count().found, found);
    EXPECT_EQ(model.placed_triangles(), plain.placed_triangles());
    EXPECT_EQ(test::triangles_of(model.meshes.at(0)).size(), test::triangles_of(plain.meshes.at(0)).size());
    EXPECT_EQ(model.report.warnings, plain.report.warnings);
    EXPECT_EQ(model.source_objects.objects.size(), plain.source_objects.objects.size());
    cache.commit();
  }
}

}  // namespace
}  // namespace triptych
