#include "protocol/callers.hpp"

namespace triptych {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto silence_limit = std::chrono::seconds(5);  ///< for a caller's Hello
constexpr size_t max_waiting = 16;

}  // namespace

void Callers::accept() {
  endpoint_.accept([this](std::shared_ptr<Connection> connection) {
    greet(std::make_shared<Link>(std::move(connection)));
  });
}

void Callers::greet(const std::shared_ptr<Link>& caller) {
  if (waiting_.size() == max_waiting) {
    waiting_.front().link->close();
    waiting_.pop_front();
  }
  waiting_.push_back({caller, Clock::now()});
  caller->open([this, caller](const std::string& problem) {
    if (problem.empty()) return hear(caller);
    forget(caller);
    caller->close();
  });
}

void Callers::hear(const std::shared_ptr<Link>& caller) {
  caller->read(hello_body_limit, [this, caller](Link::Outcome outcome) {
    forget(caller);
    const auto* arrived = std::get_if<Link::Arrived>(&outcome);
    heard_(caller, arrived == nullptr ? nullptr : std::get_if<Hello>(&arrived->message));
  });
}

void Callers::forget(const std::shared_ptr<Link>& caller) {
  std::erase_if(waiting_, [&](const Caller& other) { return other.link == caller; });
}

void Callers::drop_silent() {
  while (!waiting_.empty() && Clock::now() - waiting_.front().since > silence_limit) {
    waiting_.front().link->close();
    waiting_.pop_front();
  }
}

void Callers::close() {
  for (const Caller& caller : waiting_) caller.link->close();
}

}  // namespace triptych
