#include "protocol/flipping_connection.hpp"

#include "protocol/wire.hpp"

#include <utility>
#include <vector>

namespace triptych {

namespace {

class FlippingConnection : public Connection {
 public:
  FlippingConnection(std::shared_ptr<Connection> below, uint64_t every)
      : below_(std::move(below)), every_(every) {}

  void open(Opened done) override { below_->open(std::move(done)); }
  void read_some(std::span<std::byte> into, Read done) override { below_->read_some(into, std::move(done)); }
  std::string write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override {
    if (++messages_ % every_ != 0 || bytes.size() <= header_bytes) return below_->write(bytes, timeout);
    std::vector<std::byte> changed(bytes.begin(), bytes.end());
    changed[(header_bytes + changed.size()) / 2] ^= std::byte{0x10};
    return below_->write(changed, timeout);
  }
  void close() override { below_->close(); }
  asio::io_context& context() override { return below_->context(); }
  const std::string& place() const override { return below_->place(); }
  TcpFigures kernel_figures() const override { return below_->kernel_figures(); }

 private:
  std::shared_ptr<Connection> below_;
  uint64_t every_, messages_ = 0;
};

}  // namespace

std::shared_ptr<Connection> flipping_connection(std::shared_ptr<Connection> below, uint64_t every) {
  return std::make_shared<FlippingConnection>(std::move(below), every);
}

}  // namespace triptych
