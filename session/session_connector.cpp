#include "session/session_connector.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/inject.hpp"
#include "base/notice.hpp"
#include "base/timeline.hpp"
#include "nodes/device_choice.hpp"
#include "protocol/flipping_connection.hpp"
#include "raster/certify_raster.hpp"
#include "render/certify_gl.hpp"
#include "session/open_pack.hpp"

#include <thread>

namespace triptych {

namespace {

/// Without a key a session must stay on this machine, unless --insecure is given.
void check_without_key(const Address& address, bool insecure) {
  if (is_loopback(address)) return;
  if (!insecure) fail(to_text(address), "is beyond this machine: give --key-file FILE, or --insecure");
  notice("{}: not encrypted; whoever reaches it can read along and take a role", to_text(address));
}

}  // namespace

const std::string& raster_verdict(const DeviceNames& device) {
  static const std::string& verdict =
      verdict_name((kind_of(device) == DeviceKind::gl ? certify_gl() : certify_raster()).verdict());
  return verdict;
}

SessionConnector::SessionConnector(const RoleCommand& command, const Pack& pack, const DeviceNames& device)
    : timeout_(static_cast<int64_t>(command.connect_timeout_s * 1000)) {
  if (command.timeline) start_timeline();
  own_.role = command.self;
  own_.session = command.session;
  own_.pack_hash = pack.content_hash();
  own_.device = device;
  own_.raster = raster_verdict(device);
  if (command.listen_descriptor >= 0) {
    listener_.emplace(command.listen_descriptor);
  } else if (!command.listen.empty()) {
    listener_.emplace(parse_address(command.listen));
  }
  if (command.self != Role::render) dial_[Role::render] = parse_address(command.render_address);
  if (command.self == Role::switch_1) dial_[Role::switch_0] = parse_address(command.switch_0_address);
  if (!command.key_file.empty()) {
    key_ = read_key_file(command.key_file);
  } else {
    if (listener_) check_without_key(listener_->address(), command.insecure);
    for (const auto& [role, address] : dial_) check_without_key(address, command.insecure);
  }
  if (command.record.empty()) return;
  make_folder(command.record);
  const size_t earlier = recordings_of(command.self, command.record).size();
  recording_ =
      std::make_unique<RecordingWriter>(command.record / recording_name(command.self, earlier + 1),
                                        RecordingHeader{.own = own_, .pack = lasting_name(command.run.pack)});
}

ConnectOutcome SessionConnector::attempt(const std::function<bool()>& stop) const {
  return connect_session(own_, listener_ ? &*listener_ : nullptr, dial_, timeout_, stop,
                         key_ ? &*key_ : nullptr);
}

std::unique_ptr<Mailbox> SessionConnector::equip(std::unique_ptr<Mailbox> mailbox) const {
  if (!mailbox) return nullptr;
  compare_devices(*mailbox);
  if (recording_) {
    mailbox->observe = [this](const RecordedMessage& message) { recording_->add(message); };
  }
  if (injected(Fault::flipped_byte)) {
    mailbox->wrap(Channel::nodes, [](std::shared_ptr<Connection> connection) {
      return flipping_connection(std::move(connection));
    });
  }
  return mailbox;
}

std::unique_ptr<Mailbox> SessionConnector::connect(const std::function<bool()>& stop) const {
  return equip(mailbox_or_error(attempt(stop)));
}

void SessionConnector::record_own(const Message& message) const {
  if (!recording_) return;
  recording_->add({.time_ms = steady_milliseconds(),
                   .sent = true,
                   .peer = own_.role,
                   .channel = Channel::camera,
                   .message = message});
}

std::unique_ptr<Mailbox> SessionConnector::connect_again(const std::function<bool()>& stop) const {
  using Kind = ConnectOutcome::Kind;
  for (uint32_t search = 1;; ++search) {
    ConnectOutcome outcome = attempt(stop);
    const bool missing = outcome.kind == Kind::peers_missing;
    const bool again = missing || outcome.kind == Kind::no_such_host || outcome.kind == Kind::keys_differ;
    if (!again) return equip(mailbox_or_error(std::move(outcome)));
    if (stop && stop()) return nullptr;
    // Of an hour's searches the first, the second, the fourth and so on are enough to say.
    const bool power_of_two = (search & (search - 1)) == 0;
    if (power_of_two) notice("{}: {}; goes on looking", outcome.place, outcome.what);
    if (!missing) std::this_thread::sleep_for(std::chrono::milliseconds(200));  // it may come back
  }
}

/// Only where all three agree can pictures be claimed to be identical to those of one process.
void SessionConnector::compare_devices(const Mailbox& mailbox) const {
  if (own_.role != Role::render) return;
  for (const Role role : {Role::switch_0, Role::switch_1}) {
    const Hello& peer = mailbox.peer_hello(role);
    if (peer.device == own_.device) continue;
    const auto text = [](const Hello& hello) {
      return fmt::format("{}, {}, {}", hello.device.vendor, hello.device.renderer, hello.device.version);
    };
    notice("devices differ: {} has {}; {} has {}: culling is conservative", role_name(own_.role), text(own_),
           role_name(role), text(peer));
  }
}

}  // namespace triptych
