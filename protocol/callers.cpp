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
    heard_(caller, nullptr, problem);
  });
}

void Callers::hear(const std::shared_ptr<Link>& caller) {
  caller->read(hello_body_limit, [this, caller](Link::Outcome outcome) {
    forget(caller);
    if (const auto* broken = std::get_if<Link::Broken>(&outcome))
      return heard_(caller, nullptr, broken->reason);
    heard_(caller, std::get_if<Hello>(&std::get<Link::Arrived>(outcome).message),
           caller->place() + ": a connection starts with a hello");
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
