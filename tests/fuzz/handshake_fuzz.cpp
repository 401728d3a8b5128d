// What a stranger can say to a listener before it is known: bytes to one end of TLS, the callee's above all.
#include "fuzz_target.hpp"
#include "protocol/link.hpp"
#include "protocol/memory_connection.hpp"
#include "protocol/tls.hpp"

#include <algorithm>
#include <asio/executor_work_guard.hpp>
#include <cstdlib>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace triptych;
  if (size == 0) return 0;
  SharedKey key;
  key.bytes.fill(5);
  asio::io_context context;
  const auto work = asio::make_work_guard(context);
  const auto [stranger, own] = memory_pair(context, context);
  const auto link =
      std::make_shared<Link>(tls_connection(own, key, data[0] % 2 == 0 ? TlsSide::callee : TlsSide::caller));
  // Nobody gets in without the key.
  link->open([link](const std::string& problem) {
    if (!problem.empty()) return;
    std::abort();
  });
  auto rest = std::as_bytes(std::span(data + 1, size - 1));
  while (!rest.empty()) {
    const auto piece = rest.first(std::min<size_t>(rest.size(), 700));
    rest = rest.subspan(piece.size());
    if (!stranger->write(piece, std::chrono::milliseconds(0)).empty()) break;
    context.poll();
  }
  link->close();
  stranger->close();
  context.poll();
  return 0;
}
