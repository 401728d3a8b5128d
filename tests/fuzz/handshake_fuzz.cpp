// What a stranger can say to a listener before it is known: bytes to the callee's end of TLS and to the
// reader of hellos behind it.
#include "base/error.hpp"
#include "fuzz_target.hpp"
#include "protocol/message_reader.hpp"
#include "protocol/tls.hpp"

#include <cstdlib>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace triptych;
  if (size == 0) return 0;
  SharedKey key;
  key.bytes.fill(5);
  TlsStream callee(key, data[0] % 2 == 0 ? TlsStream::Side::callee : TlsStream::Side::caller);
  MessageReader reader;
  auto rest = std::as_bytes(std::span(data + 1, size - 1));
  try {
    while (!rest.empty()) {
      const auto piece = rest.first(std::min<size_t>(rest.size(), 700));
      rest = rest.subspan(piece.size());
      callee.take(piece, reader.bytes());
      callee.to_send();
      // Nobody gets in without the key.
      if (callee.established() || !reader.bytes().empty()) std::abort();
    }
  } catch (const Error&) {
  }
  return 0;
}
