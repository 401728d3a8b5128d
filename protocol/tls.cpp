#include "protocol/tls.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "protocol/connection_stream.hpp"

#include <asio/ssl/context.hpp>
#include <asio/ssl/error.hpp>
#include <asio/ssl/stream.hpp>
#include <asio/write.hpp>
#include <cstring>
#include <openssl/evp.h>
#include <openssl/ssl.h>
#include <sys/stat.h>

namespace triptych {

namespace {

constexpr const char* identity = "triptych";
constexpr std::array<unsigned char, 2> aes_128_gcm_sha256 = {0x13, 0x01};

/// Where a context keeps its key. Asio has its own use for what OpenSSL calls app data.
int key_index() {
  static const int index = SSL_CTX_get_ex_new_index(0, nullptr, nullptr, nullptr, nullptr);
  return index;
}

/// A TLS session made from the key, as if both sides had met before.
SSL_SESSION* session_of(SSL* connection) {
  const auto* key =
      static_cast<const SharedKey*>(SSL_CTX_get_ex_data(SSL_get_SSL_CTX(connection), key_index()));
  SSL_SESSION* session = SSL_SESSION_new();
  if (session == nullptr || SSL_SESSION_set1_master_key(session, key->bytes.data(), key->bytes.size()) != 1 ||
      SSL_SESSION_set_cipher(session, SSL_CIPHER_find(connection, aes_128_gcm_sha256.data())) != 1 ||
      SSL_SESSION_set_protocol_version(session, TLS1_3_VERSION) != 1) {
    SSL_SESSION_free(session);
    return nullptr;
  }
  return session;
}

int use_session(SSL* connection, const EVP_MD*, const unsigned char** id, size_t* id_length,
                SSL_SESSION** session) {
  *session = session_of(connection);
  *id = reinterpret_cast<const unsigned char*>(identity);
  *id_length = std::strlen(identity);
  return *session != nullptr;
}

int find_session(SSL* connection, const unsigned char* id, size_t id_length, SSL_SESSION** session) {
  const bool known = id_length == std::strlen(identity) && std::memcmp(id, identity, id_length) == 0;
  *session = known ? session_of(connection) : nullptr;
  return 1;
}

/// A context that knows the key, which must outlive it.
asio::ssl::context make_context(SharedKey& key) {
  asio::ssl::context context(asio::ssl::context::tlsv13);
  SSL_CTX* native = context.native_handle();
  if (SSL_CTX_set_ex_data(native, key_index(), &key) != 1 ||
      SSL_CTX_set_min_proto_version(native, TLS1_3_VERSION) != 1 ||
      SSL_CTX_set_ciphersuites(native, "TLS_AES_128_GCM_SHA256") != 1 ||
      SSL_CTX_set_num_tickets(native, 0) != 1) {
    fail("TLS", "OpenSSL does not offer it");
  }
  SSL_CTX_set_psk_use_session_callback(native, use_session);
  SSL_CTX_set_psk_find_session_callback(native, find_session);
  return context;
}

class TlsConnection : public Connection, public std::enable_shared_from_this<TlsConnection> {
 public:
  TlsConnection(std::shared_ptr<Connection> below, const SharedKey& key, TlsSide side)
      : key_(key), tls_(make_context(key_)), side_(side), stream_(ConnectionStream(std::move(below)), tls_) {}

  void open(Opened done) override {
    const auto role =
        side_ == TlsSide::caller ? asio::ssl::stream_base::client : asio::ssl::stream_base::server;
    stream_.async_handshake(role,
                            [self = shared_from_this(), done = std::move(done)](asio::error_code error) {
                              self->established_ = !error;
                              done(self->problem_of(error, true));
                            });
  }

  void read_some(std::span<std::byte> into, Read done) override {
    stream_.async_read_some(
        asio::buffer(into.data(), into.size()),
        [self = shared_from_this(), done = std::move(done)](asio::error_code error, size_t count) {
          done(error ? 0 : count, self->problem_of(error, false));
        });
  }

  std::string write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override {
    if (!established_) return "is not encrypted yet";
    stream_.next_layer().limit_writing(timeout);
    asio::error_code error;
    asio::write(stream_, asio::buffer(bytes.data(), bytes.size()), error);
    return problem_of(error, false);
  }

  void close() override { below().close(); }
  asio::io_context& context() override { return stream_.next_layer().below().context(); }
  const std::string& place() const override { return below().place(); }
  TcpFigures kernel_figures() const override { return below().kernel_figures(); }

 private:
  Connection& below() const { return stream_.next_layer().below(); }

  std::string problem_of(const asio::error_code& error, bool in_handshake) const {
    if (!error) return {};
    std::string problem = stream_.next_layer().problem();
    const bool ended = error == asio::error::eof || error == asio::ssl::error::stream_truncated;
    if (problem.empty() && ended) problem = closed_by_peer;
    if (in_handshake && !problem.empty()) return problem + " in the TLS handshake; is the key the same?";
    if (!problem.empty()) return problem;
    if (!in_handshake) return "TLS: bytes that the peer did not encrypt";
    return fmt::format("{} ({}); is the key the same?", handshake_failed, error.message());
  }

  SharedKey key_;
  asio::ssl::context tls_;
  TlsSide side_;
  asio::ssl::stream<ConnectionStream> stream_;
  bool established_ = false;
};

}  // namespace

SharedKey read_key_file(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    fail(path.string(), "others may read this key; chmod 600 prevents that");
  std::string text = read_text_file(path);
  while (!text.empty() && std::strchr(" \t\r\n", text.back()) != nullptr) text.pop_back();
  constexpr size_t min_bytes = 32;
  if (text.size() < min_bytes) {
    fail(path.string(), "a key of {} bytes, at least {} are needed; openssl rand -hex 32 makes one",
         text.size(), min_bytes);
  }
  SharedKey key;
  size_t length = 0;
  if (EVP_Q_digest(nullptr, "SHA256", nullptr, text.data(), text.size(), key.bytes.data(), &length) != 1)
    fail("TLS", "OpenSSL does not offer SHA-256");
  return key;
}

std::shared_ptr<Connection> tls_connection(std::shared_ptr<Connection> below, const SharedKey& key,
                                           TlsSide side) {
  return std::make_shared<TlsConnection>(std::move(below), key, side);
}

}  // namespace triptych
