#include "protocol/connect.hpp"

#include "protocol/callers.hpp"
#include "protocol/calls.hpp"
#include "protocol/hello_difference.hpp"

#include <optional>
#include <thread>

namespace triptych {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// A peer went before all had met: all begin again.
struct PeerWent {};
/// A peer said that the session is over.
struct SessionOver {};

/// One role's way into the session; what ends it is thrown.
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
  /// Those who called, and those who were called.
  void heard(const std::shared_ptr<Link>& caller, const Hello* hello);
  std::string answered(const std::shared_ptr<Link>& callee, Role role, const Message& message);
  void refuse(const std::shared_ptr<Link>& caller, const std::string& reason);

  Hello hello_for(Role peer, Channel channel) const;
  void join(const std::shared_ptr<Link>& link, const Hello& hello);
  [[noreturn]] void end(const std::shared_ptr<Link>& link, const std::string& place,
                        const std::string& reason);
  bool complete();
  bool has_all() const;

  Hello own_;
  std::map<Role, Address> dial_;
  milliseconds timeout_;  ///< for what is said
  std::string listening_at_;
  std::map<Role, std::string>& last_failure_;  ///< why a role is not here, of this attempt and those before
  std::unique_ptr<Mailbox> mailbox_ = std::make_unique<Mailbox>();
  std::optional<Callers> callers_;  ///< none for the last role
  Calls calls_;
};

Gathering::Gathering(const Hello& own, const Listener* listener, const std::map<Role, Address>& dial,
                     milliseconds timeout, const SharedKey* key, std::map<Role, std::string>& last_failure)
    : own_(own),
      dial_(dial),
      timeout_(timeout),
      last_failure_(last_failure),
      calls_(
          mailbox_->context(), key, [this](Role peer, Channel channel) { return hello_for(peer, channel); },
          [this](const std::shared_ptr<Link>& callee, Role role, const Message& message) {
            return answered(callee, role, message);
          },
          last_failure) {
  for (const Role role : all_roles) {
    if (role < own.role && dial.count(role) == 0)
      fail(role_name(own.role), "no address of the {}", role_name(role));
    if (role > own.role && listener == nullptr)
      fail(role_name(own.role), "no port to listen at for the {}", role_name(role));
  }
  if (listener == nullptr || own.role == Role::switch_1) return;
  listening_at_ = to_text(listener->address());
  callers_.emplace(mailbox_->context(), *listener, key,
                   [this](const std::shared_ptr<Link>& caller, const Hello* hello) { heard(caller, hello); });
}

std::unique_ptr<Mailbox> Gathering::run(Clock::time_point deadline, const std::function<bool()>& stop) {
  try {
    if (callers_) callers_->accept();
    for (const auto& [role, address] : dial_) {
      if (role < own_.role) calls_.call(role, address);
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
  return std::move(mailbox_);
}

void Gathering::look_after_links() {
  if (callers_) callers_->drop_silent();
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
  if (callers_) callers_->close();
  calls_.close();
}

void Gathering::heard(const std::shared_ptr<Link>& caller, const Hello* said) {
  if (said == nullptr) return refuse(caller, "a connection starts with a hello");
  const Hello& hello = *said;
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

std::string Gathering::answered(const std::shared_ptr<Link>& callee, Role role, const Message& message) {
  if (const auto* bye = std::get_if<Bye>(&message)) {
    if (bye->reason.empty()) throw SessionOver();
    return bye->reason;
  }
  const auto* hello = std::get_if<Hello>(&message);
  if (hello == nullptr) end(callee, callee->place(), "a connection starts with a hello");
  if (hello->role != role) {
    end(callee, to_text(dial_.at(role)),
        fmt::format("is the {}, not the {}", role_name(hello->role), role_name(role)));
  }
  const std::string problem = difference_between(own_, *hello);
  if (!problem.empty()) end(callee, callee->place(), problem);
  join(callee, *hello);
  return {};
}

void Gathering::refuse(const std::shared_ptr<Link>& caller, const std::string& reason) {
  const Message bye = Bye{reason};
  caller->write(bye, encode(bye), milliseconds(0));  // whether a stranger takes it does not matter
  caller->close();
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
