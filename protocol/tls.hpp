// Encryption with a key that the roles share: TLS 1.3 (RFC 8446) with an external pre-shared key, by OpenSSL,
// without sockets.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace triptych {

/// What whoever may take a role knows.
struct SharedKey {
  std::array<unsigned char, 32> bytes{};
};

/// The SHA-256 of what the file holds, white space at its end aside. Error (place: the path) for less than 32
/// bytes, and for a file that others than its owner may read.
SharedKey read_key_file(const std::filesystem::path& path);

/// One end of an encrypted connection: bytes of the network in and out, bytes of messages in and out.
class TlsStream {
 public:
  enum class Side { caller, callee };
  TlsStream(const SharedKey& key, Side side);
  ~TlsStream();
  TlsStream(const TlsStream&) = delete;
  TlsStream& operator=(const TlsStream&) = delete;

  /// Bytes that came over the network; what they say is appended to `plain`. Error where they are no TLS,
  /// were changed, or come from somebody with another key.
  void take(std::span<const std::byte> bytes, std::vector<std::byte>& plain);
  /// The handshake is over: each side has shown that it knows the key.
  bool established() const;
  /// What has to go over the network now: the handshake's part. A caller's first is there from the beginning.
  std::vector<std::byte> to_send();
  /// Encrypts a message's bytes. The stream must be established.
  std::vector<std::byte> seal(std::span<const std::byte> plain);

 private:
  void shake_hands();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace triptych
