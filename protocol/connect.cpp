#include "protocol/connect.hpp"

#include "base/error.hpp"
#include "base/notice.hpp"
#include "protocol/callers.hpp"
#include "protocol/calls.hpp"
#include "protocol/hello_difference.hpp"

#include <optional>
#include <thread>

namespace triptych {

namespace {

using Clock = std::chrono::steady_clock;
using Kind = ConnectOutcome::Kind;
using std::chrono::milliseconds;

/// A link's problem without the place that it begins with.
std::string without_place(const std::string& problem) {
  const size_t end = problem.find(": ");
  return end == std::string::npos ? problem : problem.substr(end + 2);
}

/// What the attempts of one search have in common.
struct Search {
  milliseconds timeout;                           ///< for error messages
  std::map<Role, std::string> last_failure = {};  ///< why a role could not be reached, now or earlier
  std::set<Role> met = {};                        ///< roles that were connected at some time
  std::string stranger = {};                      ///< what was wrong with the last caller that was no role
};

/// One attempt of a role to meet both peers.
class Gathering {
 public:
  Gathering(const Hello& own, const MakeEndpoint& endpoint, Search& search);
  /// Nullopt where a peer left before all had met: then all begin again.
  std::optional<ConnectOutcome> run(Clock::time_point deadline, const std::function<bool()>& stop);

 private:
  void look_after_links();
  /// The first message of a caller, and that of a callee.
  void heard(const std::shared_ptr<Link>& caller, const Hello* hello, const std::string& problem);
  void note_hung_up(Role role, const std::string& problem);
  void turn_away_stranger(const std::shared_ptr<Link>& caller, const std::string& problem);
  std::string answered(const std::shared_ptr<Link>& callee, Role role, const Message& message);
  static void refuse(const std::shared_ptr<Link>& caller, const std::string& reason);

  Hello hello_for(Role peer, Channel channel) const;
  void join(const std::shared_ptr<Link>& link, const Hello& hello);
  /// What a Bye without a reason means depends on who says it: a switch node cannot end the session of the
  /// render node.
  bool is_over(const std::string& reason) const { return reason.empty() && own_.role != Role::render; }
  /// Only the first end counts. Returns a text for Calls, which no longer matters.
  std::string end(Kind kind, const std::string& place, const std::string& what);
  bool complete();
  bool has_all() const;
  /// Which roles are still missing, and what is known of them.
  ConnectOutcome missing() const;
  /// Tells the peers why this role leaves, also callers whose Hello has not been read yet.
  void leave(const std::string& reason);

