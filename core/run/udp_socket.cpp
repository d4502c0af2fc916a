#include "core/run/udp_socket.h"

#include <cerrno>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/base/number.h"

namespace forage {
namespace {

std::string reason() { return std::generic_category().message(errno); }

/// Creates a socket and calls `use`, which is bind() or connect(), with the address of `endpoint`.
template <class Use>
int opened(const Endpoint& endpoint, Use use) {
    addrinfo wanted{};
    wanted.ai_family = AF_INET;
    wanted.ai_socktype = SOCK_DGRAM;
    addrinfo* found = nullptr;
    if (const int error =
            getaddrinfo(endpoint.host.c_str(), std::to_string(endpoint.port).c_str(), &wanted, &found))
        throw std::runtime_error(
            fmt::format("the host '{}' is not known: {}", endpoint.host, gai_strerror(error)));
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> address(found, &freeaddrinfo);
    const int handle = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (handle < 0 || use(handle, address->ai_addr, address->ai_addrlen) != 0) {
        const std::string why = reason();
        if (handle >= 0) close(handle);
        throw std::runtime_error(fmt::format("{}: {}", endpoint.text(), why));
    }
    return handle;
}

}  // namespace

std::optional<Endpoint> parse_endpoint(std::string_view text) {
    Endpoint out;
    if (const auto colon = text.rfind(':'); colon != std::string_view::npos) {
        out.host = text.substr(0, colon);
        text.remove_prefix(colon + 1);
        if (out.host.empty() ||
            out.host.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyz"
                                       "ABCDEFGHIJKLMNOPQRSTUVWXYZ.-_") != std::string::npos)
            return std::nullopt;
    }
    const auto port = parse_number<int>(text);
    if (!port || *port < 0 || *port > 65535 || text.starts_with('+')) return std::nullopt;
    out.port = *port;
    return out;
}

UdpSocket UdpSocket::listen(const Endpoint& here) { return UdpSocket(opened(here, ::bind)); }

UdpSocket UdpSocket::connect(const Endpoint& there) {
    return UdpSocket(opened(there, [](int handle, const sockaddr* address, socklen_t size) {
        const int yes = 1;  // the address may be that of a whole network
        setsockopt(handle, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
        return ::connect(handle, address, size);
    }));
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : handle_(std::exchange(other.handle_, -1)), buffer_(std::move(other.buffer_)) {}

UdpSocket::~UdpSocket() {
    if (handle_ >= 0) close(handle_);
}

int UdpSocket::port() const {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    if (getsockname(handle_, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
    return ntohs(address.sin_port);
}

std::optional<std::string_view> UdpSocket::receive(std::size_t most) {
    if (buffer_.size() < most) buffer_.resize(most);
    const auto size = recv(handle_, buffer_.data(), most, 0);
    if (size < 0) return std::nullopt;
    return std::string_view(buffer_).substr(0, static_cast<std::size_t>(size));
}

bool UdpSocket::send(std::string_view datagram) {
    // An earlier datagram that nothing received is reported as a failure of a later one.
    for (int attempt = 0; attempt < 2; ++attempt)
        if (::send(handle_, datagram.data(), datagram.size(), MSG_NOSIGNAL) >= 0) return true;
    return errno == ECONNREFUSED;
}

void UdpSocket::wait(int milliseconds) const {
    pollfd what{handle_, POLLIN, 0};
    poll(&what, 1, milliseconds);
}

}  // namespace forage
