#include "protocol/link.hpp"

#include "base/error.hpp"
#include "protocol/delta_codec.hpp"

#include <asio/post.hpp>
#include <utility>

namespace triptych {

namespace {

constexpr size_t max_bytes_at_once = 1 << 16;

uint64_t wire_bytes(size_t bytes) { return bytes + 66 * ((bytes + 1447) / 1448); }

uint64_t ids_in(const DeltaMessage& message) {
  const DeltaCounts counts = delta_counts(message.encoded);
  return counts.added + counts.removed;
}

}  // namespace

void Link::open(std::function<void(const std::string&)> done) {
  connection_->open([self = shared_from_this(), done = std::move(done)](const std::string& problem) {
    if (!self->closed_) done(problem.empty() ? "" : self->place_ + ": " + problem);
  });
}

void Link::read(uint32_t limit, std::function<void(Outcome)> done) {
  done_ = std::move(done);
  limit_ = limit;
  // A message that has arrived already is delivered by the io_context, not in the middle of this call.
  asio::post(connection_->context(), [self = shared_from_this()] {
    if (self->done_) self->go_on();
  });
}

void Link::read_some() {
  arriving_.resize(max_bytes_at_once);
  connection_->read_some(arriving_, [self = shared_from_this()](size_t count, const std::string& problem) {
    if (self->done_) self->take(count, problem);
  });
}

void Link::take(size_t count, const std::string& problem) {
  if (problem.empty()) {
    reader_.bytes().insert(reader_.bytes().end(), arriving_.begin(),
                           arriving_.begin() + static_cast<std::ptrdiff_t>(count));
    return go_on();
  }
  const std::string half = reader_.half_message();
  finish_read(Broken{place_ + ": " + problem + (half.empty() ? "" : " after " + half)});
}

void Link::go_on() {
  std::optional<Arrived> arrived;
  try {
    arrived = reader_.next(limit_, place_);
  } catch (const Error& error) {
    return finish_read(Broken{error.what()});
  }
  if (!arrived) return read_some();
  const size_t bytes = header_bytes + arrived->body_bytes;
  ++figures_.messages_received;
  figures_.bytes_received += bytes;
  figures_.wire_bytes_received += wire_bytes(bytes);
  if (const auto* delta = std::get_if<DeltaMessage>(&arrived->message)) {
    figures_.delta_body_bytes_received += arrived->body_bytes;
    figures_.delta_ids_received += ids_in(*delta);
  }
  finish_read(std::move(*arrived));
}

void Link::finish_read(Outcome outcome) {
  // The callback may start the next read.
  const auto done = std::exchange(done_, nullptr);
  done(std::move(outcome));
}

std::string Link::write(const Message& message, const std::vector<std::byte>& bytes,
                        std::chrono::milliseconds timeout) {
  const std::string problem = connection_->write(bytes, timeout);
  if (!problem.empty()) return place_ + ": " + problem;
  ++figures_.messages_sent;
  figures_.bytes_sent += bytes.size();
  figures_.wire_bytes_sent += wire_bytes(bytes.size());
  if (const auto* delta = std::get_if<DeltaMessage>(&message)) {
    ++figures_.deltas_sent;
    figures_.delta_body_bytes_sent += bytes.size() - header_bytes;
    figures_.delta_ids_sent += ids_in(*delta);
  }
  return {};
}

void Link::close() {
  closed_ = true;
  done_ = nullptr;
  connection_->close();
}

}  // namespace triptych
