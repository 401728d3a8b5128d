#include "protocol/memory_connection.hpp"

#include <algorithm>
#include <array>
#include <asio/post.hpp>
#include <deque>
#include <mutex>
#include <vector>

namespace triptych {

using Clock = std::chrono::steady_clock;

/// What both ends share. Posts to an end's io_context happen under the lock and before that end is closed,
/// and an end is closed before its io_context is destroyed.
struct MemoryWire::State {
  struct Side {
    asio::io_context* context = nullptr;  ///< none: not taken yet, or closed
    bool closed = false;
    std::deque<std::byte> arrived;
    std::span<std::byte> into;
    Connection::Read reading;     ///< empty: no read is under way
    bool wants_to_write = false;  ///< waits for space at the other side
  };

  explicit State(size_t with_capacity) : capacity(with_capacity) {}

  /// With the lock held: makes the side's thread look again.
  static void wake(const std::shared_ptr<State>& state, size_t side) {
    if (state->sides[side].context == nullptr) return;
    asio::post(*state->sides[side].context, [state, side] { deliver(*state, side); });
  }
  static void deliver(State& state, size_t index) {
    Side& side = state.sides[index];
    Side& other = state.sides[1 - index];
    Connection::Read done;
    size_t count = 0;
    {
      const std::lock_guard lock(state.mutex);
      if (!side.reading || (side.arrived.empty() && !other.closed)) return;
      count = std::min(side.into.size(), side.arrived.size());
      const auto end = side.arrived.begin() + static_cast<std::ptrdiff_t>(count);
      std::copy(side.arrived.begin(), end, side.into.begin());
      side.arrived.erase(side.arrived.begin(), end);
      done = std::exchange(side.reading, nullptr);
      if (std::exchange(other.wants_to_write, false) && other.context != nullptr)
        asio::post(*other.context, [] {});
    }
    done(count, count == 0 ? closed_by_peer : "");
  }

  const size_t capacity;
  std::mutex mutex;
  std::array<Side, 2> sides;
};

class MemoryWire::MemoryConnection : public Connection {
 public:
  MemoryConnection(std::shared_ptr<State> state, size_t side, asio::io_context& context, std::string place)
      : state_(std::move(state)), side_(side), context_(context), place_(std::move(place)) {
    const std::lock_guard lock(state_->mutex);
    own().context = &context;
  }
  ~MemoryConnection() override { MemoryConnection::close(); }

  void read_some(std::span<std::byte> into, Read done) override {
    const std::lock_guard lock(state_->mutex);
    if (own().closed) return;
    own().into = into;
    own().reading = std::move(done);
    State::wake(state_, side_);
  }

  std::string write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override {
    const auto deadline = Clock::now() + timeout;
    for (;;) {
      {
        const std::lock_guard lock(state_->mutex);
        if (own().closed) return "is closed";
        if (other().closed) return closed_by_peer;
        const size_t room = state_->capacity - std::min(state_->capacity, other().arrived.size());
        const auto part = bytes.first(std::min(bytes.size(), room));
        other().arrived.insert(other().arrived.end(), part.begin(), part.end());
        bytes = bytes.subspan(part.size());
        if (!part.empty()) State::wake(state_, 1 - side_);
        if (bytes.empty()) return {};
        own().wants_to_write = true;
      }
      if (Clock::now() >= deadline) return not_taken(timeout);
      context_.run_one_until(deadline);
    }
  }

  void close() override {
    Read dropped;  // destroyed without the lock: it may hold this connection
    const std::lock_guard lock(state_->mutex);
    if (std::exchange(own().closed, true)) return;
    dropped = std::exchange(own().reading, nullptr);
    own().context = nullptr;
    other().wants_to_write = false;
    State::wake(state_, 1 - side_);
  }

  asio::io_context& context() override { return context_; }
  const std::string& place() const override { return place_; }

 private:
  State::Side& own() { return state_->sides[side_]; }
  State::Side& other() { return state_->sides[1 - side_]; }

  std::shared_ptr<State> state_;
  size_t side_;
  asio::io_context& context_;
  std::string place_;
};

MemoryWire::MemoryWire(size_t capacity) : state_(std::make_shared<State>(capacity)) {}

std::shared_ptr<Connection> MemoryWire::take(End end, asio::io_context& context, std::string place) const {
  return std::make_shared<MemoryConnection>(state_, end == End::caller ? 0 : 1, context, std::move(place));
}

std::pair<std::shared_ptr<Connection>, std::shared_ptr<Connection>> memory_pair(asio::io_context& caller,
                                                                                asio::io_context& callee,
                                                                                size_t capacity) {
  const MemoryWire wire(capacity);
  return {wire.take(MemoryWire::End::caller, caller, "memory"),
          wire.take(MemoryWire::End::callee, callee, "memory")};
}

}  // namespace triptych
