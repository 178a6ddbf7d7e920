// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "src/monitor/site.hpp"

namespace whipple::monitor {

/// Returns 128 random bits from the operating system as text.
std::string random_token();

/// Serves HTTP on the loopback address 127.0.0.1 only, on one thread. Limits: 64 connections, the request body that the
/// site states, 16 KiB of request header. At the limit, a new connection replaces the one with the oldest authenticated request. A
/// connection without any has 5 s for its request, others have 30 s.
class Server {
 public:
  /// @param port  0: any free port
  /// @throws InputError if the port is in use
  explicit Server(std::uint16_t port);
  ~Server();

  /// Returns address and port, as browsers send them in the header field Host.
  [[nodiscard]] std::string host() const;

  /// Serves until SIGINT or SIGTERM, or until there was no request for `patience` and `may_end()` is true.
  /// @param patience  0: no limit
  void serve(Site& site, std::chrono::seconds patience, const std::function<bool()>& may_end);

  struct Connections;  ///< network implementation, defined in server.cpp

 private:
  std::unique_ptr<Connections> connections_;
};

}  // namespace whipple::monitor
