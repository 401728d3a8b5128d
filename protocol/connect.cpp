#include "protocol/connect.hpp"

#include "protocol/hello_difference.hpp"

#include <asio/connect.hpp>
#include <asio/steady_timer.hpp>
#include <deque>
#include <fcntl.h>
#include <thread>

namespace triptych {

namespace {

using asio::ip::tcp;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr auto silence_limit = milliseconds(5000);  ///< for the Hello of whoever called
constexpr auto hello_timeout = milliseconds(500);   ///< for sending ours
constexpr auto redial_pause = milliseconds(50);
constexpr size_t waiting_callers_limit = 16;

std::string text_of(const tcp::endpoint& endpoint) {
  return to_text({endpoint.address().to_string(), endpoint.port()});
}

/// A peer went before all had met: all begin again.
struct PeerWent {};
/// A peer said that the session is over.
struct SessionOver {};

/// One role's way into the session; its callbacks throw what ends it.
class Gathering {
 public:
  Gathering(const Hello& own, const Listener* listener, const std::map<Role, Address>& dial,
            milliseconds timeout, const SharedKey* key, std::map<Role, std::string>& last_failure);
  /// Nothing once the deadline is over or `stop` says so.
  std::unique_ptr<Mailbox> run(Clock::time_point deadline, const std::function<bool()>& stop);
  /// Who is still missing, and what is known of them.
  PeersMissing missing() const;

 private:
  void look_after_links();
  void close_strangers();
  void listen(const Listener& listener);
  void accept();
  void greet(const std::shared_ptr<Link>& caller);
  void hear(const std::shared_ptr<Link>& caller);
  void forget(const std::shared_ptr<Link>& caller);
  void answer(const std::shared_ptr<Link>& caller, const Hello& hello);
  void refuse(const std::shared_ptr<Link>& caller, const std::string& reason);

  void call(Role role, const Address& address);
  void dial(Role role, Channel channel);
  void redial(Role role, Channel channel);
  void introduce(const std::shared_ptr<Link>& link, Role role, Channel channel);
  void check_callee(const std::shared_ptr<Link>& link, Role role, const Hello& hello);

  Hello hello_for(Role peer, Channel channel) const;
  void join(const std::shared_ptr<Link>& link, const Hello& hello);
  [[noreturn]] void end(const std::shared_ptr<Link>& link, const std::string& place,
                        const std::string& reason);
  bool complete();
  bool has_all() const;

