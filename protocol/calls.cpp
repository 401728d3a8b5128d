#include "protocol/calls.hpp"

#include <asio/connect.hpp>
#include <asio/steady_timer.hpp>

namespace triptych {

using asio::ip::tcp;

Calls::Calls(asio::io_context& context, const SharedKey* key, Introduce introduce, Answered answered,
             std::map<Role, std::string>& last_failure)
    : context_(context),
      key_(key),
      introduce_(std::move(introduce)),
      answered_(std::move(answered)),
      last_failure_(last_failure) {}

void Calls::call(Role role, const Address& address) {
  asio::error_code error;
  tcp::resolver resolver(context_);
  endpoints_[role] = resolver.resolve(address.host, std::to_string(address.port), error);
  if (error) fail(to_text(address), "{}", error.message());
  dial(role, Channel::camera);
}

void Calls::dial(Role role, Channel channel) {
  auto socket = std::make_shared<tcp::socket>(context_);
  const auto connected = [=, this](const asio::error_code& error, const tcp::endpoint& endpoint) {
    if (error) return redial(role, channel, error.message());
    const auto link = std::make_shared<Link>(std::move(*socket),
                                             to_text({endpoint.address().to_string(), endpoint.port()}));
    if (key_ == nullptr) return introduce(link, role, channel);
    waiting_[role] = link;
    link->secure(*key_, TlsStream::Side::caller, [=, this](const std::string& problem) {
      if (problem.empty()) return introduce(link, role, channel);
      waiting_.erase(role);
      link->close();
      redial(role, channel, problem);
    });
  };
  asio::async_connect(*socket, endpoints_.at(role), connected);
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
  if (!problem.empty()) return redial(role, channel, problem);
  waiting_[role] = link;
  link->read(hello_body_limit, [=, this](Link::Outcome outcome) {
    waiting_.erase(role);
    const auto* broken = std::get_if<Link::Broken>(&outcome);
    const std::string failure =
        broken ? broken->reason : answered_(link, role, std::get<Link::Arrived>(outcome).message);
    if (!failure.empty()) {
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
