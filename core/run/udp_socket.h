// Datagrams over IPv4.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace forage {

/// A host and a port, written "PORT" (of this computer), or "HOST:PORT".
struct Endpoint {
    std::string host = "127.0.0.1";
    int port = 0;
    std::string text() const { return host + ":" + std::to_string(port); }
};

/// Reads an endpoint. Empty when `text` is not one. Port 0, which only a listener can have, means any free
/// port.
std::optional<Endpoint> parse_endpoint(std::string_view text);

/// A UDP socket that never waits, except in wait().
class UdpSocket {
  public:
    /// A socket that receives what is sent to `here`. Throws std::runtime_error.
    static UdpSocket listen(const Endpoint& here);
    /// A socket that sends to `there`. Throws std::runtime_error, also when the host is not known.
    static UdpSocket connect(const Endpoint& there);
    UdpSocket(UdpSocket&& other) noexcept;
    UdpSocket& operator=(UdpSocket&&) = delete;
    ~UdpSocket();

    int port() const;  ///< the port of this socket
    /// The next datagram, cut to `most` bytes; empty when none has arrived. It is valid until the next call.
    std::optional<std::string_view> receive(std::size_t most);
    /// Sends a datagram. Returns whether the system took it; that nothing receives it is no failure.
    bool send(std::string_view datagram);
    /// Waits until a datagram arrives, `milliseconds` have passed, or a signal comes.
    void wait(int milliseconds) const;

  private:
    explicit UdpSocket(int handle) : handle_(handle) {}
    int handle_;
    std::string buffer_;  ///< of receive(), which is called in every cycle
};

}  // namespace forage
