// Calls to roles that listen, again and again until they answer.
#pragma once

#include "protocol/endpoint.hpp"
#include "protocol/link.hpp"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace triptych {

/// Between two attempts to reach a role.
constexpr auto redial_pause = std::chrono::milliseconds(50);
/// For sending a Hello.
constexpr auto hello_timeout = std::chrono::milliseconds(500);

/// Dials roles, says Hello, and hands over what they answer; the camera channel first, then the nodes
/// channel. A role that does not answer, or that closes the connection, is dialled again. For one thread.
class Calls {
 public:
  /// Makes the Hello for this role and channel.
  using Introduce = std::function<Hello(Role, Channel)>;
  /// Called within the io_context, with the first message of a callee. Returns why to try again, or an empty
  /// text if the link was taken over.
  using Answered = std::function<std::string(const std::shared_ptr<Link>&, Role, const Message&)>;
  /// Called within the io_context: the role was reached, but hung up, a few times in a row.
  using Unheard = std::function<void(Role, const std::string& why)>;
  /// Called within the io_context or call(): it is useless to try this role again.
  using Hopeless = std::function<void(Role, const std::string& why)>;

  /// last_failure: receives why each role could not be reached.
  Calls(asio::io_context& context, Endpoint& endpoint, Introduce introduce, Answered answered,
        Hopeless hopeless, Unheard unheard, std::map<Role, std::string>& last_failure);

  void call(Role role) { dial(role, Channel::camera); }
  /// Closes the connections that have not been answered yet.
  void close();

 private:
  void dial(Role role, Channel channel);
  void redial(Role role, Channel channel, const std::string& failure);
  /// After the role was reached.
  void hung_up(Role role, Channel channel, const std::string& failure);
  void introduce(const std::shared_ptr<Link>& link, Role role, Channel channel);

  asio::io_context& context_;
  Endpoint& endpoint_;
  Introduce introduce_;
  Answered answered_;
  Hopeless hopeless_;
  Unheard unheard_;
  std::map<Role, int> hung_up_;  ///< how often in a row
  std::map<Role, std::string>& last_failure_;
  std::map<Role, std::shared_ptr<Link>> waiting_;  ///< called, no answer yet
};

}  // namespace triptych
