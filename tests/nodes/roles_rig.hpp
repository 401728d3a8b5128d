// A render node and two switch nodes in one process, each in a thread with a context of its own, over
// connections in memory that a test can spoil.
#pragma once

#include "base/hashing.hpp"
#include "nodes/local_pipeline.hpp"
#include "nodes/render_node.hpp"
#include "nodes/switch_node.hpp"
#include "protocol/connect.hpp"
#include "protocol/memory_network.hpp"
#include "tests/protocol/sample_messages.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_device.hpp"

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <functional>
#include <future>
#include <gtest/gtest.h>
#include <mutex>
#include <thread>

namespace triptych::test {

/// Runs jobs, one after the other, in a thread that has a context where the device needs one.
class ContextThread {
 public:
  ContextThread() {
    std::promise<void> made;
    auto ready = made.get_future();
    thread_ = std::thread([this, &made] {
      const ChosenDevice device = choose_device(test::wanted_device());
      made.set_value();
      work();
    });
    ready.wait();
  }
  ~ContextThread() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  template <typename Job>
  auto run(Job job) {
    auto task = std::make_shared<std::packaged_task<std::invoke_result_t<Job>()>>(std::move(job));
    {
      const std::lock_guard lock(mutex_);
      jobs_.emplace_back([task] { (*task)(); });
    }
    changed_.notify_all();
    return task->get_future();
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return !jobs_.empty() || ending_; });
      if (jobs_.empty()) return;
      auto job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job();
      lock.lock();
    }
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  bool ending_ = false;
  std::thread thread_;
};

/// A connection's caller's end; what it writes passes a test's hands. `before` is asked with each message's
/// number, from 0: false closes the connection instead.
class SpoiledConnection : public Connection {
 public:
  using Before = std::function<bool(uint32_t message)>;
  SpoiledConnection(std::shared_ptr<Connection> below, Before before)
      : below_(std::move(below)), before_(std::move(before)) {}
  void read_some(std::span<std::byte> into, Read done) override { below_->read_some(into, std::move(done)); }
  std::string write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override {
    if (!before_(messages_++)) {
      below_->close();
      return "cut by the test";
    }
    return below_->write(bytes, timeout);
  }
  void close() override { below_->close(); }
  asio::io_context& context() override { return below_->context(); }
  const std::string& place() const override { return below_->place(); }

 private:
  std::shared_ptr<Connection> below_;
  Before before_;
  uint32_t messages_ = 0;
};

/// The views of a path, over and over.
class Frames : public FrameSource {
 public:
  /// like: how frames are drawn besides.
  Frames(const std::vector<View>& views, uint32_t first, uint32_t count, const FrameState& like = {})
      : views_(views), numbers_{first, count}, state_(like) {}
  Numbers numbers() const override { return numbers_; }
  FrameRequest next(uint32_t number) override {
    state_.view = views_[number % views_.size()];
    next_ = number + 1;
    FrameRequest frame{number, state_};
    if (like_frame) like_frame(frame);
    return frame;
  }
  /// What is different in each frame.
  std::function<void(FrameRequest&)> like_frame;
  /// Whether there is nothing to draw before this frame just now; asked again and again.
  std::function<bool(uint32_t next)> rests;
  bool ready(bool may_wait) override {
    if (!rests || !rests(next_)) return true;
    if (may_wait) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return false;
  }

 private:
  const std::vector<View>& views_;
  Numbers numbers_;
  FrameState state_;
  uint32_t next_ = 0;
};

/// What the render node drew.
class Pictures : public FrameSink {
 public:
  void picture(FrameRecord record, const FrameTarget& target) override {
    const auto colors = target.read_colors();
    record.picture_hash = hash_values(std::span<const uint8_t>(colors));
    const uint32_t number = record.number;
    records.push_back(std::move(record));
    if (after) after(number);
  }
  void show(const FrameRequest&, const FrameRecord&, LocalPipeline& stages) override {
    if (on_show) on_show(stages);
  }
  void epoch_ended(const Mailbox&, const std::string& reason) override { endings.push_back(reason); }
  void clocks(const std::vector<PeerClock>& clocks) override { clocks_heard += clocks.size(); }

  std::function<void(LocalPipeline&)> on_show;  ///< called before that
  std::function<void(uint32_t)> after;  ///< called in the render node's thread, with the number of each frame
  std::vector<FrameRecord> records;
  std::vector<std::string> endings;
  size_t clocks_heard = 0;
};

