// Packs on a web server: the same bytes, whatever becomes of connections; one clear error for what cannot be.
#include "protocol/http_source.hpp"

#include "base/error.hpp"
#include "scene/pack.hpp"
#include "tests/support/range_server.hpp"
#include "tests/support/small_pack.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class HttpSources : public testing::Test {
 protected:
  static constexpr HttpPatience hasty{.connect_s = 5, .silence_s = 5, .tries = 4, .first_pause_s = 0.001};
  static std::string error_of(const auto& act) {
    try {
      act();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::string read(const ByteSource& source, uint64_t offset, size_t count) const {
    std::string bytes(count, '?');
    source.read(offset, std::as_writable_bytes(std::span(bytes)), source.name());
    return bytes;
  }
  const std::filesystem::path file = test::write_pack(test::small_pack());
  const std::string content = text_of(file);
  test::RangeServer server{content};
};

TEST_F(HttpSources, have_the_bytes_of_the_file) {
  const auto source = open_http(server.address(), hasty);
  EXPECT_EQ(source->size(), content.size());
  EXPECT_EQ(read(*source, 0, content.size()), content);
  EXPECT_EQ(read(*source, 7, 20), content.substr(7, 20));
  EXPECT_EQ(read(*source, content.size() - 1, 1), content.substr(content.size() - 1));
  EXPECT_EQ(server.requests(), 4u);
}

TEST_F(HttpSources, go_on_where_connections_break_off_and_servers_are_busy) {
  server.cut_every = 2;
  const auto source = open_http(server.address(), hasty);
  EXPECT_EQ(read(*source, 0, content.size()), content);
  EXPECT_GT(server.requests(), 2u);
  EXPECT_LT(server.bytes_sent(), 2 * content.size()) << "what had come was asked for again";
  server.cut_every = 0;
  server.busy_answers = 3;
  EXPECT_EQ(read(*source, 3, 40), content.substr(3, 40));
}

TEST_F(HttpSources, end_in_one_error_that_says_what_is_wrong) {
  const auto open = [&] { open_http(server.address(), hasty); };
  server.status = 404;
  EXPECT_EQ(error_of(open), server.address() + ": there is no such file on the server (404)");
  server.status = 503;
  EXPECT_NE(error_of(open).find("the server answers 503, 4 times in a row"), std::string::npos);
  server.status = 0;
  server.has_ranges = false;
  EXPECT_NE(error_of(open).find("has no ranges"), std::string::npos);
  const auto nobody = [] { open_http("http://127.0.0.1:1/x.tpk", hasty); };
  EXPECT_NE(error_of(nobody).find("http://127.0.0.1:1/x.tpk: "), std::string::npos);
}

TEST_F(HttpSources, notice_that_the_file_is_another_one_now) {
  const auto source = open_http(server.address(), hasty);
  server.change(content, "\"second\"");
  const std::string by_etag = error_of([&] { read(*source, 0, 10); });
  EXPECT_NE(by_etag.find("is not the one that was opened"), std::string::npos) << by_etag;
  server.change(content + "x", "\"first\"");
  const std::string by_size = error_of([&] { read(*source, 0, 10); });
  EXPECT_NE(by_size.find("is not the one that was opened"), std::string::npos) << by_size;
}

TEST_F(HttpSources, are_packs_chunk_by_chunk) {
  server.cut_every = 3;
  const Pack local(file), remote(open_http(server.address(), hasty));
  EXPECT_EQ(remote.content_hash(), local.content_hash());
  for (uint32_t chunk = 0; chunk < local.skeleton().chunks.size(); ++chunk)
    EXPECT_EQ(remote.read_chunk(chunk).vertices, local.read_chunk(chunk).vertices) << chunk;
}

TEST(WebAddresses, are_told_from_files) {
  EXPECT_TRUE(is_web_address("http://host/x.tpk"));
  EXPECT_TRUE(is_web_address("HTTPS://host/x.tpk"));
  EXPECT_FALSE(is_web_address("http.tpk"));
  EXPECT_FALSE(is_web_address("./http://x"));
}

}  // namespace
}  // namespace triptych
