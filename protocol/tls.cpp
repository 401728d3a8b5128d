#include "protocol/tls.hpp"

#include "base/error.hpp"
#include "base/file.hpp"

#include <cstring>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/ssl.h>
#include <sys/stat.h>

namespace triptych {

namespace {

constexpr const char* identity = "triptych";
constexpr std::array<unsigned char, 2> aes_128_gcm_sha256 = {0x13, 0x01};
constexpr int longest_take = 1 << 16;

template <auto release>
struct Deleter {
  template <typename Object>
  void operator()(Object* object) const {
    release(object);
  }
};
using Context = std::unique_ptr<SSL_CTX, Deleter<SSL_CTX_free>>;
using Connection = std::unique_ptr<SSL, Deleter<SSL_free>>;

/// The session that both sides would have had, had they met before.
SSL_SESSION* session_of(SSL* connection) {
  const auto* key = static_cast<const SharedKey*>(SSL_get_app_data(connection));
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

Context make_context() {
  Context context(SSL_CTX_new(TLS_method()));
  if (!context || SSL_CTX_set_min_proto_version(context.get(), TLS1_3_VERSION) != 1 ||
      SSL_CTX_set_ciphersuites(context.get(), "TLS_AES_128_GCM_SHA256") != 1 ||
      SSL_CTX_set_num_tickets(context.get(), 0) != 1) {
    fail("TLS", "OpenSSL does not offer it");
  }
  SSL_CTX_set_psk_use_session_callback(context.get(), use_session);
  SSL_CTX_set_psk_find_session_callback(context.get(), find_session);
  return context;
}

SSL_CTX* shared_context() {
  static const Context context = make_context();
  return context.get();
}

}  // namespace

SharedKey read_key_file(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    fail(path.string(), "others may read this key; chmod 600 makes it yours alone");
  std::string text = read_text_file(path);
  while (!text.empty() && std::strchr(" \t\r\n", text.back()) != nullptr) text.pop_back();
  constexpr size_t least = 32;
  if (text.size() < least) {
    fail(path.string(), "a key of {} bytes, at least {} are wanted; openssl rand -hex 32 makes one",
         text.size(), least);
  }
  SharedKey key;
  size_t length = 0;
  if (EVP_Q_digest(nullptr, "SHA256", nullptr, text.data(), text.size(), key.bytes.data(), &length) != 1)
    fail("TLS", "OpenSSL does not offer SHA-256");
  return key;
}

struct TlsStream::State {
  SharedKey key;
  Connection connection{SSL_new(shared_context())};
  BIO* in = BIO_new(BIO_s_mem());   ///< belongs to the connection
  BIO* out = BIO_new(BIO_s_mem());  ///< too
};

TlsStream::TlsStream(const SharedKey& key, Side side) : state_(std::make_unique<State>()) {
  state_->key = key;
  SSL* connection = state_->connection.get();
  if (connection == nullptr) fail("TLS", "no memory");
  SSL_set_bio(connection, state_->in, state_->out);
  SSL_set_app_data(connection, &state_->key);
  if (side == Side::caller) {
    SSL_set_connect_state(connection);
    shake_hands();
  } else {
    SSL_set_accept_state(connection);
  }
}

TlsStream::~TlsStream() = default;

bool TlsStream::established() const { return SSL_is_init_finished(state_->connection.get()) == 1; }

void TlsStream::shake_hands() {
  SSL* connection = state_->connection.get();
  ERR_clear_error();
  const int result = SSL_do_handshake(connection);
  if (result == 1 || SSL_get_error(connection, result) == SSL_ERROR_WANT_READ) return;
  const char* reason = ERR_reason_error_string(ERR_peek_last_error());
  fail("TLS", "the handshake failed ({}); is the key the same?", reason ? reason : "no reason given");
}

void TlsStream::take(std::span<const std::byte> bytes, std::vector<std::byte>& plain) {
  SSL* connection = state_->connection.get();
  while (!bytes.empty()) {
    const auto part = bytes.first(std::min<size_t>(bytes.size(), longest_take));
    bytes = bytes.subspan(part.size());
    if (BIO_write(state_->in, part.data(), static_cast<int>(part.size())) != static_cast<int>(part.size()))
      fail("TLS", "no memory");
    if (!established()) shake_hands();
    if (!established()) continue;
    std::array<std::byte, 1 << 14> buffer;
    for (;;) {
      ERR_clear_error();
      const int count = SSL_read(connection, buffer.data(), static_cast<int>(buffer.size()));
      if (count > 0) {
        plain.insert(plain.end(), buffer.begin(), buffer.begin() + count);
        continue;
      }
      const int problem = SSL_get_error(connection, count);
      if (problem != SSL_ERROR_WANT_READ && problem != SSL_ERROR_ZERO_RETURN)
        fail("TLS", "bytes that the peer did not encrypt");
      break;
    }
  }
}

std::vector<std::byte> TlsStream::to_send() {
  std::vector<std::byte> bytes(BIO_ctrl_pending(state_->out));
  if (!bytes.empty()) BIO_read(state_->out, bytes.data(), static_cast<int>(bytes.size()));
  return bytes;
}

std::vector<std::byte> TlsStream::seal(std::span<const std::byte> plain) {
  size_t written = 0;
  if (!plain.empty() && SSL_write_ex(state_->connection.get(), plain.data(), plain.size(), &written) != 1) {
    fail("TLS", "cannot encrypt before the handshake is over");
  }
  return to_send();
}

}  // namespace triptych