  Hello own_;
  Search& search_;
  std::unique_ptr<Mailbox> mailbox_ = std::make_unique<Mailbox>();
  std::unique_ptr<Endpoint> endpoint_;
  Callers callers_;
  Calls calls_;
  std::optional<ConnectOutcome> end_;
  bool peer_went_ = false;
};

Gathering::Gathering(const Hello& own, const MakeEndpoint& endpoint, Search& search)
    : own_(own),
      search_(search),
      endpoint_(endpoint(mailbox_->context())),
      callers_(*endpoint_, [this](const std::shared_ptr<Link>& caller, const Hello* hello,
                                  const std::string& problem) { heard(caller, hello, problem); }),
      calls_(
          mailbox_->context(), *endpoint_,
          [this](Role peer, Channel channel) { return hello_for(peer, channel); },
          [this](const std::shared_ptr<Link>& callee, Role role, const Message& message) {
            return answered(callee, role, message);
          },
          [this](Role role, const std::string& why) {
            end(Kind::no_such_host, endpoint_->address_of(role), why);
          },
          [this](Role role, const std::string& why) { note_hung_up(role, why); }, search.last_failure) {}

std::optional<ConnectOutcome> Gathering::run(Clock::time_point deadline, const std::function<bool()>& stop) {
  if (own_.role != all_roles.back()) callers_.accept();
  for (const Role role : all_roles) {
    if (role < own_.role) calls_.call(role);
  }
  bool stopped = false;
  while (!complete() && !end_ && !peer_went_) {
    mailbox_->context().run_one_until(std::min(deadline, Clock::now() + milliseconds(50)));
    look_after_links();
    if (end_ || peer_went_) break;
    if (stop && stop()) {
      stopped = true;
      end(Kind::session_over, "", "");
    } else if (Clock::now() >= deadline) {
      end_ = missing();
    }
  }
  if (end_) {
    // A role that ends the session says so; one that waited in vain says for which roles.
    if (stopped && own_.role != Role::render) {
      leave("told to end");
    } else {
      leave(end_->kind == Kind::session_over ? "" : end_->place + ": " + end_->what);
    }
    return std::move(end_);
  }
  endpoint_->close();
  callers_.close();
  calls_.close();
  if (peer_went_) return std::nullopt;
  return ConnectOutcome{.kind = Kind::connected, .mailbox = std::move(mailbox_)};
}

void Gathering::leave(const std::string& reason) {
  mailbox_->leave(reason);
  endpoint_->close();
  callers_.close();
  calls_.close();
}

std::string Gathering::end(Kind kind, const std::string& place, const std::string& what) {
  if (!end_) end_ = ConnectOutcome{.kind = kind, .place = place, .what = what};
  return "this attempt has ended";
}

void Gathering::look_after_links() {
  callers_.drop_silent();
  // A caller that died may come again; a callee that leaves with a reason has ended the session.
  for (const Role role : all_roles) {
    for (const Channel channel : all_channels) {
      if (role > own_.role) mailbox_->forget_if_broken(role, channel);
    }
  }
  const auto first = mailbox_->first_end();
  if (!first) return;
  if (first->said_bye && is_over(first->reason)) {
    end(Kind::session_over, "", "");
    return;
  }
  search_.last_failure[first->peer] = first->reason.empty() ? "left" : first->reason;
  peer_went_ = true;
}

void Gathering::note_hung_up(Role role, const std::string& problem) {
  const std::string problem_there = without_place(problem);
  const std::string what =
      fmt::format("the {} at {}: {}", role_name(role), endpoint_->address_of(role), problem_there);
  if (problem_there.starts_with(handshake_failed)) {
    end(Kind::keys_differ, role_name(own_.role), what);
  } else {
    notice_once(fmt::format("{}: {}", role_name(own_.role), what));
  }
}

void Gathering::turn_away_stranger(const std::shared_ptr<Link>& caller, const std::string& problem) {
  // Each call comes from another port, and who only hangs up has done nothing wrong.
  const std::string host = caller->place().substr(0, caller->place().rfind(':'));
  const std::string what = without_place(problem);
  if (!what.starts_with(closed_by_peer)) {
    search_.stranger = fmt::format("a caller from {}: {}", host, what);
    notice_once(fmt::format("{}: {}", role_name(own_.role), search_.stranger));
  }
  refuse(caller, "a connection starts with a hello");
}

void Gathering::heard(const std::shared_ptr<Link>& caller, const Hello* said, const std::string& complaint) {
  if (said == nullptr) return turn_away_stranger(caller, complaint);
  const Hello& hello = *said;
  const bool meant = hello.role > own_.role && hello.called == own_.role;
  const std::string problem = meant ? difference_between(own_, hello) : "this is the " + role_name(own_.role);
  const Message reply = hello_for(hello.role, hello.channel);
  if (!problem.empty()) {
    // Our Hello shows the caller the difference; whether it arrives does not matter.
    const std::string ignored = caller->write(reply, encode(reply), milliseconds(0));
    search_.last_failure[hello.role] = problem;
    return refuse(caller, problem);
  }
  if (mailbox_->has(hello.role, hello.channel)) {
    // Perhaps the other one is dead, and this is its successor.
    mailbox_->context().poll();
    mailbox_->forget_if_broken(hello.role, hello.channel);
  }
  if (mailbox_->has(hello.role, hello.channel)) {
    return refuse(caller, fmt::format("the {} is connected already", role_name(hello.role)));
  }
  if (!caller->write(reply, encode(reply), hello_timeout).empty()) return caller->close();
  join(caller, hello);
}

std::string Gathering::answered(const std::shared_ptr<Link>& callee, Role role, const Message& message) {
  if (const auto* bye = std::get_if<Bye>(&message)) {
    return is_over(bye->reason) ? end(Kind::session_over, "", "") : bye->reason;
  }
  const auto* hello = std::get_if<Hello>(&message);
  std::string place = callee->place(), problem;
  if (hello == nullptr) {
    problem = "a connection starts with a hello";
  } else if (hello->role != role) {
    place = endpoint_->address_of(role);
    problem = fmt::format("is the {}, not the {}", role_name(hello->role), role_name(role));
  } else {
    problem = difference_between(own_, *hello);
  }
  if (problem.empty()) {
    join(callee, *hello);
    return {};
  }
  refuse(callee, problem);
  return end(Kind::peer_differs, place, problem);
}

void Gathering::refuse(const std::shared_ptr<Link>& caller, const std::string& reason) {
  const Message bye = Bye{reason};
  // Whether it arrives at a stranger does not matter.
  const std::string ignored = caller->write(bye, encode(bye), milliseconds(0));
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
  search_.met.insert(hello.role);
}

bool Gathering::complete() {
  if (!has_all()) return false;
  // One of them may be dead already; what its end sent is waiting to be read.
  mailbox_->context().poll();
  look_after_links();
  return has_all() && !end_ && !peer_went_;
}

bool Gathering::has_all() const {
  for (const Role role : all_roles) {
    for (const Channel channel : all_channels) {
      if (role != own_.role && !mailbox_->has(role, channel)) return false;
    }
  }
  return true;
}

ConnectOutcome Gathering::missing() const {
  ConnectOutcome outcome{.kind = Kind::peers_missing, .place = role_name(own_.role), .met = search_.met};
  std::string text;
  for (const Role role : all_roles) {
    if (role == own_.role || (mailbox_->has(role, Channel::camera) && mailbox_->has(role, Channel::nodes)))
      continue;
    outcome.missing.push_back(role);
    text += (text.empty() ? "the " : " and the ") + role_name(role);
    text +=
        role < own_.role ? " at " + endpoint_->address_of(role) : ", awaited at " + endpoint_->own_address();
    const auto failure = search_.last_failure.find(role);
    if (failure != search_.last_failure.end()) text += " (" + failure->second + ")";
  }
  if (!search_.stranger.empty()) text += "; " + search_.stranger;
  outcome.what = fmt::format("after {} ms still without {}", search_.timeout.count(), text);
  return outcome;
}

}  // namespace

std::unique_ptr<Mailbox> mailbox_or_error(ConnectOutcome outcome) {
  if (outcome.kind != Kind::connected && outcome.kind != Kind::session_over)
    throw Error(outcome.place, outcome.what);
  return std::move(outcome.mailbox);
}

ConnectOutcome connect_session(const Hello& own, const MakeEndpoint& endpoint, milliseconds timeout,
                               const std::function<bool()>& stop) {
  const auto deadline = Clock::now() + timeout;
  Search search{.timeout = timeout};
  for (;;) {
    if (auto outcome = Gathering(own, endpoint, search).run(deadline, stop)) return std::move(*outcome);
    std::this_thread::sleep_for(redial_pause);
  }
}

ConnectOutcome connect_session(const Hello& own, const Listener* listener,
                               const std::map<Role, Address>& dial, milliseconds timeout,
                               const std::function<bool()>& stop, const SharedKey* key) {
  for (const Role role : all_roles) {
    if (role < own.role && dial.count(role) == 0)
      fail(role_name(own.role), "no address of the {}", role_name(role));
    if (role > own.role && listener == nullptr)
      fail(role_name(own.role), "no port to listen at for the {}", role_name(role));
  }
  const Listener* used = own.role == all_roles.back() ? nullptr : listener;
  return connect_session(
      own, [&](asio::io_context& context) { return tcp_endpoint(context, used, dial, key); }, timeout, stop);
}

}  // namespace triptych
