// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "src/monitor/handler.hpp"

namespace whipple::monitor {

/// Returns 128 random bits of the operating system as text.
std::string random_token();

/// Serves HTTP on this machine's own address 127.0.0.1 and no other, on one thread. At most 64
/// connections, 64 KiB of a request's body, 16 KiB of its head. A new connection takes the place of the one that has been
/// without a request with the key for longest; one that has had none has 5 s for its request, others 30 s.
class Server {
 public:
  /// @param port  0: any that is free
  /// @throws InputError if the port is in use
  explicit Server(std::uint16_t port);
  ~Server();

  /// Returns address and port, as browsers send them in the header field Host.
  [[nodiscard]] std::string host() const;

  /// Serves until SIGINT or SIGTERM, or until there was no request for `patience` and `may_end()` is true.
  /// @param patience  0: for ever
  void serve(Handler& handler, std::chrono::seconds patience, const std::function<bool()>& may_end);

  struct Connections;  ///< the network's part, known where it is implemented

 private:
  std::unique_ptr<Connections> connections_;
};

}  // namespace whipple::monitor
