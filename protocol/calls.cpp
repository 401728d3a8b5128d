#include "protocol/calls.hpp"

#include <asio/steady_timer.hpp>

namespace triptych {

Calls::Calls(asio::io_context& context, Endpoint& endpoint, Introduce introduce, Answered answered,
             Hopeless hopeless, Unheard unheard, std::map<Role, std::string>& last_failure)
    : context_(context),
      endpoint_(endpoint),
      introduce_(std::move(introduce)),
      answered_(std::move(answered)),
      hopeless_(std::move(hopeless)),
      unheard_(std::move(unheard)),
      last_failure_(last_failure) {}

void Calls::dial(Role role, Channel channel) {
  endpoint_.call(role, [=, this](std::shared_ptr<Connection> connection, const Endpoint::Failure& failure) {
    if (failure.hopeless) return hopeless_(role, failure.what);
    if (!connection) return redial(role, channel, failure.what);
    const auto link = std::make_shared<Link>(std::move(connection));
    waiting_[role] = link;
    link->open([=, this](const std::string& problem) {
      if (problem.empty()) return introduce(link, role, channel);
      waiting_.erase(role);
      link->close();
      hung_up(role, channel, problem);
    });
  });
}

void Calls::hung_up(Role role, Channel channel, const std::string& failure) {
  constexpr int too_often = 3;  // a role that ends hangs up, too
  if (++hung_up_[role] == too_often) unheard_(role, failure);
  redial(role, channel, failure);
}

void Calls::redial(Role role, Channel channel, const std::string& failure) {
  last_failure_[role] = failure;
  auto timer = std::make_shared<asio::steady_timer>(context_, redial_pause);
  timer->async_wait([this, role, channel, timer](const asio::error_code& error) {
    if (!error) dial(role, channel);
  });
}

void Calls::introduce(const std::shared_ptr<Link>& link, Role role, Channel channel) {
  const Message hello = introduce_(role, channel);
  const std::string problem = link->write(hello, encode(hello), hello_timeout);
  if (!problem.empty()) {
    waiting_.erase(role);
    link->close();
    return redial(role, channel, problem);
  }
  link->read(hello_body_limit, [=, this](Link::Outcome outcome) {
    waiting_.erase(role);
    if (const auto* broken = std::get_if<Link::Broken>(&outcome)) {
      link->close();
      return hung_up(role, channel, broken->reason);
    }
    hung_up_.erase(role);
    if (const std::string failure = answered_(link, role, std::get<Link::Arrived>(outcome).message);
        !failure.empty()) {
      link->close();
      redial(role, channel, failure);
    } else if (channel == Channel::camera) {
      dial(role, Channel::nodes);
    }
  });
}

void Calls::close() {
  for (const auto& [role, link] : waiting_) link->close();
}

}  // namespace triptych
