#include "wire_seeds.hpp"

#include "protocol/memory_connection.hpp"
#include "protocol/tls.hpp"
#include "protocol/wire.hpp"
#include "tests/protocol/sample_messages.hpp"

namespace triptych::fuzz {

namespace {

/// What a caller with this key says first.
std::vector<std::byte> first_flight(const SharedKey& key) {
  asio::io_context context;
  const auto [own, other] = memory_pair(context, context);
  const auto caller = tls_connection(own, key, TlsSide::caller);
  caller->open([](const std::string&) {});
  std::vector<std::byte> said(4096);
  size_t count = 0;
  other->read_some(said, [&](size_t got, const std::string&) { count = got; });
  context.poll();
  caller->close();
  other->close();
  context.poll();
  said.resize(count);
  return said;
}

}  // namespace

std::vector<std::pair<std::string, std::vector<std::byte>>> wire_seeds() {
  std::vector<std::pair<std::string, std::vector<std::byte>>> seeds;
  const auto add = [&](const std::string& name, std::vector<std::byte> head,
                       const std::vector<std::byte>& bytes) {
    head.insert(head.end(), bytes.begin(), bytes.end());
    seeds.emplace_back(name, std::move(head));
  };
  std::vector<std::byte> all;
  for (const Message& message : sample_messages()) {
    const auto bytes = encode(message);
    add("message/" + message_name(message), {std::byte{1}}, bytes);
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  add("message/all", {std::byte{0}}, all);
  const VisibleSet before = {1, 3, 9};  // gaps of 1, 2 and 6
  add("delta/some", {std::byte{3}, std::byte{0}, std::byte{1}, std::byte{5}},
      encode_delta({{2, 4, 5, 900}, {3}}, before));
  add("delta/none", {std::byte{0}}, encode_delta({}, {}));
  add("delta/set", {std::byte{0}}, encode_delta({{5, 6, 7, 8, 70, 7000}, {}}, {}));
  SharedKey another;
  add("handshake/another key", {std::byte{0}}, first_flight(another));
  add("handshake/no key", {std::byte{0}}, encode(sample_hello(Role::switch_0)));
  return seeds;
}

}  // namespace triptych::fuzz