class Roles : public testing::Test {
 protected:
  static constexpr int side = 64;
  static constexpr std::chrono::milliseconds patience{10'000};

  Roles()
      : network([this](Role caller, Role callee, std::shared_ptr<Connection> connection) {
          return spoil ? spoil(caller, callee, std::move(connection)) : connection;
        }) {
    pack();  // made once, before the roles' threads ask for it
  }

  static ContextThread& thread(Role role) {
    static std::array<ContextThread, 3> threads;
    return threads[static_cast<size_t>(role)];
  }
  static const Pack& pack() { return scenes::pack_with_objects("room"); }
  static const std::vector<View>& views() {
    static const std::vector<View> found = [] {
      auto all = scenes::path(pack().skeleton(), side, side);
      all.resize(std::min<size_t>(all.size(), 24));
      return all;
    }();
    return found;
  }
  /// What each frame of the path has to look like: the whole cut, drawn in one process.
  static const std::vector<uint64_t>& right() {
    static const std::vector<uint64_t> hashes = thread(Role::render).run([] { return whole_cuts({}); }).get();
    return hashes;
  }
  static std::vector<uint64_t> whole_cuts(FrameState state) {
    std::vector<uint64_t> hashes;
    LocalPipeline pipeline(
        pack(), {.width = side, .height = side, .cull = StrategyKind::frustum, .device = wanted_device()});
    for (uint32_t i = 0; i < views().size(); ++i) {
      state.view = views()[i];
      pipeline.draw({i, state});
      const auto colors = pipeline.target().read_colors();
      hashes.push_back(hash_values(std::span<const uint8_t>(colors)));
    }
    return hashes;
  }

  Hello hello(Role role) const {
    Hello hello = sample_hello(role);
    hello.pack_hash = pack().content_hash();
    return hello;
  }
  std::unique_ptr<Mailbox> connect(const Hello& own, const std::function<bool()>& stop) {
    auto mailbox = mailbox_or_error(connect_session(
        own, [&](asio::io_context& context) { return network.endpoint(own.role, context); }, patience, stop));
    if (mailbox && equip) equip(own.role, *mailbox);
    return mailbox;
  }

  /// A switch node, until the session is over or it is told to stop; what it did.
  std::future<SwitchNodeSummary> start_switch(Role role) { return start_switch(hello(role)); }
  std::future<SwitchNodeSummary> start_switch(const Hello& own) {
    const Role role = own.role;
    stopped(role) = false;
    return thread(role).run([this, own, role] {
      const auto stop = [this, role] { return stopped(role) || over; };
      EpochSink sink;
      SwitchNodeOptions options;
      options.device = wanted_device();
      options.device.memory = caps;
      options.cull.packet_ids = 4;
      options.connect = [&](bool) { return connect(own, stop); };
      options.session_rules = rules[static_cast<size_t>(role)];
      options.stop = stop;
      return run_switch_node(pack(), role, sink, options);
    });
  }
  /// A render node, from a frame to a frame. When it is done the session is over.
  std::future<RenderNodeSummary> start_render(uint32_t count, uint32_t first = 0) {
    return thread(Role::render).run([this, count, first] {
      const auto stop = [this] { return stopped(Role::render).load(); };
      Frames frames(views(), first, count, like);
      frames.rests = rests;
      frames.like_frame = like_frame;
      RenderNodeOptions options;
      options.timeout = timeout;
      options.device = wanted_device();
      options.device.memory = caps;
      options.no_pixel_error = no_pixel_error;
      options.cull.packet_ids = 4;
      options.connect = [&](const std::function<bool()>& give_up) {
        if (searches_that_fail-- > 0) fail("the network", "is down");
        return connect(hello(Role::render), give_up);
      };
      options.gather = gather;
      options.successor = first > 0;
      options.session_rules = rules[0];
      options.stop = stop;
      return run_render_node(pack(), frames, pictures, options);
    });
  }
  /// All three roles to the end of so many frames.
  RenderNodeSummary run_all(uint32_t count) {
    right();  // drawn by the render node's thread, too
    over = false;
    auto render = start_render(count);
    auto switch_0 = start_switch(Role::switch_0), switch_1 = start_switch(Role::switch_1);
    render.wait();
    over = true;
    switches = {switch_0.get(), switch_1.get()};
    return render.get();
  }
  std::atomic<bool>& stopped(Role role) { return stopped_[static_cast<size_t>(role)]; }

  /// Every frame is there, once, in order, and looks as it has to.
  void expect_right_pictures(uint32_t count) const {
    ASSERT_EQ(pictures.records.size(), count);
    size_t wrong = 0;
    for (uint32_t i = 0; i < count; ++i) {
      EXPECT_EQ(pictures.records[i].number, i);
      wrong += pictures.records[i].picture_hash != right()[i % right().size()];
    }
    EXPECT_EQ(wrong, 0u);
  }
  size_t mismatches() const {
    size_t count = 0;
    for (const FrameRecord& record : pictures.records) count += record.digest_mismatch;
    return count;
  }
  /// Why the render node first went on alone; empty where it never did.
  std::string first_loss() const {
    for (const FrameRecord& record : pictures.records) {
      if (!record.lost.empty()) return record.lost;
    }
    return "";
  }

  MemoryNetwork::Wrapper spoil;                   ///< what becomes of a caller's end
  std::function<void(Role, Mailbox&)> equip;      ///< what becomes of a mailbox
  std::function<bool(uint32_t next)> rests;       ///< whether there is nothing to draw before a frame
  FrameState like;                                ///< how frames are drawn, but for their views
  std::function<void(FrameRequest&)> like_frame;  ///< what is different in each
  std::array<SessionRules, 3> rules;
  MemoryCaps caps;  ///< of each role
  MemoryKeeper::NoPixelError no_pixel_error = MemoryKeeper::NoPixelError::fails;
  std::chrono::milliseconds timeout = patience;  ///< the render node's, for a frame
  std::chrono::milliseconds gather = patience;   ///< and before the first one
  std::atomic<int> searches_that_fail{0};        ///< of the render node
  std::atomic<bool> over{false};
  Pictures pictures;
  std::array<SwitchNodeSummary, 2> switches;
  MemoryNetwork network;

 private:
  std::array<std::atomic<bool>, 3> stopped_{};
};

}  // namespace triptych::test