  Hello own_;
  std::map<Role, Address> dial_;
  std::map<Role, tcp::resolver::results_type> endpoints_;
  milliseconds timeout_;  ///< for what is said
  const SharedKey* key_;  ///< none: nothing is encrypted
  std::unique_ptr<Mailbox> mailbox_ = std::make_unique<Mailbox>();
  tcp::acceptor acceptor_;
  std::string listening_at_;
  struct Caller {
    std::shared_ptr<Link> link;
    Clock::time_point since;
  };
  std::deque<Caller> callers_;                     ///< accepted, no Hello yet; oldest first
  std::map<Role, std::shared_ptr<Link>> callees_;  ///< called, no answer yet
  std::map<Role, std::string>& last_failure_;  ///< why a role is not here, of this attempt and those before
};

Gathering::Gathering(const Hello& own, const Listener* listener, const std::map<Role, Address>& dial,
                     milliseconds timeout, const SharedKey* key, std::map<Role, std::string>& last_failure)
    : own_(own),
      dial_(dial),
      timeout_(timeout),
      key_(key),
      acceptor_(mailbox_->context()),
      last_failure_(last_failure) {
  for (const Role role : all_roles) {
    if (role < own.role && dial.count(role) == 0)
      fail(role_name(own.role), "no address of the {}", role_name(role));
    if (role > own.role && listener == nullptr)
      fail(role_name(own.role), "no port to listen at for the {}", role_name(role));
  }
  if (listener != nullptr && own.role != Role::switch_1) listen(*listener);
}

void Gathering::listen(const Listener& listener) {
  const int copy = ::fcntl(listener.descriptor(), F_DUPFD_CLOEXEC, 0);
  asio::error_code error;
  acceptor_.assign(listener.is_ipv6() ? tcp::v6() : tcp::v4(), copy, error);
  listening_at_ = to_text(listener.address());
  if (error) fail(listening_at_, "cannot listen: {}", error.message());
}

std::unique_ptr<Mailbox> Gathering::run(Clock::time_point deadline, const std::function<bool()>& stop) {
  try {
    if (acceptor_.is_open()) accept();
    for (const auto& [role, address] : dial_) {
      if (role < own_.role) call(role, address);
    }
    while (!complete()) {
      mailbox_->context().run_one_until(std::min(deadline, Clock::now() + milliseconds(50)));
      look_after_links();
      const bool stopped = stop && stop();
      if (!stopped && Clock::now() < deadline) continue;
      // Whoever stops a session says so; whoever waited in vain says for whom.
      mailbox_->leave(stopped ? "" : missing().what());
      close_strangers();
      return nullptr;
    }
  } catch (const Error& error) {
    mailbox_->leave(error.what());
    close_strangers();
    throw;
  } catch (const PeerWent&) {
    close_strangers();
    throw;
  } catch (const SessionOver&) {
    mailbox_->leave("");
    close_strangers();
    throw;
  }
  close_strangers();
  asio::error_code ignored;  // the listener itself stays open
  acceptor_.close(ignored);
  return std::move(mailbox_);
}

void Gathering::look_after_links() {
  while (!callers_.empty() && Clock::now() - callers_.front().since > silence_limit) {
    callers_.front().link->close();
    callers_.pop_front();
  }
  // A caller that died may come again; whom we called, and who says why, has ended the session.
  for (const Role role : all_roles) {
    for (const Channel channel : all_channels) {
      if (role > own_.role) mailbox_->forget_if_broken(role, channel);
    }
  }
  const auto end = mailbox_->first_end();
  if (!end) return;
  if (end->said_bye && end->reason.empty()) throw SessionOver();
  last_failure_[end->peer] = end->reason;
  throw PeerWent();
}

void Gathering::close_strangers() {
  for (const Caller& caller : callers_) caller.link->close();
  for (const auto& [role, link] : callees_) link->close();
}

// The side that is called: it reads a Hello, then answers with its own.

void Gathering::accept() {
  acceptor_.async_accept([this](const asio::error_code& error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) {
      asio::error_code gone;
      const auto endpoint = socket.remote_endpoint(gone);
      if (!gone) greet(std::make_shared<Link>(std::move(socket), text_of(endpoint)));
    }
    accept();
  });
}

void Gathering::greet(const std::shared_ptr<Link>& caller) {
  if (callers_.size() == waiting_callers_limit) {
    callers_.front().link->close();
    callers_.pop_front();
  }
  callers_.push_back({caller, Clock::now()});
  if (key_ == nullptr) return hear(caller);
  caller->secure(*key_, TlsStream::Side::callee, [this, caller](const std::string& problem) {
    if (problem.empty()) return hear(caller);
    forget(caller);
    caller->close();
  });
}

void Gathering::forget(const std::shared_ptr<Link>& caller) {
  std::erase_if(callers_, [&](const Caller& other) { return other.link == caller; });
}

void Gathering::hear(const std::shared_ptr<Link>& caller) {
  caller->read(hello_body_limit, [this, caller](Link::Outcome outcome) {
    forget(caller);
    const auto* arrived = std::get_if<Link::Arrived>(&outcome);
    const auto* hello = arrived == nullptr ? nullptr : std::get_if<Hello>(&arrived->message);
    if (hello == nullptr) {
      refuse(caller, "a connection starts with a hello");
    } else {
      answer(caller, *hello);
    }
  });
}

void Gathering::answer(const std::shared_ptr<Link>& caller, const Hello& hello) {
  const bool meant = hello.role > own_.role && hello.called == own_.role;
  const std::string problem = meant ? difference_between(own_, hello) : "this is the " + role_name(own_.role);
  if (!problem.empty()) {
    // Our hello shows the caller the difference.
    const Message reply = hello_for(hello.role, hello.channel);
    caller->write(reply, encode(reply), milliseconds(0));
    last_failure_[hello.role] = problem;
    return refuse(caller, problem);
  }
  if (mailbox_->has(hello.role, hello.channel)) {
    // Is the other one dead, and this its successor?
    mailbox_->context().poll();
    mailbox_->forget_if_broken(hello.role, hello.channel);
  }
  if (mailbox_->has(hello.role, hello.channel)) {
    return refuse(caller, fmt::format("the {} is connected already", role_name(hello.role)));
  }
  const Message reply = hello_for(hello.role, hello.channel);
  if (!caller->write(reply, encode(reply), hello_timeout).empty()) return caller->close();
  join(caller, hello);
}

void Gathering::refuse(const std::shared_ptr<Link>& caller, const std::string& reason) {
  const Message bye = Bye{reason};
  caller->write(bye, encode(bye), milliseconds(0));  // whether a stranger takes it does not matter
  caller->close();
}

// The side that calls: it sends its Hello, then reads the answer; the camera channel first, then the nodes
// channel.

void Gathering::call(Role role, const Address& address) {
  asio::error_code error;
  tcp::resolver resolver(mailbox_->context());
  endpoints_[role] = resolver.resolve(address.host, std::to_string(address.port), error);
  if (error) fail(to_text(address), "{}", error.message());
  dial(role, Channel::camera);
}

void Gathering::dial(Role role, Channel channel) {
  auto socket = std::make_shared<tcp::socket>(mailbox_->context());
  const auto connected = [=, this](const asio::error_code& error, const tcp::endpoint& endpoint) {
    if (error) {
      last_failure_[role] = error.message();
      return redial(role, channel);
    }
    const auto link = std::make_shared<Link>(std::move(*socket), text_of(endpoint));
    if (key_ == nullptr) return introduce(link, role, channel);
    callees_[role] = link;
    link->secure(*key_, TlsStream::Side::caller, [=, this](const std::string& problem) {
      if (problem.empty()) return introduce(link, role, channel);
      callees_.erase(role);
      link->close();
      last_failure_[role] = problem;
      redial(role, channel);
    });
  };
  asio::async_connect(*socket, endpoints_.at(role), connected);
}

void Gathering::redial(Role role, Channel channel) {
  auto timer = std::make_shared<asio::steady_timer>(mailbox_->context(), redial_pause);
  timer->async_wait([this, role, channel, timer](const asio::error_code& error) {
    if (!error) dial(role, channel);
  });
}

void Gathering::introduce(const std::shared_ptr<Link>& link, Role role, Channel channel) {
  const Message hello = hello_for(role, channel);
  const std::string problem = link->write(hello, encode(hello), hello_timeout);
  if (!problem.empty()) {
    last_failure_[role] = problem;
    return redial(role, channel);
  }
  callees_[role] = link;
  link->read(hello_body_limit, [=, this](Link::Outcome outcome) {
    callees_.erase(role);
    if (const auto* broken = std::get_if<Link::Broken>(&outcome)) {
      link->close();
      last_failure_[role] = broken->reason;
      return redial(role, channel);
    }
    const Message& message = std::get<Link::Arrived>(outcome).message;
    if (const auto* bye = std::get_if<Bye>(&message)) {
      if (bye->reason.empty()) throw SessionOver();
      link->close();
      last_failure_[role] = bye->reason;
      return redial(role, channel);
    }
    const auto* answer = std::get_if<Hello>(&message);
    if (answer == nullptr) end(link, link->place(), "a connection starts with a hello");
    check_callee(link, role, *answer);
    join(link, *answer);
    if (channel == Channel::camera) dial(role, Channel::nodes);
  });
}

void Gathering::check_callee(const std::shared_ptr<Link>& link, Role role, const Hello& hello) {
  if (hello.role != role) {
    end(link, to_text(dial_.at(role)),
        fmt::format("is the {}, not the {}", role_name(hello.role), role_name(role)));
  }
  const std::string problem = difference_between(own_, hello);
  if (!problem.empty()) end(link, link->place(), problem);
}

Hello Gathering::hello_for(Role peer, Channel channel) const {
  Hello hello = own_;
  hello.called = peer;
  hello.channel = channel;
  return hello;
}

void Gathering::join(const std::shared_ptr<Link>& link, const Hello& hello) {
  if (hello.channel == Channel::camera) mailbox_->set_peer_hello(hello);
  mailbox_->add(hello.role, hello.channel, link);
}

void Gathering::end(const std::shared_ptr<Link>& link, const std::string& place, const std::string& reason) {
  refuse(link, reason);
  throw PeerDiffers(place, reason);
}

bool Gathering::complete() {
  if (!has_all()) return false;
  // Is one of them dead already? What its end told us is there to be read.
  mailbox_->context().poll();
  look_after_links();
  return has_all();
}

bool Gathering::has_all() const {
  for (const Role role : all_roles) {
    for (const Channel channel : all_channels) {
      if (role != own_.role && !mailbox_->has(role, channel)) return false;
    }
  }
  return true;
}

PeersMissing Gathering::missing() const {
  std::string text;
  std::vector<Role> roles;
  for (const Role role : all_roles) {
    if (role == own_.role || (mailbox_->has(role, Channel::camera) && mailbox_->has(role, Channel::nodes)))
      continue;
    roles.push_back(role);
    text += (text.empty() ? "the " : " and the ") + role_name(role);
    const auto called = dial_.find(role);
    text += role < own_.role ? " at " + to_text(called->second) : ", awaited at " + listening_at_;
    const auto failure = last_failure_.find(role);
    if (failure != last_failure_.end()) text += " (" + failure->second + ")";
  }
  return {role_name(own_.role), fmt::format("after {} ms still without {}", timeout_.count(), text), roles};
}

}  // namespace

std::unique_ptr<Mailbox> connect_session(const Hello& own, const Listener* listener,
                                         const std::map<Role, Address>& dial, milliseconds timeout,
                                         const std::function<bool()>& stop, const SharedKey* key) {
  const auto deadline = Clock::now() + timeout;
  std::map<Role, std::string> last_failure;
  for (;;) {
    Gathering gathering(own, listener, dial, timeout, key, last_failure);
    try {
      if (auto mailbox = gathering.run(deadline, stop)) return mailbox;
      if (stop && stop()) return nullptr;
      throw gathering.missing();
    } catch (const SessionOver&) {
      return nullptr;
    } catch (const PeerWent&) {
      std::this_thread::sleep_for(redial_pause);
    }
  }
}

}  // namespace triptych
