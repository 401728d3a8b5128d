// A small web server on this machine that gives ranges of a file, as well or as badly as a test wants.
#pragma once

#include <algorithm>
#include <arpa/inet.h>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <mutex>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace triptych::test {

class RangeServer {
 public:
  explicit RangeServer(std::string content) : content_(std::move(content)) {
    ::setenv("no_proxy", "127.0.0.1", 1);
    listener_ = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(listener_, reinterpret_cast<sockaddr*>(&address), size);
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    ::listen(listener_, 64);
    acceptor_ = std::thread([this] { accept(); });
  }
  ~RangeServer() {
    ending_ = true;
    ::shutdown(listener_, SHUT_RDWR);
    acceptor_.join();
    {
      const std::lock_guard lock(mutex_);
      for (const int socket : sockets_) ::shutdown(socket, SHUT_RDWR);
    }
    for (std::thread& thread : threads_) thread.join();
    ::close(listener_);
  }
  RangeServer(const RangeServer&) = delete;
  RangeServer& operator=(const RangeServer&) = delete;

  std::string address(const std::string& name = "model.tpk") const {
    return "http://127.0.0.1:" + std::to_string(port_) + "/" + name;
  }
  uint64_t requests() const { return requests_; }
  uint64_t bytes_sent() const { return bytes_; }
  void change(std::string content, std::string etag) {
    const std::lock_guard lock(mutex_);
    content_ = std::move(content);
    etag_ = std::move(etag);
  }

  std::atomic<int> delay_ms{0};   ///< before each answer
  std::atomic<int> cut_every{0};  ///< every so many answers break off in the middle; 0: none does
  std::atomic<bool> has_ranges{true};
  std::atomic<int> status{0};        ///< answered to all; 0: what is right
  std::atomic<int> busy_answers{0};  ///< so many 503 come first

 private:
  void accept() {
    for (;;) {
      const int socket = ::accept(listener_, nullptr, nullptr);
      if (socket < 0 || ending_) {
        if (socket >= 0) ::close(socket);
        return;
      }
      const std::lock_guard lock(mutex_);
      sockets_.push_back(socket);
      threads_.emplace_back([this, socket] { serve(socket); });
    }
  }

  void serve(int socket) {
    std::string buffer;
    char bytes[4096];
    for (ssize_t count; (count = ::recv(socket, bytes, sizeof bytes, 0)) > 0;) {
      buffer.append(bytes, static_cast<size_t>(count));
      for (size_t end; (end = buffer.find("\r\n\r\n")) != std::string::npos;) {
        const bool goes_on = answer(socket, buffer.substr(0, end + 2));
        buffer.erase(0, end + 4);
        if (!goes_on) {
          ::shutdown(socket, SHUT_RDWR);
          return;
        }
      }
    }
  }

  static std::string header(const std::string& request, const std::string& name) {
    const size_t at = request.find("\r\n" + name + ": ");
    if (at == std::string::npos) return "";
    const size_t begin = at + name.size() + 4;
    return request.substr(begin, request.find("\r\n", begin) - begin);
  }
  static bool send(int socket, const std::string& text) {
    for (size_t sent = 0; sent < text.size();) {
      const ssize_t count = ::send(socket, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) return false;
      sent += static_cast<size_t>(count);
    }
    return true;
  }

  /// False where the connection ends here.
  bool answer(int socket, const std::string& request) {
    const uint64_t number = ++requests_;
    if (delay_ms > 0) std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
    std::string content, etag;
    {
      const std::lock_guard lock(mutex_);
      content = content_;
      etag = etag_;
    }
    const auto plain = [&](int code) {
      return send(socket, "HTTP/1.1 " + std::to_string(code) + " X\r\nContent-Length: 0\r\n\r\n");
    };
    if (status != 0) return plain(status);
    if (busy_answers > 0 && busy_answers-- > 0) return plain(503);
    const std::string range = header(request, "Range"), only_if = header(request, "If-Range");
    unsigned long long from = 0, to = 0;
    const bool whole = !has_ranges || std::sscanf(range.c_str(), "bytes=%llu-%llu", &from, &to) != 2 ||
                       (!only_if.empty() && only_if != etag);
    if (!whole && from >= content.size()) return plain(416);
    to = whole ? content.size() - 1 : std::min<unsigned long long>(to, content.size() - 1);
    const std::string body = content.substr(from, to - from + 1);
    std::string head = whole ? "HTTP/1.1 200 OK\r\n" : "HTTP/1.1 206 Partial Content\r\n";
    if (!whole) {
      head += "Content-Range: bytes " + std::to_string(from) + "-" + std::to_string(to) + "/" +
              std::to_string(content.size()) + "\r\n";
    }
    head += "ETag: " + etag + "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n";
    const bool cut = cut_every > 0 && number % static_cast<uint64_t>(cut_every.load()) == 0;
    const std::string sent = cut ? body.substr(0, body.size() / 2) : body;
    bytes_ += sent.size();
    return send(socket, head + sent) && !cut;
  }

  std::string content_, etag_ = "\"first\"";
  int listener_ = -1;
  uint16_t port_ = 0;
  std::atomic<bool> ending_{false};
  std::atomic<uint64_t> requests_{0}, bytes_{0};
  std::mutex mutex_;
  std::vector<int> sockets_;
  std::vector<std::thread> threads_;
  std::thread acceptor_;
};

}  // namespace triptych::test
