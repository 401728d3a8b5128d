// A way between two roles that a test can spoil: bytes pass, are swallowed, or are changed.
#pragma once

#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <list>
#include <netinet/in.h>
#include <poll.h>
#include <stdexcept>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace triptych::test {

/// Listens on a loopback port of its own and carries every connection on to another one.
class Relay {
 public:
  explicit Relay(int to_port)
      : to_port_(to_port), listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof(address);
    if (::bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(listener_, 16) != 0 ||
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
      throw std::runtime_error("no port for a relay");
    }
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~Relay() {
    stop_ = true;
    thread_.join();
    for (const Pair& pair : pairs_) close(pair);
    ::close(listener_);
  }
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  int port() const { return port_; }
  /// While true nothing passes: bytes and ends of connections are swallowed, new connections stay unanswered.
  std::atomic<bool> cut{false};
  /// So many bytes later one of them is changed; then again none.
  std::atomic<int> flip_after{-1};

 private:
  struct Pair {
    int near, far;
    bool broken = false;  ///< bytes were swallowed: what follows makes no sense
  };

  static sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<uint16_t>(port));
    return address;
  }
  static void close(const Pair& pair) {
    ::close(pair.near);
    ::close(pair.far);
  }

  void accept() {
    const int near = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    const int far = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = loopback(to_port_);
    if (::connect(far, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) {
      pairs_.push_back({near, far});
    } else {
      close({near, far});
    }
  }

  /// False once the connection is over.
  bool carry(int from, int to) {
    std::array<char, 4096> bytes{};
    const ssize_t count = ::recv(from, bytes.data(), bytes.size(), 0);
    if (count <= 0) return false;
    if (flip_after >= 0 && (flip_after -= static_cast<int>(count)) < 0)
      bytes[static_cast<size_t>(count) / 2] ^= 4;
    return ::send(to, bytes.data(), static_cast<size_t>(count), MSG_NOSIGNAL) == count;
  }

  void run() {
    while (!stop_) {
      if (cut) {
        for (Pair& pair : pairs_) pair.broken = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        continue;
      }
      std::vector<pollfd> waiting = {{listener_, POLLIN, 0}};
      for (const Pair& pair : pairs_) {
        waiting.push_back({pair.near, POLLIN, 0});
        waiting.push_back({pair.far, POLLIN, 0});
      }
      if (::poll(waiting.data(), waiting.size(), 5) <= 0) continue;
      size_t next = 1;
      for (auto pair = pairs_.begin(); pair != pairs_.end();) {
        const bool near = waiting[next].revents != 0, far = waiting[next + 1].revents != 0;
        next += 2;
        if (!pair->broken && (!near || carry(pair->near, pair->far)) &&
            (!far || carry(pair->far, pair->near))) {
          ++pair;
        } else {
          close(*pair);
          pair = pairs_.erase(pair);
        }
      }
      if (waiting[0].revents != 0) accept();
    }
  }

  int to_port_, listener_, port_ = 0;
  std::list<Pair> pairs_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace triptych::test
