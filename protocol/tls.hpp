// Encryption with a key that the roles share: TLS 1.3 (RFC 8446) with an external pre-shared key, by Asio and
// OpenSSL, over any other connection.
#pragma once

#include "protocol/connection.hpp"

#include <array>
#include <filesystem>
#include <memory>

namespace triptych {

/// The secret that all roles of a session share.
struct SharedKey {
  std::array<unsigned char, 32> bytes{};
};

/// The SHA-256 of the file's content without white space at its end. Error (place: the path) for less than 32
/// bytes, and for a file that others than its owner may read.
SharedKey read_key_file(const std::filesystem::path& path);

enum class TlsSide { caller, callee };

/// One end of an encrypted connection, which goes over `below`. open() is the handshake: after it each side
/// has shown that it knows the key. Bytes that are not TLS, were changed, or were encrypted with another key
/// are a problem of open() or of the read.
std::shared_ptr<Connection> tls_connection(std::shared_ptr<Connection> below, const SharedKey& key,
                                           TlsSide side);

}  // namespace triptych
